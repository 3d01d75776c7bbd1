// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/parameters.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <coxeter/base/error.h>
#include <coxeter/counts.h>
#include <coxeter/quality.h>

namespace whitney::perturbation {
namespace {

/// log10 of the volume of the unit d-ball over that of the unit (d-1)-ball.
double log10_ball_over_equator(int d) {
  return (std::lgamma((d + 1) / 2.0) - std::lgamma(d / 2.0 + 1)) / std::numbers::ln10 +
         std::log10(std::numbers::pi) / 2;
}

double log10_num_faces(int d, int m, Variant variant) {
  double sum = variant == Variant::kAsPrinted ? 2 : 1;
  if (variant == Variant::kAsPrinted)
    for (int j = 1; j <= m; ++j) sum += coxeter::num_ordered_partitions(d + 1, j);
  else
    for (int j = 0; j <= m; ++j) sum += coxeter::num_simplices_in_star(d, j);
  return std::log10(sum);
}

}  // namespace

WhitneyParameters whitney_parameters(int d, int n, Variant variant, double reach) {
  if (n < 1 || n >= d || d > 140)
    throw InvalidInput("need 1 <= intrinsic dimension < ambient dimension <= 140, not " + std::to_string(n) + " and " +
                       std::to_string(d));
  if (!(reach > 0) || !std::isfinite(reach)) throw InvalidInput("reach must be finite and positive");
  const bool printed = variant == Variant::kAsPrinted;
  const int codim = d - n;
  const coxeter::Quality quality = coxeter::coxeter_a_quality(d, 1);
  const double thickness = printed && d % 2 == 1 ? std::sqrt(2.0 / d) : quality.thickness;
  const double separation = quality.shortest_edge / quality.circumradius;
  const double stable = thickness * separation * quality.protection / (18 * d);
  const double radius = std::min(stable, thickness * thickness / 24);

  WhitneyParameters p{};
  p.ambient_dim = d;
  p.intrinsic_dim = n;
  p.variant = variant;
  p.log10_thickness = std::log10(thickness);
  p.log10_separation = std::log10(separation);
  p.log10_protection = std::log10(quality.protection);
  p.log10_num_faces = log10_num_faces(d, codim - 1, variant);
  const double ratio = log10_ball_over_equator(d);
  p.log10_slab = (printed ? -ratio : ratio) - std::log10(4.0) - p.log10_num_faces;
  p.log10_max_displacement = std::log10(radius);
  const double distance = p.log10_slab + p.log10_max_displacement;  // (19): rho_1 c~
  const double first = printed ? std::log10(2.0) : 0;               // (9): alpha_0
  for (int k = 0; k <= codim; ++k) p.log10_alpha.push_back(first + k * (distance + std::log10(2.0 / 3)));
  const double quotient = (1 - 8 * radius / (thickness * thickness)) / (1 + 2 * radius);
  p.log10_perturbed_thickness = std::log10(4 * thickness * quotient / (5 * std::sqrt(d)));
  const double log10_hit = std::log10(printed ? coxeter::num_faces(d - 1, n - 1) : coxeter::num_faces(d, n - 1));
  p.log10_zeta = p.log10_perturbed_thickness + std::log10(2.0 / 3) - log10_hit;
  const double log10_power = (4 + 2 * n) * p.log10_alpha.back() + 2 * n * p.log10_zeta;
  const double deviation = log10_power - std::log10(6.0 * (n + 1) * (n + 1));  // (11)
  const double squared = std::pow(10, 2 * deviation);                          // 0 where it underflows
  p.log10_edge_length_over_reach = deviation + std::log10(2.0) - std::log10(squared + 36);
  p.log10_edge_length = p.log10_edge_length_over_reach + std::log10(reach);

  const auto add = [&](std::string symbol, std::string equation, std::string meaning, double log10) {
    p.list.push_back({std::move(symbol), std::move(equation), std::move(meaning), log10});
  };
  add("c", "(2)", "displacements below c L keep the Delaunay combinatorics", std::log10(stable));
  add("t", "(3)", "thickness of T: least altitude / longest edge", p.log10_thickness);
  add("mu_0", "(3)", "separation of T: shortest edge / circumradius", p.log10_separation);
  add("delta/L", "(3)", "protection of T / longest edge", p.log10_protection);
  add("N", "(4)", "bound of the faces of dim <= d-n-1 around a vertex", p.log10_num_faces);
  add("rho_1", "(5)", "half-width of N slabs that leave half a unit ball free", p.log10_slab);
  add("c~", "(6)", "largest displacement / L, the radius in (17)", p.log10_max_displacement);
  for (int k = 0; k <= codim; ++k)
    add("alpha_" + std::to_string(k), k == 0 ? "(9)" : "(8)",
        k == 0   ? "start of the recursion"
        : k == 1 ? "distance of vertices near M from M / L"
                 : "distance of " + std::to_string(k - 1) + "-faces from M / L",
        p.log10_alpha[static_cast<std::size_t>(k)]);
  add("zeta", "(10)", "quality of the simplices of K, with powers of alpha", p.log10_zeta);
  add("h(6L)/L", "(11)", "allowed departure of M from a tangent plane within 6 L, / L", deviation);
  add("L/rch", "(12)", "longest edge / reach", p.log10_edge_length_over_reach);
  add("alpha^2/54", "(13)", "weaker bound of L/rch", 2 * p.log10_alpha.back() - std::log10(54.0));
  add("L~/L", "(15)", "bound of the longest edge of T~ / L", std::log10(1 + 2 * radius));
  add("t~", "(16)", "bound of the thickness of T~", p.log10_perturbed_thickness);
  add("rho_1 c~", "(19)", "distance of a moved vertex from every span / L", distance);
  add("w/(2L)", "-", "largest displacement / L that our embedding proof allows", std::log10(quality.width / 2));
  return p;
}

}  // namespace whitney::perturbation
