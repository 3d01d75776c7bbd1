// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/tracing/certificate.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

#include <coxeter/base/error.h>
#include <coxeter/base/hash_mix.h>
#include <coxeter/tables/vertex_table.h>
#include <whitney/tracing/star_check.h>

namespace whitney {
namespace {

using Verdict = IsotopyCertificate::Verdict;
using Drops = std::array<double, kIsotopyPieces>;

constexpr std::size_t kSampleSize = 32;
constexpr std::size_t kStarsBetweenChecks = 256;

double total(const Drops& drops) {
  double sum = 0;
  for (const double drop : drops) sum += drop;
  return sum * (1 + 1e-12);
}

void raise(Drops& drops, const Drops& others) {
  for (int i = 0; i < kIsotopyPieces; ++i) drops[i] = std::max(drops[i], others[i]);
}

const char* failure_text(StarReport::Outcome outcome) {
  switch (outcome) {
    case StarReport::Outcome::kUnbounded:
      return "second derivatives are not bounded here";
    case StarReport::Outcome::kSingular:
      return "the Jacobian has no full rank here";
    case StarReport::Outcome::kEmpty:
      return "the equations exclude a zero here, but the trace found one";
    case StarReport::Outcome::kIrregular:
      return "the derivative turns too much over one edge";
    default:
      return "the isotopy may leave the stars tested";
  }
}

class Certifier {
 public:
  Certifier(const Enclosure& f, const coxeter::Triangulation& triangulation, const TraceResult& trace,
            const CertifyOptions& options)
      : f_(f), triangulation_(triangulation), trace_(trace), options_(options), d_(f.ambient_dim()) {}

  IsotopyCertificate run() {
    if (!rounds_to_nearest()) {
      refuse(Verdict::kNotCovered, "this process does not round to the nearest double, or flushes small ones to zero");
      return std::move(result_);
    }
    result_.has_exact_constants = f_.has_exact_constants();
    if (is_covered() && bound_value_errors()) {
      list_vertices();
      if (check_stars()) conclude();
    }
    result_.seconds = seconds();
    return std::move(result_);
  }

 private:
  std::span<const std::int32_t> vertex(std::size_t v) const { return trace_.vertex_coordinates().subspan(v * d_, d_); }
  bool refuse(Verdict verdict, std::string reason) {
    result_.verdict = verdict;
    result_.reason = std::move(reason);
    return false;
  }
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  bool is_stopped(std::size_t num_stars) const {
    const RunControl& run = options_.run;
    return seconds() > run.time_limit ||
           (run.progress &&
            !run.progress({.phase = "certify", .simplices = num_stars, .evaluations = 0, .seconds = seconds()}));
  }
  bool is_covered();
  bool bound_value_errors();
  void list_vertices();
  bool check_stars();
  bool check_inequalities(const StarCheck& check, std::span<const std::int32_t> z);
  void conclude();
  void add_place(std::size_t v, double local_drop);
  /// Per vertex: the largest drops among the tested vertices whose coordinates differ by at most 2.
  std::vector<Drops> drops_around() const;

