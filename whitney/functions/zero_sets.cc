// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/zero_sets.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/functions/combinators.h>
#include <whitney/functions/expression.h>

namespace whitney {
namespace {

using Strings = std::vector<std::string>;
using Box = std::vector<std::array<double, 2>>;

/// A text that is read back as the same double.
std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "(%.17g)", value);
  return text;
}

/// x1 .. xd
Strings coordinates(int d) {
  Strings names;
  for (int i = 1; i <= d; ++i) names.emplace_back("x").append(std::to_string(i));
  return names;
}

Box cube(int d, double half_width) { return Box(d, {-half_width, half_width}); }

/// Adds zero coordinates; the box gets the given half width there.
NamedManifold embedded(NamedManifold manifold, int ambient_dim, double half_width) {
  manifold.function = embed(std::move(manifold.function), ambient_dim);
  manifold.point.resize(ambient_dim, 0.0);
  manifold.box.resize(ambient_dim, {-half_width, half_width});
  return manifold;
}

void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidInput(message);
}

/// Parameters of a problem file on their way into a constructor.
class Arguments {
 public:
  Arguments(std::string name, const std::map<std::string, double>& values, Strings known)
      : name_(std::move(name)), values_(values) {
    for (const auto& [key, value] : values) {
      if (std::find(known.begin(), known.end(), key) != known.end()) continue;
      std::string list;
      for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
      throw InvalidInput(name_ + ": unknown parameter '" + key + "'; " +
                         (known.empty() ? "it has none" : "it has " + list));
    }
  }
  double real(const std::string& key, double fallback) const {
    const auto found = values_.find(key);
    return found == values_.end() ? fallback : found->second;
  }
  int integer(const std::string& key, int fallback) const {
    const double value = real(key, fallback);
    require(value == std::floor(value) && std::abs(value) <= 1e6, name_ + ": " + key + " must be an integer");
    return static_cast<int>(value);
  }

 private:
  std::string name_;
  const std::map<std::string, double>& values_;
};

struct Entry {
  const char* name;
  NamedManifold (*make)(const std::map<std::string, double>&);
};

const Entry kManifolds[] = {
    {"chair", [](const auto& p) { return chair(Arguments("chair", p, {"ambient_dim"}).integer("ambient_dim", 3)); }},
    {"cyclo_heptane", [](const auto& p) { return Arguments("cyclo_heptane", p, {}), cyclo_heptane(); }},
    {"flat_torus",
     [](const auto& p) {
       const Arguments a("flat_torus", p, {"ambient_dim", "r1", "r2"});
       return flat_torus(a.integer("ambient_dim", 4), a.real("r1", 1), a.real("r2", 1));
     }},
    {"pentagon_linkage", [](const auto& p) { return Arguments("pentagon_linkage", p, {}), pentagon_linkage(); }},
    {"so3_vectors", [](const auto& p) { return Arguments("so3_vectors", p, {}), so3_vectors(); }},
    {"sphere",
     [](const auto& p) {
       const Arguments a("sphere", p, {"intrinsic_dim", "ambient_dim", "radius"});
       const int n = a.integer("intrinsic_dim", 2);
       return sphere(n, a.integer("ambient_dim", n + 1), a.real("radius", 1));
     }},
    {"torus_of_revolution",
     [](const auto& p) {
       const Arguments a("torus_of_revolution", p, {"R", "r"});
       return torus_of_revolution(a.real("R", 2), a.real("r", 1));
     }},
    {"trefoil", [](const auto& p) { return Arguments("trefoil", p, {}), trefoil(); }},
    {"two_spheres", [](const auto& p) { return Arguments("two_spheres", p, {}), two_spheres(); }},
};

