// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/enclosure.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

Range apply(TapeOp op, const Range& a) {
  switch (op) {
    case TapeOp::kSqrt:
      return sqrt(a);
    case TapeOp::kSin:
      return sin(a);
    case TapeOp::kCos:
      return cos(a);
    case TapeOp::kTan:
      return tan(a);
    case TapeOp::kAsin:
      return asin(a);
    case TapeOp::kAcos:
      return acos(a);
    case TapeOp::kAtan:
      return atan(a);
    case TapeOp::kSinh:
      return sinh(a);
    case TapeOp::kCosh:
      return cosh(a);
    case TapeOp::kTanh:
      return tanh(a);
    case TapeOp::kExp:
      return exp(a);
    case TapeOp::kLog:
      return log(a);
    case TapeOp::kAbs:
      return abs(a);
    default:
      throw InvalidInput("op: not a function of one argument");
  }
}

/// phi, phi', phi'' over a.
void derivatives(TapeOp op, const Range& a, Range* phi) {
  const Range one(1), p = apply(op, a);
  phi[0] = p;
  switch (op) {
    case TapeOp::kSqrt: {
      const Range i = one / p;
      phi[1] = 0.5 * i;
      phi[2] = -(0.25 * (i * i * i));
      return;
    }
    case TapeOp::kSin:
      phi[1] = cos(a);
      phi[2] = -p;
      return;
    case TapeOp::kCos:
      phi[1] = -sin(a);
      phi[2] = -p;
      return;
    case TapeOp::kTan:
      phi[1] = one + sqr(p);
      phi[2] = 2.0 * (p * phi[1]);
      return;
    case TapeOp::kAsin:
    case TapeOp::kAcos: {
      const Range i = one / sqrt((one - a) * (one + a)), sign(op == TapeOp::kAsin ? 1 : -1);
      phi[1] = sign * i;
      phi[2] = sign * (a * (i * i * i));
      if (!(a.lo > -1 && a.hi < 1)) phi[1] = phi[2] = Range::everything();
      return;
    }
    case TapeOp::kAtan: {
      const Range i = one / (one + sqr(a));
      phi[1] = i;
      phi[2] = -2.0 * (a * sqr(i));
      return;
    }
    case TapeOp::kSinh:
      phi[1] = cosh(a);
      phi[2] = p;
      return;
    case TapeOp::kCosh:
      phi[1] = sinh(a);
      phi[2] = p;
      return;
    case TapeOp::kTanh:
      phi[1] = one - sqr(p);
      phi[2] = -2.0 * (p * phi[1]);
      return;
    case TapeOp::kExp:
      phi[1] = phi[2] = p;
      return;
    case TapeOp::kLog: {
      const Range i = one / a;
      phi[1] = a.lo > 0 ? i : Range::everything();
      phi[2] = a.lo > 0 ? -sqr(i) : Range::everything();
      return;
    }
    default:  // kAbs
      phi[1] = a.lo > 0 ? one : a.hi < 0 ? -one : Range::everything();
      phi[2] = a.lo > 0 || a.hi < 0 ? Range() : Range::everything();
  }
}

void derivatives_of_power(const Range& a, int n, Range* phi) {
  phi[0] = pow(a, n);
  phi[1] = double(n) * pow(a, n - 1);
  phi[2] = double(n) * (double(n - 1) * pow(a, n - 2));
}

/// An integer whose sums and quotients with its like are not rounded when they are doubles.
bool is_small_integer(const Range& a) { return a.lo == a.hi && std::fabs(a.lo) <= 0x1p50 && a.lo == std::floor(a.lo); }

/// a + sign b where both are integers, else the Range given.
Range exact_or(const Range& a, const Range& b, const Range& rounded, int sign) {
  return is_small_integer(a) && is_small_integer(b) ? Range(a.lo + sign * b.lo) : rounded;
}

/// What a tape runs on to be read: every operation adds a node.
struct Recorder {
  static thread_local EnclosureBuilder* builder;
  EnclosureBuilder::Node node = 0;

