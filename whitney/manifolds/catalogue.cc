// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/catalogue.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <coxeter/base/error.h>
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

struct Entry {
  const char* name;
  std::vector<std::pair<const char*, double>> defaults;
  Submanifold (*make)(const Values&);
};

/// Stands for intrinsic_dim + 1.
constexpr double kOneMore = 0;

const std::vector<Entry>& entries() {
  static const std::vector<Entry> list = {
      {"flat_torus",
       {{"ambient_dim", 4}, {"r1", 1}, {"r2", 1}},
       [](const Values& v) { return closed_form::flat_torus(v.integer("ambient_dim"), v.real("r1"), v.real("r2")); }},
      {"grassmann", {{"p", 2}, {"q", 4}}, [](const Values& v) { return grassmann(v.integer("p"), v.integer("q")); }},
      {"klein_bottle", {}, [](const Values&) { return klein_bottle(); }},
      {"projective_plane", {}, [](const Values&) { return projective_plane(); }},
      {"projective_plane_projectors", {}, [](const Values&) { return projective_plane_projectors(); }},
      {"so3_matrices", {}, [](const Values&) { return so3_matrices(); }},
      {"so3_vectors", {}, [](const Values&) { return stiefel(2, 3); }},
      {"special_orthogonal", {{"q", 3}}, [](const Values& v) { return special_orthogonal(v.integer("q")); }},
      {"sphere",
       {{"intrinsic_dim", 2}, {"ambient_dim", kOneMore}, {"radius", 1}},
       [](const Values& v) {
         const int n = v.integer("intrinsic_dim"), d = v.integer("ambient_dim");
         return closed_form::sphere(n, d == kOneMore ? n + 1 : d, v.real("radius"));
       }},
      {"stiefel", {{"p", 2}, {"q", 3}}, [](const Values& v) { return stiefel(v.integer("p"), v.integer("q")); }},
      {"torus_of_revolution",
       {{"R", 2}, {"r", 1}},
       [](const Values& v) { return closed_form::torus_of_revolution(v.real("R"), v.real("r")); }},
  };
  return list;
}

}  // namespace

Submanifold named_submanifold(std::string_view name, const std::map<std::string, double>& parameters) {
  std::string list;
  for (const Entry& entry : entries()) {
    if (name == entry.name) return entry.make(Values(entry.name, entry.defaults, parameters));
    list += (list.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw InvalidInput("unknown submanifold '" + std::string(name) + "'; known are " + list);
}

std::vector<std::string> submanifold_names() {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) names.emplace_back(entry.name);
  return names;
}

}  // namespace whitney