/// Manifolds that are known but are not the zero set of regular equations: what to do instead.
const std::pair<const char*, const char*> kNoZeroSets[] = {
    {"klein_bottle", "it is not orientable, so no regular zero set: use `whitney triangulate`"},
    {"projective_plane", "it is not orientable, so no regular zero set: use `whitney triangulate`"},
    {"projective_plane_projectors", "it is not orientable, so no regular zero set: use `whitney triangulate`"},
    {"so3_matrices", "it is known by its closest points only: use `whitney triangulate`"},
    {"klein_quartic", "it is made of charts: give its equation under the key \"projective\""},
    {"alvarez_deroin", "it is made of charts: give its equation under the key \"projective\""},
};

}  // namespace

NamedManifold sphere(int intrinsic_dim, int ambient_dim, double radius) {
  require(intrinsic_dim >= 1 && intrinsic_dim < ambient_dim,
          "sphere: 1 <= intrinsic_dim < ambient_dim is needed, not " + std::to_string(intrinsic_dim) + " and " +
              std::to_string(ambient_dim));
  require(radius > 0 && std::isfinite(radius * radius) && radius * radius > 0, "sphere: radius must be positive");
  const Strings x = coordinates(intrinsic_dim + 1);
  std::string equation;
  for (const std::string& xi : x) equation += xi + "^2+";
  equation.back() = '-';
  equation += number(radius) + "^2";
  NamedManifold result{parse_equations(x, Strings{equation}), std::vector<double>(x.size(), 0.0),
                       cube(intrinsic_dim + 1, 1.5 * radius)};
  result.point[0] = radius;
  return embedded(std::move(result), ambient_dim, 1.5 * radius);
}

NamedManifold flat_torus(int ambient_dim, double r1, double r2) {
  require(ambient_dim >= 4, "flat_torus: ambient_dim must be at least 4, not " + std::to_string(ambient_dim));
  for (const double r : {r1, r2})
    require(r > 0 && std::isfinite(r * r) && r * r > 0, "flat_torus: r1 and r2 must be positive");
  const double half_width = 2 * std::max(r1, r2);
  return embedded(
      {parse_equations(coordinates(4), Strings{"x1^2+x2^2-" + number(r1) + "^2", "x3^2+x4^2-" + number(r2) + "^2"}),
       {r1, 0, r2, 0},
       cube(4, half_width)},
      ambient_dim, half_width);
}

NamedManifold chair(int ambient_dim) {
  require(ambient_dim >= 3, "chair: ambient_dim must be at least 3, not " + std::to_string(ambient_dim));
  // On the z axis, with s^2 = 0.4: z^2 - 0.8 = s (1 - z^2).
  const double s = std::sqrt(0.4), z = std::sqrt((0.8 + s) / (1 + s));
  return embedded(
      {parse_equations(Strings{"x", "y", "z"}, Strings{"(x^2+y^2+z^2-0.8)^2-0.4*((z-1)^2-2*x^2)*((z+1)^2-2*y^2)"}),
       {0, 0, z},
       cube(3, 2)},
      ambient_dim, 2);
}

NamedManifold pentagon_linkage() {
  const double turn = 2 * std::acos(-1.0) / 5;
  std::vector<double> regular;
  double x = 1, y = 0;
  for (int side = 1; side <= 3; ++side) {
    regular.push_back(x += std::cos(side * turn));
    regular.push_back(y += std::sin(side * turn));
  }
  return {parse_equations(Strings{"x3", "y3", "x4", "y4", "x5", "y5"},
                          Strings{"(x3-1)^2+y3^2-1", "(x4-x3)^2+(y4-y3)^2-1", "(x5-x4)^2+(y5-y4)^2-1", "x5^2+y5^2-1"}),
          std::move(regular), cube(6, 3)};
}