  Recorder() = default;
  explicit Recorder(double value) : node(builder->constant(Range(value))) {}
  static Recorder of(EnclosureBuilder::Node node) {
    Recorder r;
    r.node = node;
    return r;
  }
};
thread_local EnclosureBuilder* Recorder::builder = nullptr;

Recorder operator+(Recorder a, Recorder b) { return Recorder::of(Recorder::builder->add(a.node, b.node)); }
Recorder operator*(Recorder a, Recorder b) { return Recorder::of(Recorder::builder->product(a.node, b.node)); }
Recorder operator/(Recorder a, Recorder b) { return Recorder::of(Recorder::builder->quotient(a.node, b.node)); }
Recorder sqr(Recorder a) { return Recorder::of(Recorder::builder->power(a.node, 2)); }
Recorder pow(Recorder a, int n) { return Recorder::of(Recorder::builder->power(a.node, n)); }
Recorder pow(Recorder a, Recorder b) { return Recorder::of(Recorder::builder->pow(a.node, b.node)); }
Recorder record(TapeOp op, Recorder a) { return Recorder::of(Recorder::builder->function(op, a.node)); }
Recorder sqrt(Recorder a) { return record(TapeOp::kSqrt, a); }
Recorder sin(Recorder a) { return record(TapeOp::kSin, a); }
Recorder cos(Recorder a) { return record(TapeOp::kCos, a); }
Recorder tan(Recorder a) { return record(TapeOp::kTan, a); }
Recorder asin(Recorder a) { return record(TapeOp::kAsin, a); }
Recorder acos(Recorder a) { return record(TapeOp::kAcos, a); }
Recorder atan(Recorder a) { return record(TapeOp::kAtan, a); }
Recorder sinh(Recorder a) { return record(TapeOp::kSinh, a); }
Recorder cosh(Recorder a) { return record(TapeOp::kCosh, a); }
Recorder tanh(Recorder a) { return record(TapeOp::kTanh, a); }
Recorder exp(Recorder a) { return record(TapeOp::kExp, a); }
Recorder log(Recorder a) { return record(TapeOp::kLog, a); }
Recorder abs(Recorder a) { return record(TapeOp::kAbs, a); }

}  // namespace

Enclosure Enclosure::of_tape(const Tape& tape) {
  EnclosureBuilder builder(tape.num_inputs());
  Recorder::builder = &builder;
  std::vector<Recorder> x, values(tape.num_outputs()), workspace;
  for (int i = 0; i < tape.num_inputs(); ++i) x.push_back(Recorder::of(builder.input(i)));
  tape.run<Recorder>(x, values, workspace);
  Recorder::builder = nullptr;
  std::vector<EnclosureBuilder::Node> outputs;
  for (const Recorder& value : values) outputs.push_back(value.node);
  return builder.build(outputs, false);
}

void Enclosure::combine(const Node& node, std::size_t n, int order, Workspace& w) const {
  const std::size_t d = num_variables_, pairs = d * (d + 1) / 2;
  const bool minus = node.op == Op::kSubtract, scale = node.op == Op::kScale;
  const auto compute = [&](const std::vector<Range>& r, std::size_t a, std::size_t b) {
    return scale ? node.constant * r[a] : minus ? r[a] - r[b] : r[a] + r[b];
  };
  w.values_[n] = compute(w.values_, node.a, node.b);
  if (order < 1) return;
  for (const std::size_t i : node.inputs)
    w.gradients_[n * d + i] = compute(w.gradients_, node.a * d + i, node.b * d + i);
  if (order < 2 || node.degree < 2) return;
  for (const std::size_t i : node.inputs) {
    for (const std::size_t j : node.inputs) {
      if (j < i) continue;
      const std::size_t p = pair(i, j);
      w.hessians_[n * pairs + p] = compute(w.hessians_, node.a * pairs + p, node.b * pairs + p);
    }
  }
}

