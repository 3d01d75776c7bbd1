// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <whitney/functions/function.h>

namespace whitney {

/// An isomanifold with a known answer.
struct NamedManifold {
  Function function;                       ///< with exact derivatives
  std::vector<double> point;               ///< d, one point of the manifold, up to rounding
  std::vector<std::array<double, 2>> box;  ///< d x (lower, upper): holds the manifold, with some room around it
};

// All numbers must be finite; each function throws InvalidInput outside the ranges given here.

/// x_1^2 + .. + x_(n+1)^2 = radius^2, the other coordinates 0. 1 <= n < d, radius > 0.
/// The sphere S^n: chi = 1 + (-1)^n, H_0 = H_n = Z.
NamedManifold sphere(int intrinsic_dim, int ambient_dim, double radius = 1);

/// x_1^2 + x_2^2 = r1^2, x_3^2 + x_4^2 = r2^2, the other coordinates 0. d >= 4. A torus: chi 0, H_1 = Z^2.
NamedManifold flat_torus(int ambient_dim = 4, double r1 = 1, double r2 = 1);

/// (x^2+y^2+z^2-0.8)^2 - 0.4 ((z-1)^2-2x^2) ((z+1)^2-2y^2) = 0, the other coordinates 0. d >= 3.
/// The surface "chair" of SoCG 2021, Fig. 3: connected, genus 3, chi -4.
NamedManifold chair(int ambient_dim = 3);

/// Plane pentagons with sides 1, P_1 = (0,0) and P_2 = (1,0) fixed: (P_3, P_4, P_5) in R^6.
/// A closed connected orientable surface of genus 4, chi -6.
NamedManifold pentagon_linkage();

/// Cyclo-heptane: seven atoms z_1 .. z_7, squared bond lengths c^2 = 2, squared distances of second neighbours 8c^2/3,
/// z_1 = 0, z_7 = (c,0,0), z_6 in the plane z = 0: (z_2, z_3, z_4, z_5, z_6 without its last coordinate) in R^14.
/// A curve; four closed loops were found by tracing, at several edge lengths. Source: SoCG 2021, Sect. 4.
NamedManifold cyclo_heptane();

/// SO(3) as pairs (u, v) of orthogonal unit vectors in R^6: the projective space RP^3, chi 0, H_1 = Z/2, orientable.
NamedManifold so3_vectors();

/// z_1^2 + z_2^3 = 0, |z_1|^2 + |z_2|^2 = 1 in C^2 = R^4: a knotted circle in S^3, one loop.
NamedManifold trefoil();

/// Unit spheres around (-2,0,0) and (2,0,0) in R^3 as one zero set: two components, chi 4.
NamedManifold two_spheres();

/// The torus with tube radius r around the circle of radius R in the plane z = 0 of R^3. 0 < r < R. chi 0, H_1 = Z^2.
/// As a polynomial, so that it is smooth on the axis too.
NamedManifold torus_of_revolution(double R = 2, double r = 1);

/// The manifold of a problem file: its name, as above, and values for the parameters that have them: sphere
/// (intrinsic_dim, ambient_dim, radius), flat_torus (ambient_dim, r1, r2), chair (ambient_dim), torus_of_revolution (R,
/// r). Parameters that are not given take the defaults above; sphere: 2 and intrinsic_dim + 1. Throws InvalidInput on
/// an unknown name or parameter (the message lists the known ones), and on manifolds that are no regular zero sets and
/// wait for other sources.
NamedManifold named_manifold(std::string_view name, const std::map<std::string, double>& parameters = {});

/// The names that named_manifold knows, sorted.
std::vector<std::string> manifold_names();

}  // namespace whitney