NamedManifold cyclo_heptane() {
  Strings variables;
  // Texts for the coordinates of z_1 .. z_7.
  std::vector<std::array<std::string, 3>> atom(7);
  for (int i = 1; i <= 7; ++i) {
    const std::string index = std::to_string(i);
    atom[i - 1] = {"x" + index, "y" + index, "z" + index};
    if (i == 1 || i == 7) {
      atom[i - 1] = {i == 1 ? "0" : "sqrt(2)", "0", "0"};
      continue;
    }
    variables.insert(variables.end(), atom[i - 1].begin(), atom[i - 1].end());
    if (i == 6) {
      variables.pop_back();
      atom[i - 1][2] = "0";
    }
  }
  Strings equations;
  const auto add_distance = [&](int i, int j, const std::string& squared) {
    std::string equation;
    for (int c = 0; c < 3; ++c) equation += "(" + atom[i][c] + "-" + atom[j][c] + ")^2+";
    equation.back() = '-';
    equations.push_back(equation + squared);
  };
  // The seventh bond, z_7 z_1, is fixed.
  for (int i = 0; i < 6; ++i) add_distance(i + 1, i, "2");
  for (int i = 0; i < 7; ++i) add_distance((i + 2) % 7, i, "16/3");
  // A point found by Newton's method from a random start.
  return {parse_equations(variables, equations),
          {-0.47140452079103146, 0.68329099346252442, 1.1449415688281976, -0.75052654027327159, 2.0284903985460305,
           0.80948746048677789, 0.41340789817569257, 2.8109259886385343, 0.99128726892751917, 1.5222522826904912,
           1.9618025441164257, 1.213668713506215, 1.8856180831641267, 1.3333333333333333},
          cube(14, 4)};
}

NamedManifold so3_vectors() {
  return {parse_equations(Strings{"u1", "u2", "u3", "v1", "v2", "v3"},
                          Strings{"u1^2+u2^2+u3^2-1", "v1^2+v2^2+v3^2-1", "u1*v1+u2*v2+u3*v3"}),
          {1, 0, 0, 0, 1, 0},
          cube(6, 2)};
}

NamedManifold trefoil() {
  // |z_2| = b solves b^3 + b^2 = 1; z_1 = i b^(3/2).
  const double b = 0.75487766624669276;
  return {parse_equations(Strings{"x1", "y1", "x2", "y2"},
                          Strings{"x1^2-y1^2+x2^3-3*x2*y2^2", "2*x1*y1+3*x2^2*y2-y2^3", "x1^2+y1^2+x2^2+y2^2-1"}),
          {0, b * std::sqrt(b), b, 0},
          cube(4, 1.5)};
}

NamedManifold two_spheres() {
  return {parse_equations(Strings{"x", "y", "z"}, Strings{"((x+2)^2+y^2+z^2-1)*((x-2)^2+y^2+z^2-1)"}),
          {3, 0, 0},
          {{-4, 4}, {-2, 2}, {-2, 2}}};
}

NamedManifold torus_of_revolution(double R, double r) {
  require(r > 0 && R > r && std::isfinite(R * R * R * R), "torus_of_revolution: 0 < r < R is needed");
  const std::string R2 = number(R) + "^2", r2 = number(r) + "^2";
  return {
      parse_equations(Strings{"x", "y", "z"}, Strings{"(x^2+y^2+z^2+" + R2 + "-" + r2 + ")^2-4*" + R2 + "*(x^2+y^2)"}),
      {R + r, 0, 0},
      {{-R - 2 * r, R + 2 * r}, {-R - 2 * r, R + 2 * r}, {-2 * r, 2 * r}}};
}

std::vector<std::string> manifold_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kManifolds) names.push_back(entry.name);
  return names;
}

NamedManifold named_manifold(std::string_view name, const std::map<std::string, double>& parameters) {
  for (const Entry& entry : kManifolds) {
    if (name == entry.name) return entry.make(parameters);
  }
  for (const auto& [known, reason] : kNoZeroSets) require(name != known, std::string(known) + ": " + reason);
  std::string list;
  for (const std::string& known : manifold_names()) list += (list.empty() ? "" : ", ") + known;
  throw InvalidInput("unknown manifold '" + std::string(name) + "'; known are " + list);
}

}  // namespace whitney
