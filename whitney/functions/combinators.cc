// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/combinators.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

/// Room for a batch of a few points without a trip to the heap.
using Buffer = boost::container::small_vector<double, 128>;

Buffer make_buffer(std::size_t size) { return Buffer(size, boost::container::default_init); }

void require_size(const char* what, std::size_t size, std::size_t expected) {
  if (size != expected) {
    throw InvalidInput(std::string(what) + ": size " + std::to_string(size) + " instead of " +
                       std::to_string(expected));
  }
}
void require_finite(const char* what, bool finite) {
  if (!finite) throw InvalidInput(std::string(what) + " has an entry that is not finite");
}

/// f o A for an affine map A of R^d to itself. An AffineMap offers
///   apply(x, y): y = A(x);  pull_back(g, h): h = g DA for a row g;  length(s): the image of a length s.
template <class AffineMap>
class ComposedModel : public Function::Model {
 public:
  ComposedModel(Function f, AffineMap map) : f_(std::move(f)), map_(std::move(map)) {}
  int ambient_dim() const override { return f_.ambient_dim(); }
  int codim() const override { return f_.codim(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    const std::size_t d = ambient_dim();
    Buffer moved = make_buffer(points.size());
    for (std::size_t i = 0; i < points.size(); i += d) map_.apply(points.data() + i, moved.data() + i, d);
    f_.evaluate({moved.data(), moved.size()}, values);
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const override {
    const std::size_t d = ambient_dim();
    Buffer moved = make_buffer(d), inner = make_buffer(jacobian.size());
    map_.apply(point.data(), moved.data(), d);
    f_.jacobian({moved.data(), d}, {inner.data(), inner.size()}, map_.length(length_scale));
    for (std::size_t i = 0; i < inner.size(); i += d) map_.pull_back(inner.data() + i, jacobian.data() + i, d);
  }

 private:
  Function f_;
  AffineMap map_;
};

template <class AffineMap>
Function compose(Function f, AffineMap map) {
  return Function(std::make_shared<ComposedModel<AffineMap>>(std::move(f), std::move(map)));
}

/// y = Q^T x, by rows of Q so that the inner loop has no sums to reorder: every point gets the same bits in any batch.
struct InverseRotation {
  std::vector<double> q, q_transposed;

  static void multiply(const std::vector<double>& rows, const double* x, double* y, std::size_t d) {
    std::fill(y, y + d, 0.0);
    for (std::size_t i = 0; i < d; ++i) {
      for (std::size_t j = 0; j < d; ++j) y[j] += x[i] * rows[i * d + j];
    }
  }
  void apply(const double* x, double* y, std::size_t d) const { multiply(q, x, y, d); }
  void pull_back(const double* g, double* h, std::size_t d) const { multiply(q_transposed, g, h, d); }
  double length(double s) const { return s; }
};

struct InverseTranslation {
  std::vector<double> b;

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[i] - b[i];
  }
  void pull_back(const double* g, double* h, std::size_t d) const { std::copy(g, g + d, h); }
  double length(double s) const { return s; }
};

struct InverseScaling {
  double s;

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[i] / s;
  }
  void pull_back(const double* g, double* h, std::size_t d) const { apply(g, h, d); }
  double length(double length) const { return length / s; }
};

struct InversePermutation {
  std::vector<int> permutation;

  void apply(const double* x, double* y, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) y[i] = x[permutation[i]];
  }
  void pull_back(const double* g, double* h, std::size_t d) const {
    for (std::size_t i = 0; i < d; ++i) h[permutation[i]] = g[i];
  }
  double length(double s) const { return s; }
};