void Enclosure::product(const Node& node, std::size_t n, int order, Workspace& w) const {
  const std::size_t d = num_variables_, pairs = d * (d + 1) / 2;
  const Range a = w.values_[node.a], b = w.values_[node.b];
  w.values_[n] = a * b;
  if (order < 1) return;
  const Range *ga = &w.gradients_[node.a * d], *gb = &w.gradients_[node.b * d];
  const auto times = [](const Range& x, const Range& y) {
    return (y.is_zero() && x.is_bounded()) || (x.is_zero() && y.is_bounded()) ? Range() : x * y;
  };
  for (const std::size_t i : node.inputs) w.gradients_[n * d + i] = times(a, gb[i]) + times(b, ga[i]);
  if (order < 2) return;
  const bool curved_a = nodes_[node.a].degree >= 2, curved_b = nodes_[node.b].degree >= 2;
  const Range *ha = &w.hessians_[node.a * pairs], *hb = &w.hessians_[node.b * pairs];
  for (const std::size_t i : node.inputs) {
    for (const std::size_t j : node.inputs) {
      if (j < i) continue;
      const std::size_t p = pair(i, j);
      Range h = times(ga[i], gb[j]) + times(ga[j], gb[i]);
      if (curved_b) h = h + times(a, hb[p]);
      if (curved_a) h = h + times(b, ha[p]);
      w.hessians_[n * pairs + p] = h;
    }
  }
}

void Enclosure::chain(const Node& node, std::size_t n, int order, const Range* phi, Workspace& w) const {
  const std::size_t d = num_variables_, pairs = d * (d + 1) / 2;
  w.values_[n] = phi[0];
  if (order < 1) return;
  const Range* g = &w.gradients_[node.a * d];
  for (const std::size_t i : node.inputs) w.gradients_[n * d + i] = phi[1] * g[i];
  if (order < 2) return;
  const bool curved = nodes_[node.a].degree >= 2;
  const Range* h = &w.hessians_[node.a * pairs];
  for (const std::size_t i : node.inputs) {
    for (const std::size_t j : node.inputs) {
      if (j < i) continue;
      const std::size_t p = pair(i, j);
      const Range bent = phi[2] * (i == j ? sqr(g[i]) : g[i] * g[j]);
      w.hessians_[n * pairs + p] = curved ? bent + phi[1] * h[p] : bent;
    }
  }
}

void Enclosure::evaluate(std::span<const Range> box, int order, Jets& jets, Workspace& w) const {
  const std::size_t d = num_variables_, pairs = d * (d + 1) / 2, k = outputs_.size();
  if (box.size() != d) throw InvalidInput("box: " + std::to_string(box.size()) + " ranges, not " + std::to_string(d));
  // What a node does not depend on stays zero from here on.
  w.values_.resize(nodes_.size());
  if (order >= 1) w.gradients_.resize(nodes_.size() * d);
  if (order >= 2) w.hessians_.resize(nodes_.size() * pairs);
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    Range phi[3];
    switch (node.op) {
      case Op::kInput:
        w.values_[n] = box[node.a];
        if (order >= 1) w.gradients_[n * d + node.a] = Range(1);
        break;
      case Op::kConstant:
        w.values_[n] = node.constant;
        break;
      case Op::kAdd:
      case Op::kSubtract:
      case Op::kScale:
        combine(node, n, order, w);
        break;
      case Op::kProduct:
        product(node, n, order, w);
        break;
      case Op::kPower:
        if (order == 0) {
          w.values_[n] = whitney::pow(w.values_[node.a], node.exponent);
        } else {
          derivatives_of_power(w.values_[node.a], node.exponent, phi);
          chain(node, n, order, phi, w);
        }
        break;
      case Op::kFunction:
        if (order == 0) {
          w.values_[n] = apply(node.function, w.values_[node.a]);
        } else {
          derivatives(node.function, w.values_[node.a], phi);
          chain(node, n, order, phi, w);
        }
        break;
      case Op::kQuotient:
      case Op::kPow:
        throw InvalidInput("enclosure: an operation that the builder replaces");
    }
  }
  jets.values.resize(k);
  if (order >= 1) jets.gradients.resize(k * d);
  if (order >= 2) jets.hessians.resize(k * pairs);
  for (std::size_t a = 0; a < k; ++a) {
    const std::size_t n = outputs_[a];
    jets.values[a] = w.values_[n];
    if (order >= 1) std::copy_n(w.gradients_.begin() + n * d, d, jets.gradients.begin() + a * d);
    if (order >= 2) std::copy_n(w.hessians_.begin() + n * pairs, pairs, jets.hessians.begin() + a * pairs);
  }
}

