// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/catalogue.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/functions/zero_sets.h>
#include <whitney/manifolds/closed_form_manifolds.h>
#include <whitney/manifolds/immersed_surfaces.h>
#include <whitney/manifolds/matrix_manifolds.h>

namespace whitney {
namespace {

/// Values of the parameters, all of them known.
class Values {
 public:
  Values(const char* name, const std::vector<std::pair<const char*, double>>& defaults,
         const std::map<std::string, double>& given)
      : name_(name) {
    std::string list;
    for (const auto& [key, value] : defaults) {
      values_[key] = value;
      list += (list.empty() ? "" : ", ") + std::string(key);
    }
    for (const auto& [key, value] : given) {
      if (!values_.contains(key))
        throw InvalidInput(name_ + ": unknown parameter '" + key + "'; it has " + (list.empty() ? "none" : list));
      values_[key] = value;
    }
  }
  double real(const char* key) const { return values_.at(key); }
  int integer(const char* key) const {
    const double value = values_.at(key);
    if (value != std::floor(value) || !(std::abs(value) <= 1e6))
      throw InvalidInput(name_ + ": " + key + " must be an integer");
    return static_cast<int>(value);
  }

 private:
  std::string name_;
  std::map<std::string, double> values_;
};

/// The homology of the n-sphere, n >= 1.
ExpectedTopology of_sphere(int n) {
  ExpectedTopology topology{1 + (n % 2 == 0 ? 1 : -1), true, 1, std::vector<std::string>(n + 1, "0")};
  topology.homology.front() = topology.homology.back() = "Z";
  return topology;
}

/// Of the real projective space RP^m, m >= 1.
ExpectedTopology of_projective_space(int m) {
  ExpectedTopology topology{m % 2 == 0 ? 1 : 0, m % 2 == 1, 1, {"Z"}};
  for (int i = 1; i <= m; ++i) topology.homology.emplace_back(i % 2 == 0 ? "0" : i < m ? "Z/2" : "Z");
  return topology;
}

/// Of the closed orientable surface of genus g >= 1.
ExpectedTopology of_surface(int g) { return {2 - 2 * g, true, 1, {"Z", "Z^" + std::to_string(2 * g), "Z"}}; }

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

/// Gr(p, q): chi is 0 when the dimension is odd, otherwise C([q/2], [p/2]) (Schubert cells in pairs); orientable for
/// even q. H_*(Gr(2, 4)) by duality from H_1 = Z/2 and chi.
ExpectedTopology of_grassmannian(int p, int q) {
  if (p == 1 || p == q - 1) return of_projective_space(q - 1);
  const bool odd = p * (q - p) % 2 == 1;
  ExpectedTopology topology{odd ? 0 : std::llround(binomial(q / 2, p / 2)), q % 2 == 0, 1, {}};
  if (p == 2 && q == 4) topology.homology = {"Z", "Z/2", "Z/2", "0", "Z"};
  return topology;
}

/// V(p, q), p < q, and SO(q) for p = q: an odd sphere is a factor of chi as soon as p >= 2.
ExpectedTopology of_stiefel(int p, int q) {
  if (p == 1) return of_sphere(q - 1);
  if (p == 2 && q == 2) return of_sphere(1);
  if (q == 3) return of_projective_space(3);
  return {0, true, 1, {}};
}

struct Entry {
  const char* name;
  const char* description;
  std::vector<std::pair<const char*, double>> defaults;
  /// With the values that stand for others put in; null: no closest points, or no equations.
  Submanifold (*make)(const Values&);
  bool has_function;
  std::optional<ExpectedTopology> (*expected)(const Values&);
};

/// Stands for intrinsic_dim + 1.
constexpr double kOneMore = 0;

using Expected = std::optional<ExpectedTopology>;
constexpr std::nullptr_t kNone = nullptr;

const Entry kEntries[] = {
    {"chair",
     "a surface of genus 3 (SoCG 2021, Fig. 3)",
     {{"ambient_dim", 3}},
     kNone,
     true,
     [](const Values&) -> Expected { return of_surface(3); }},
    {"cyclo_heptane",
     "configurations of a ring of seven atoms: a curve in R^14",
     {},
     kNone,
     true,
     [](const Values&) -> Expected { return std::nullopt; }},
    {"flat_torus",
     "|(x1, x2)| = r1, |(x3, x4)| = r2",
     {{"ambient_dim", 4}, {"r1", 1}, {"r2", 1}},
     [](const Values& v) { return closed_form::flat_torus(v.integer("ambient_dim"), v.real("r1"), v.real("r2")); },
     true,
     [](const Values&) -> Expected { return of_surface(1); }},
    {"grassmann",
     "p-planes in R^q, as projectors",
     {{"p", 2}, {"q", 4}},
     [](const Values& v) { return grassmann(v.integer("p"), v.integer("q")); },
     false,
     [](const Values& v) -> Expected { return of_grassmannian(v.integer("p"), v.integer("q")); }},
    {"klein_bottle",
     "the Klein bottle in R^4",
     {},
     [](const Values&) { return klein_bottle(); },
     false,
     [](const Values&) -> Expected {
       return ExpectedTopology{0, false, 1, {"Z", "Z + Z/2", "0"}};
     }},
    {"pentagon_linkage",
     "plane pentagons with sides 1: genus 4, in R^6",
     {},
     kNone,
     true,
     [](const Values&) -> Expected { return of_surface(4); }},
    {"projective_plane",
     "the projective plane in R^4",
     {},
     [](const Values&) { return projective_plane(); },
     false,
     [](const Values&) -> Expected { return of_projective_space(2); }},
    {"projective_plane_projectors",
     "the projective plane in R^5: lines in R^3, as projectors",
     {},
     [](const Values&) { return projective_plane_projectors(); },
     false,
     [](const Values&) -> Expected { return of_projective_space(2); }},
    {"so3_matrices",
     "rotations of R^3, in R^9",
     {},
     [](const Values&) { return so3_matrices(); },
     false,
     [](const Values&) -> Expected { return of_projective_space(3); }},
    {"so3_vectors",
     "rotations of R^3 as pairs of orthonormal vectors, in R^6",
     {},
     [](const Values&) { return stiefel(2, 3); },
     true,
     [](const Values&) -> Expected { return of_projective_space(3); }},
    {"special_orthogonal",
     "rotations of R^q",
     {{"q", 3}},
     [](const Values& v) { return special_orthogonal(v.integer("q")); },
     false,
     [](const Values& v) -> Expected { return of_stiefel(v.integer("q"), v.integer("q")); }},
    {"sphere",
     "the sphere S^n",
     {{"intrinsic_dim", 2}, {"ambient_dim", kOneMore}, {"radius", 1}},
     [](const Values& v) {
       const int n = v.integer("intrinsic_dim"), d = v.integer("ambient_dim");
       return closed_form::sphere(n, d == kOneMore ? n + 1 : d, v.real("radius"));
     },
     true,
     [](const Values& v) -> Expected { return of_sphere(v.integer("intrinsic_dim")); }},
    {"stiefel",
     "p orthonormal vectors in R^q",
     {{"p", 2}, {"q", 3}},
     [](const Values& v) { return stiefel(v.integer("p"), v.integer("q")); },
     false,
     [](const Values& v) -> Expected { return of_stiefel(v.integer("p"), v.integer("q")); }},
    {"torus_of_revolution",
     "the torus with radii R > r",
     {{"R", 2}, {"r", 1}},
     [](const Values& v) { return closed_form::torus_of_revolution(v.real("R"), v.real("r")); },
     true,
     [](const Values&) -> Expected { return of_surface(1); }},
    {"trefoil", "a knotted circle in R^4", {}, kNone, true, [](const Values&) -> Expected { return of_sphere(1); }},
    {"two_spheres",
     "unit spheres around (-2, 0, 0) and (2, 0, 0)",
     {},
     kNone,
     true,
     [](const Values&) -> Expected {
       return ExpectedTopology{4, true, 2, {"Z^2", "0", "Z^2"}};
     }},
};

const Entry& entry_of(std::string_view name) {
  for (const Entry& entry : kEntries)
    if (name == entry.name) return entry;
  if (name == "klein_quartic" || name == "alvarez_deroin")
    throw InvalidInput(std::string(name) +
                       " is made of charts: give its equation under the key \"projective\" of a problem file");
  std::string list;
  for (const Entry& entry : kEntries) list += (list.empty() ? "" : ", ") + std::string(entry.name);
  throw InvalidInput("unknown manifold '" + std::string(name) + "'; known are " + list);
}

}  // namespace

KnownManifold known_manifold(std::string_view name, const std::map<std::string, double>& parameters) {
  const Entry& entry = entry_of(name);
  const Values values(entry.name, entry.defaults, parameters);
  KnownManifold known;
  if (entry.has_function) {
    NamedManifold zero_set = named_manifold(name, parameters);
    known.function = std::move(zero_set.function);
    known.point = std::move(zero_set.point);
    known.box = std::move(zero_set.box);
  }
  if (entry.make) {
    known.submanifold = entry.make(values);
    known.point = known.submanifold->seed_points();
    known.point.resize(known.submanifold->ambient_dim());
  }
  known.topology = entry.expected(values);
  return known;
}

std::vector<KnownName> known_manifolds() {
  std::vector<KnownName> names;
  for (const Entry& entry : kEntries) {
    KnownName known{entry.name, {}, entry.has_function, entry.make != nullptr, entry.description};
    for (const auto& [key, value] : entry.defaults) known.parameters.emplace_back(key, value);
    names.push_back(std::move(known));
  }
  return names;
}

Submanifold named_submanifold(std::string_view name, const std::map<std::string, double>& parameters) {
  std::string list;
  for (const Entry& entry : kEntries) {
    if (!entry.make) continue;
    if (name == entry.name) return entry.make(Values(entry.name, entry.defaults, parameters));
    list += (list.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw InvalidInput("unknown submanifold '" + std::string(name) + "'; known are " + list);
}

std::vector<std::string> submanifold_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kEntries)
    if (entry.make) names.emplace_back(entry.name);
  return names;
}

}  // namespace whitney