class ProductModel : public Function::Model {
 public:
  ProductModel(Function f, Function g) : f_(std::move(f)), g_(std::move(g)) {}
  int ambient_dim() const override { return f_.ambient_dim() + g_.ambient_dim(); }
  int codim() const override { return f_.codim() + g_.codim(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    part(f_, 0, 0, points, values);
    part(g_, f_.ambient_dim(), f_.codim(), points, values);
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const override {
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    block(f_, 0, 0, point, jacobian, length_scale);
    block(g_, f_.ambient_dim(), f_.codim(), point, jacobian, length_scale);
  }

 private:
  /// The values of one factor, whose coordinates begin at first_x and whose values at first_value.
  void part(const Function& f, std::size_t first_x, std::size_t first_value, std::span<const double> points,
            std::span<double> values) const {
    const std::size_t d = ambient_dim(), k = codim(), e = f.ambient_dim(), l = f.codim(), m = points.size() / d;
    Buffer x = make_buffer(m * e), v = make_buffer(m * l);
    for (std::size_t i = 0; i < m; ++i) std::copy_n(points.data() + i * d + first_x, e, x.data() + i * e);
    f.evaluate({x.data(), x.size()}, {v.data(), v.size()});
    for (std::size_t i = 0; i < m; ++i) std::copy_n(v.data() + i * l, l, values.data() + i * k + first_value);
  }
  void block(const Function& f, std::size_t first_x, std::size_t first_value, std::span<const double> point,
             std::span<double> jacobian, double length_scale) const {
    const std::size_t d = ambient_dim(), e = f.ambient_dim(), l = f.codim();
    Buffer inner = make_buffer(l * e);
    f.jacobian(point.subspan(first_x, e), {inner.data(), inner.size()}, length_scale);
    for (std::size_t i = 0; i < l; ++i) {
      std::copy_n(inner.data() + i * e, e, jacobian.data() + (first_value + i) * d + first_x);
    }
  }

  Function f_, g_;
};

/// x -> x on R^d: its zero set is the origin.
class IdentityModel : public Function::Model {
 public:
  explicit IdentityModel(int d) : d_(d) {}
  int ambient_dim() const override { return d_; }
  int codim() const override { return d_; }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    std::copy(points.begin(), points.end(), values.begin());
  }
  void jacobian(std::span<const double>, std::span<double> jacobian, double) const override {
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    for (int i = 0; i < d_; ++i) jacobian[static_cast<std::size_t>(i) * d_ + i] = 1;
  }

 private:
  int d_;
};

class MultipliedModel : public Function::Model {
 public:
  MultipliedModel(Function f, std::vector<double> factors) : f_(std::move(f)), factors_(std::move(factors)) {}
  int ambient_dim() const override { return f_.ambient_dim(); }
  int codim() const override { return f_.codim(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    f_.evaluate(points, values);
    const std::size_t k = codim();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] *= factors_[i % k];
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const override {
    f_.jacobian(point, jacobian, length_scale);
    const std::size_t d = ambient_dim();
    for (std::size_t i = 0; i < jacobian.size(); ++i) jacobian[i] *= factors_[i / d];
  }

 private:
  Function f_;
  std::vector<double> factors_;
};

}  // namespace

Function product(Function f, Function g) {
  return Function(std::make_shared<ProductModel>(std::move(f), std::move(g)));
}

Function embed(Function f, int ambient_dim) {
  const int extra = ambient_dim - f.ambient_dim();
  if (extra < 0) {
    throw InvalidInput("embed: ambient_dim " + std::to_string(ambient_dim) + " is less than that of the function, " +
                       std::to_string(f.ambient_dim()));
  }
  if (extra == 0) return f;
  return product(std::move(f), Function(std::make_shared<IdentityModel>(extra)));
}

Function rotate(Function f, const Matrix& Q) {
  const std::ptrdiff_t d = f.ambient_dim();
  require_size("rotate: rows of Q", static_cast<std::size_t>(Q.rows()), static_cast<std::size_t>(d));
  require_size("rotate: columns of Q", static_cast<std::size_t>(Q.cols()), static_cast<std::size_t>(d));
  require_finite("rotate: Q", all_finite(Q.entries()));
  double deviation = 0;
  for (std::ptrdiff_t i = 0; i < d; ++i) {
    for (std::ptrdiff_t j = 0; j <= i; ++j) {
      double dot = 0;
      for (std::ptrdiff_t l = 0; l < d; ++l) dot += Q(l, i) * Q(l, j);
      deviation = std::max(deviation, std::abs(dot - (i == j)));
    }
  }
  if (!(deviation <= 1e-9)) {
    throw InvalidInput("rotate: Q is not orthogonal, Q^T Q deviates from the identity by " + std::to_string(deviation));
  }
  InverseRotation map;
  for (std::ptrdiff_t i = 0; i < d; ++i) {
    for (std::ptrdiff_t j = 0; j < d; ++j) {
      map.q.push_back(Q(i, j));
      map.q_transposed.push_back(Q(j, i));
    }
  }
  return compose(std::move(f), std::move(map));
}

Function translate(Function f, std::span<const double> b) {
  require_size("translate: b", b.size(), static_cast<std::size_t>(f.ambient_dim()));
  require_finite("translate: b", all_finite(b));
  return compose(std::move(f), InverseTranslation{{b.begin(), b.end()}});
}

Function scale(Function f, double s) {
  if (!(s > 0) || !std::isfinite(s))
    throw InvalidInput("scale: s must be positive and finite, not " + std::to_string(s));
  return compose(std::move(f), InverseScaling{s});
}

Function multiply_values(Function f, std::span<const double> factors) {
  require_size("multiply_values: factors", factors.size(), static_cast<std::size_t>(f.codim()));
  require_finite("multiply_values: factors", all_finite(factors));
  if (std::ranges::find(factors, 0.0) != factors.end()) throw InvalidInput("multiply_values: a factor is 0");
  return Function(std::make_shared<MultipliedModel>(std::move(f), std::vector<double>(factors.begin(), factors.end())));
}

Function permute_variables(Function f, std::span<const int> permutation) {
  require_size("permute_variables: permutation", permutation.size(), static_cast<std::size_t>(f.ambient_dim()));
  std::vector<int> sorted(permutation.begin(), permutation.end());
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i] != static_cast<int>(i)) {
      throw InvalidInput("permute_variables: not a permutation of 0 .. " + std::to_string(sorted.size() - 1));
    }
  }
  return compose(std::move(f), InversePermutation{{permutation.begin(), permutation.end()}});
}

}  // namespace whitney