EnclosureBuilder::EnclosureBuilder(int num_variables) {
  if (num_variables < 1) throw InvalidInput("num_variables must be positive, is " + std::to_string(num_variables));
  program_.num_variables_ = num_variables;
  for (int i = 0; i < num_variables; ++i) {
    Enclosure::Node node;
    node.op = Enclosure::Op::kInput;
    node.a = i;
    node.degree = 1;
    node.inputs = {static_cast<std::uint32_t>(i)};
    program_.nodes_.push_back(std::move(node));
  }
}

EnclosureBuilder::Node EnclosureBuilder::insert(Enclosure::Node node) {
  using Op = Enclosure::Op;
  auto& nodes = program_.nodes_;
  if (node.op != Op::kConstant) {
    node.inputs = nodes[node.a].inputs;
    if (node.op == Op::kAdd || node.op == Op::kSubtract || node.op == Op::kProduct) {
      node.inputs.clear();
      std::set_union(nodes[node.a].inputs.begin(), nodes[node.a].inputs.end(), nodes[node.b].inputs.begin(),
                     nodes[node.b].inputs.end(), std::back_inserter(node.inputs));
    }
  }
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto& old = nodes[n];
    if (old.op == node.op && old.a == node.a && old.b == node.b && old.exponent == node.exponent &&
        old.function == node.function && old.constant.lo == node.constant.lo && old.constant.hi == node.constant.hi) {
      return static_cast<Node>(n);
    }
  }
  nodes.push_back(std::move(node));
  return static_cast<Node>(nodes.size() - 1);
}

EnclosureBuilder::Node EnclosureBuilder::input(int i) {
  if (i < 0 || i >= program_.num_variables_) throw InvalidInput("input " + std::to_string(i) + " does not exist");
  return i;
}
bool EnclosureBuilder::is_constant(Node a) const { return program_.nodes_.at(a).op == Enclosure::Op::kConstant; }
const Range& EnclosureBuilder::value(Node a) const { return program_.nodes_.at(a).constant; }

EnclosureBuilder::Node EnclosureBuilder::constant(const Range& value) {
  Enclosure::Node node;
  node.constant = value;
  return insert(std::move(node));
}

EnclosureBuilder::Node EnclosureBuilder::add(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) return constant(exact_or(value(a), value(b), value(a) + value(b), +1));
  if (is_constant(a) && value(a).is_zero()) return b;
  if (is_constant(b) && value(b).is_zero()) return a;
  Enclosure::Node node;
  node.op = Enclosure::Op::kAdd;
  node.a = a;
  node.b = b;
  node.degree = std::max(program_.nodes_[a].degree, program_.nodes_[b].degree);
  return insert(std::move(node));
}

EnclosureBuilder::Node EnclosureBuilder::subtract(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) return constant(exact_or(value(a), value(b), value(a) - value(b), -1));
  if (is_constant(b) && value(b).is_zero()) return a;
  Enclosure::Node node;
  node.op = Enclosure::Op::kSubtract;
  node.a = a;
  node.b = b;
  node.degree = std::max(program_.nodes_[a].degree, program_.nodes_[b].degree);
  return insert(std::move(node));
}