  const Enclosure& f_;
  const coxeter::Triangulation& triangulation_;
  const TraceResult& trace_;
  const CertifyOptions& options_;
  std::size_t d_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  IsotopyCertificate result_;
  std::vector<std::uint32_t> corners_;  // num_simplices x (k + 1)
  std::vector<std::uint32_t> tested_;   // the vertices of the simplices
  std::vector<StarReport> reports_;     // num_vertices, those of tested_ are filled in
  Enclosure::Workspace workspace_;
  Enclosure::Jets jets_;
};

bool Certifier::is_covered() {
  if (trace_.num_simplices() == 0) return refuse(Verdict::kNotCovered, "the trace found no simplices");
  if (!trace_.whole) return refuse(Verdict::kNotCovered, "the trace is not whole");
  if (!trace_.boundary.empty()) return refuse(Verdict::kNotCovered, "the manifold has a boundary or is cut by the box");
  if (trace_.domain.num_given() > 0 && !options_.inequalities) {
    return refuse(Verdict::kNotCovered, "the inequalities were not given to the certificate");
  }
  return true;
}

bool Certifier::bound_value_errors() {
  const std::size_t k = f_.codim();
  const StarCheck positions(f_, triangulation_, std::vector<double>(k, 0.0), {});
  result_.value_errors.assign(k, 0.0);
  std::vector<Range> box(d_);
  for (std::size_t v = 0; v < trace_.num_vertices(); ++v) {
    positions.enclose_vertex(vertex(v), box);
    f_.evaluate(box, 0, jets_, workspace_);
    for (std::size_t a = 0; a < k; ++a) {
      const double error = radius(jets_.values[a], trace_.vertex_values()[v * k + a]);
      if (!(error <= std::numeric_limits<double>::max())) {
        return refuse(Verdict::kNotCertified,
                      "f is not bounded near a lattice vertex at which the tracer evaluated it");
      }
      result_.value_errors[a] = std::max(result_.value_errors[a], error);
    }
  }
  return true;
}

void Certifier::list_vertices() {
  const std::size_t k = f_.codim(), count = trace_.num_simplices();
  coxeter::VertexTable table(static_cast<int>(d_));
  for (std::size_t v = 0; v < trace_.num_vertices(); ++v) {
    table.intern(vertex(v).data(), table.form_of(vertex(v).data()));
  }
  std::vector<char> is_corner(trace_.num_vertices(), false);
  corners_.resize(count * (k + 1));
  std::vector<std::int32_t> z(d_);
  for (std::size_t s = 0; s < count; ++s) {
    const auto base = vertex(trace_.base(s));
    for (std::size_t q = 0; q <= k; ++q) {
      // Vertex q is the base plus the parts before q.
      for (std::size_t c = 0; c < d_; ++c) {
        z[c] = base[c] + (static_cast<std::size_t>(trace_.part(s, static_cast<int>(c))) < q);
      }
      const std::uint32_t v = q == 0 ? trace_.base(s) : table.find(z.data(), table.form_of(z.data()));
      if (v >= trace_.num_vertices()) throw InvalidInput("certificate: a simplex has a vertex that the trace lacks");
      corners_[s * (k + 1) + q] = v;
      is_corner[v] = true;
    }
  }
  for (std::size_t v = 0; v < trace_.num_vertices(); ++v) {
    if (is_corner[v]) tested_.push_back(static_cast<std::uint32_t>(v));
  }
}

bool Certifier::check_inequalities(const StarCheck& check, std::span<const std::int32_t> z) {
  std::vector<Range> vertex_box(d_), star(d_);
  check.enclose_vertex(z, vertex_box);
  check.enclose_star(vertex_box, star);
  if (const auto& box = trace_.domain.box()) {
    for (std::size_t i = 0; i < d_; ++i) {
      if (!(star[i].lo > box->lower[i] && star[i].hi < box->upper[i])) return false;
    }
  }
  if (trace_.domain.num_given() == 0) return true;
  Enclosure::Workspace workspace;
  Enclosure::Jets jets;
  options_.inequalities->evaluate(star, 0, jets, workspace);
  for (const Range& value : jets.values) {
    if (!(value.lo > 0)) return false;
  }
  return true;
}

bool Certifier::check_stars() {
  std::vector<std::int32_t> sample;
  for (std::size_t i = 0; i < tested_.size(); i += 1 + tested_.size() / kSampleSize) {
    const auto z = vertex(tested_[i]);
    sample.insert(sample.end(), z.begin(), z.end());
  }
  StarCheck check(f_, triangulation_, result_.value_errors, sample);
  reports_.resize(trace_.num_vertices());
  std::vector<std::uint32_t> failing;
  for (std::size_t i = 0; i < tested_.size(); ++i) {
    if (i % kStarsBetweenChecks == 0 && is_stopped(i)) {
      return refuse(Verdict::kStopped, "a limit stopped the certificate");
    }
    const std::uint32_t v = tested_[i];
    reports_[v] = check(vertex(v));
    ++result_.num_stars;
    result_.worst_radius = std::max(result_.worst_radius, reports_[v].radius);
    if (!reports_[v].is_regular()) failing.push_back(v);
    if (!trace_.domain.empty() && !check_inequalities(check, vertex(v))) {
      return refuse(Verdict::kNotCovered, "an inequality, or a side of the box, may be met by the manifold");
    }
  }
  result_.num_failing = failing.size();
  if (failing.empty()) return true;
  std::stable_sort(failing.begin(), failing.end(),
                   [&](auto v, auto w) { return reports_[v].radius > reports_[w].radius; });
  for (const std::uint32_t v : failing) add_place(v, reports_[v].total_drop());
  return refuse(Verdict::kNotCertified, "the test fails at " + std::to_string(failing.size()) + " of " +
                                            std::to_string(result_.num_stars) + " lattice vertices");
}

void Certifier::add_place(std::size_t v, double local_drop) {
  const StarReport& report = reports_[v];
  // Both numbers are about linear in the edge length as long as they are small.
  const bool has_advice = report.is_regular() || report.outcome == StarReport::Outcome::kIrregular;
  const double factor = has_advice ? std::max(0.9 / std::max(report.radius, local_drop), 0.25) : 0.5;
  const double edge_length = factor * triangulation_.edge_length();
  double& advised = result_.advised_edge_length;
  advised = result_.places.empty() ? edge_length : std::min(advised, edge_length);
  if (result_.places.size() >= options_.max_places) return;
  IsotopyCertificate::Place place;
  place.point.resize(d_);
  triangulation_.cartesian(vertex(v), place.point);
  place.failure = failure_text(report.outcome);
  place.radius = report.radius;
  place.drop = local_drop;
  place.edge_length = edge_length;
  result_.places.push_back(std::move(place));
}

std::vector<Drops> Certifier::drops_around() const {
  // Maxima over all vertices whose first three coordinates differ by at most 2: coarser than needed, and quick.
  using Key = std::array<std::int32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::int32_t z : key) hash = coxeter::detail::hash_step(hash, static_cast<std::uint32_t>(z));
      return hash;
    }
  };
  const std::size_t axes = std::min<std::size_t>(d_, 3);
  const auto key = [&](std::uint32_t v, const Key& shift) {
    Key z{};
    for (std::size_t i = 0; i < axes; ++i) z[i] = vertex(v)[i] + shift[i];
    return z;
  };
  std::unordered_map<Key, Drops, Hash> own, near;
  for (const std::uint32_t v : tested_) raise(own[key(v, {})], reports_[v].drop);
  std::vector<Drops> around(trace_.num_vertices());
  for (const std::uint32_t v : tested_) {
    const auto [entry, is_new] = near.try_emplace(key(v, {}));
    for (int shift = 0; is_new && shift < 125; ++shift) {
      const auto found = own.find(key(v, {shift % 5 - 2, shift / 5 % 5 - 2, shift / 25 - 2}));
      if (found != own.end()) raise(entry->second, found->second);
    }
    around[v] = entry->second;
  }
  return around;
}

