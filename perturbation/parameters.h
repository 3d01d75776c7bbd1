// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace whitney::perturbation {

// The constants of BKW20: Boissonnat, Kachanovich, Wintraecken, Triangulating submanifolds: an elementary and
// quantified version of Whitney's method, DCG 2020, Sect. 4 and 5.1. From the dimensions alone they fix how far
// vertices may move, how far from M every face then stays, and the edge length L that is small enough. They serve as a
// yardstick: L is 10^-20 reach for a plane curve. All are kept as decimal logarithms, since they leave the range of
// double.
//
// The printed page was not at hand: the formulae come from the list of errata and from what independent public
// implementations of BKW20 quote, and were derived again where the tests say so. As printed, they give the L / reach
// quoted for the paper: 10^-20, 10^-31 and 10^-68 for (d, n) = (2, 1), (3, 2), (4, 2). Up to a relative error of A^2,
// (12) is L / reach = A / (108 (n+1)^2), where a factor from 30 to 110 would give these exponents too. Not checked
// against the text: this factor, the form of (13), which of (14) .. (19) is which, and what (1) and (18) are. One
// implementation takes half the mu_0 below at d = 3, which gives 10^-34. "Corrected" puts right what is listed here; no
// claim is made that the rest of the proof was gone through.
//
// With x = L / reach, A = alpha_(d-n)^(4+2n) zeta^(2n), m = d-n-1, r(d) = sqrt(pi) Gamma((d+1)/2) / Gamma(d/2+1), which
// is the volume of the unit ball over that of its equator, and S the Stirling numbers of the second kind:
//
//        as printed                                   corrected, where it differs
//   (3)  t = sqrt(2/d) for odd d,                     sqrt(2/(d+1)): brute force
//            sqrt(2(d+1) / (d(d+2))) for even d
//        mu_0 = sqrt(12/(d+2)), delta / L: see coxeter::Quality
//   (4)  N = 2 + sum_(j=1..m) j! S(d+1, j)            1 + sum_(j=0..m) (j+1)! S(d+1, j+1): brute force
//   (5)  rho_1 = 1 / (4 N r(d))                       r(d) / (4 N): slabs of half-width rho_1 then fill half the ball
//   (2)  c = t mu_0 delta / (18 d L)
//   (6)  c~ = min(c, t^2 / 24)
//   (7)  c~ <= 1/24, which (6) implies
//   (8)  alpha_1 = (4/3) rho_1 c~,                    (2/3) rho_1 c~: a plane M allows no more than rho_1 c~
//        alpha_k = (2/3) rho_1 c~ alpha_(k-1)
//   (9)  alpha_k = 2 (2 rho_1 c~ / 3)^k               (2 rho_1 c~ / 3)^k, so alpha_0 = 1
//   (10) zeta = 8 t (1 - 8 c~ / t^2) / (15 sqrt(d) C(d, d-n) (1 + 2 c~))
//                                                     C(d+1, n) in place of C(d, d-n): a plane meets 4 edges of a
//                                                     tetrahedron
//   (11) (1 - sqrt(1 - 36 x^2)) / x = A / (6 (n+1)^2)
//   (12) x = (A / (3 (n+1)^2)) / ((A / (6 (n+1)^2))^2 + 36)
//   (13) x < alpha_(d-n)^2 / 54, which (12) implies
//   (14) a k-face of T~, k <= m, is further than alpha_k L from M
//                                                     alpha_(k+1) L, so vertices get alpha_1
//   (15) the edges of T~ are at most (1 + 2 c~) L <= 13 L / 12
//   (16) the thickness of T~ is at least 4 t (1 - 8 c~ / t^2) / (5 sqrt(d) (1 + 2 c~))
//   (17) no vertex moves further than c~ L
//   (19) a moved vertex is at least rho_1 c~ L away from every span(tau'_j, T_p M)
//
// On (10): C(d+1, n) is safe, being the number of all (d-n)-faces. The largest number that a generic n-plane meets is
// that of the vertices of a simple n-polytope with d+1 facets: 4 at (3, 2), but 2 at (2, 1) and 5 at (4, 2), where what
// is printed suffices.

enum class Variant {
  kAsPrinted,
  kCorrected,
};

/// One constant.
struct Parameter {
  std::string symbol;
  std::string equation;  ///< "(3)"; "-" for what is not in the paper
  std::string meaning;   ///< one line
  double log10;          ///< of the value
};

struct WhitneyParameters {
  int ambient_dim;    ///< d
  int intrinsic_dim;  ///< n
  Variant variant;
  double log10_thickness;               ///< (3): t
  double log10_separation;              ///< (3): mu_0, the shortest edge over the circumradius
  double log10_protection;              ///< (3): delta / L
  double log10_num_faces;               ///< (4): N
  double log10_slab;                    ///< (5), (19): rho_1, a distance over the radius of the ball it is reached in
  double log10_max_displacement;        ///< (6), (17): c~, the radius of that ball over L
  std::vector<double> log10_alpha;      ///< (8): alpha_0 .. alpha_(d-n); distances from M over L
  double log10_perturbed_thickness;     ///< (16)
  double log10_zeta;                    ///< (10)
  double log10_edge_length_over_reach;  ///< (12): x
  double log10_edge_length;             ///< (12): L, in the unit of `reach`
  /// All of them and a few more, in the order of the equations; the same symbols in both variants.
  std::vector<Parameter> list;
};

/// The constants for an n-manifold in R^d. reach: of M (a length, > 0).
/// Throws InvalidInput unless 1 <= intrinsic_dim < ambient_dim <= 140 (N leaves the range of double soon after) and
/// reach is finite and positive.
WhitneyParameters whitney_parameters(int ambient_dim, int intrinsic_dim, Variant variant, double reach = 1);

}  // namespace whitney::perturbation