EnclosureBuilder::Node EnclosureBuilder::product(Node a, Node b) {
  if (is_constant(b)) std::swap(a, b);
  if (is_constant(a) && is_constant(b)) {
    const Range &p = value(a), &q = value(b);
    const bool is_exact = is_small_integer(p) && is_small_integer(q) && std::fabs(p.lo * q.lo) < 0x1p53;
    return constant(is_exact ? Range(p.lo * q.lo) : p * q);
  }
  Enclosure::Node node;
  if (is_constant(a)) {
    if (value(a).lo == 1 && value(a).hi == 1) return b;
    node.op = Enclosure::Op::kScale;
    node.constant = value(a);
    node.a = b;
    node.degree = program_.nodes_[b].degree;
    return insert(std::move(node));
  }
  if (a == b) return power(a, 2);
  node.op = Enclosure::Op::kProduct;
  node.a = std::min(a, b);
  node.b = std::max(a, b);
  node.degree = std::min(3, program_.nodes_[a].degree + program_.nodes_[b].degree);
  return insert(std::move(node));
}

EnclosureBuilder::Node EnclosureBuilder::quotient(Node a, Node b) {
  if (is_constant(a) && is_constant(b)) {
    const Range &p = value(a), &q = value(b);
    const double ratio = p.lo / q.lo;
    const bool is_exact = is_small_integer(p) && is_small_integer(q) && q.lo != 0 && ratio * q.lo == p.lo &&
                          std::fma(ratio, q.lo, -p.lo) == 0;
    return constant(is_exact ? Range(ratio) : p / q);
  }
  return product(a, power(b, -1));
}

EnclosureBuilder::Node EnclosureBuilder::power(Node a, int n) {
  if (is_constant(a) && n == -1) return quotient(constant(Range(1)), a);
  if (is_constant(a)) return constant(whitney::pow(value(a), n));
  if (n == 1) return a;
  if (n == 0) return constant(Range(1));
  Enclosure::Node node;
  node.op = Enclosure::Op::kPower;
  node.a = a;
  node.exponent = n;
  node.degree = n == 2 ? std::min(3, 2 * program_.nodes_[a].degree) : 3;
  return insert(std::move(node));
}

EnclosureBuilder::Node EnclosureBuilder::pow(Node a, Node b) {
  if (is_constant(b)) {
    const Range& n = value(b);
    if (n.lo == n.hi && n.lo == std::floor(n.lo) && std::fabs(n.lo) < 1e6) return power(a, static_cast<int>(n.lo));
    if (n.lo == 0.5 && n.hi == 0.5) return function(TapeOp::kSqrt, a);
  }
  return function(TapeOp::kExp, product(b, function(TapeOp::kLog, a)));
}

EnclosureBuilder::Node EnclosureBuilder::function(TapeOp op, Node a) {
  if (op < TapeOp::kSqrt || op > TapeOp::kAbs) throw InvalidInput("op: not a function of one argument");
  if (is_constant(a)) return constant(apply(op, value(a)));
  Enclosure::Node node;
  node.op = Enclosure::Op::kFunction;
  node.function = op;
  node.a = a;
  node.degree = 3;
  return insert(std::move(node));
}

Enclosure EnclosureBuilder::build(std::span<const Node> outputs, bool has_exact_constants) const {
  Enclosure result;
  result.num_variables_ = program_.num_variables_;
  result.has_exact_constants_ = has_exact_constants;
  // Only what the outputs need, and all inputs.
  const auto& nodes = program_.nodes_;
  std::vector<char> is_used(nodes.size(), false);
  for (const Node output : outputs) is_used.at(output) = true;
  for (std::size_t n = nodes.size(); n-- > 0;) {
    if (!is_used[n] || nodes[n].op == Enclosure::Op::kInput || nodes[n].op == Enclosure::Op::kConstant) continue;
    is_used[nodes[n].a] = true;
    const auto op = nodes[n].op;
    if (op == Enclosure::Op::kAdd || op == Enclosure::Op::kSubtract || op == Enclosure::Op::kProduct) {
      is_used[nodes[n].b] = true;
    }
  }
  std::vector<Node> place(nodes.size(), 0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!is_used[n]) continue;
    place[n] = static_cast<Node>(result.nodes_.size());
    Enclosure::Node node = nodes[n];
    if (node.op != Enclosure::Op::kInput) node.a = place[node.a];
    node.b = place[node.b];
    result.nodes_.push_back(std::move(node));
  }
  for (const Node output : outputs) result.outputs_.push_back(place[output]);
  return result;
}

}  // namespace whitney