void Certifier::conclude() {
  const std::size_t k = f_.codim();
  Drops largest{}, farthest{};
  for (const std::uint32_t v : tested_) {
    raise(largest, reports_[v].drop);
    raise(farthest, reports_[v].displacement);
  }
  result_.distance_bound = total(farthest);
  result_.worst_drop = total(largest);
  if (!(result_.worst_drop < 1)) {
    // A point of the complex in the cell of a d-simplex that has a crossed face s moves, as long as its drop is below
    // 1, through stars of vertices of that d-simplex and their neighbors only: within 2 of the base of s.
    const std::vector<Drops> around = drops_around();
    result_.worst_drop = 0;
    std::vector<std::pair<double, std::uint32_t>> failing;
    for (std::size_t s = 0; s < trace_.num_simplices(); ++s) {
      std::uint32_t worst = corners_[s * (k + 1)];
      for (std::size_t q = 1; q <= k; ++q) {
        const std::uint32_t v = corners_[s * (k + 1) + q];
        if (reports_[v].total_drop() > reports_[worst].total_drop()) worst = v;
      }
      const Drops& local = around[trace_.base(s)];
      const double drop = total(local);
      result_.worst_drop = std::max(result_.worst_drop, drop);
      if (!(drop < 1)) failing.emplace_back(drop, worst);
    }
    if (!failing.empty()) {
      std::sort(failing.begin(), failing.end(), [](const auto& a, const auto& b) {
        return a.second != b.second ? a.second < b.second : a.first > b.first;
      });
      failing.erase(std::unique(failing.begin(), failing.end(),
                                [](const auto& a, const auto& b) { return a.second == b.second; }),
                    failing.end());
      std::stable_sort(failing.begin(), failing.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
      result_.num_failing = failing.size();
      for (const auto& [drop, v] : failing) add_place(v, drop);
      refuse(Verdict::kNotCertified, "near " + std::to_string(failing.size()) + " of " +
                                         std::to_string(result_.num_stars) +
                                         " lattice vertices the isotopy may leave the stars tested");
      return;
    }
  }
  result_.verdict = Verdict::kCertified;
}

}  // namespace

IsotopyCertificate certify_trace(const Enclosure& f, const coxeter::Triangulation& triangulation,
                                 const TraceResult& trace, const CertifyOptions& options) {
  const int d = trace.ambient_dim();
  if (f.ambient_dim() != d || triangulation.ambient_dim() != d || f.codim() != trace.codim()) {
    throw InvalidInput("certificate: f, the triangulation and the trace have different dimensions");
  }
  if (options.inequalities &&
      (options.inequalities->ambient_dim() != d || options.inequalities->codim() != trace.domain.num_given())) {
    throw InvalidInput("certificate: the inequalities are not those of the trace");
  }
  return Certifier(f, triangulation, trace, options).run();
}

}  // namespace whitney
