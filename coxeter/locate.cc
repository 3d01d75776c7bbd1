// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/locate.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::coxeter {
namespace {

/// A fractional part in [0, 1), exactly: it is `residue` when that is >= 0, and 1 + residue when it is < 0. The
/// distance to the nearest integer is a double; the distance to the floor need not be (-1e-30).
struct Fraction {
  double residue;  // in (-1/2, 1/2]

  friend bool operator==(Fraction a, Fraction b) { return a.residue == b.residue; }
  friend bool operator>(Fraction a, Fraction b) {
    return (a.residue < 0) != (b.residue < 0) ? a.residue < 0 : a.residue > b.residue;
  }
};

Simplex locate_in_lattice(std::span<const double> z, bool full) {
  const std::size_t d = z.size();
  if (d == 0 || d >= std::numeric_limits<std::uint16_t>::max())
    throw InvalidInput("lattice_coordinates must have 1 .. 65534 entries");
  InlineArray<std::int32_t, 16> base(d);
  InlineArray<Fraction, 16> fractions(d + 1);
  for (std::size_t c = 0; c < d; ++c) {
    if (!std::isfinite(z[c])) throw InvalidInput("coordinate " + std::to_string(c) + " of the point is not finite");
    const double nearest = std::nearbyint(z[c]);
    double residue = z[c] - nearest;  // exact
    const double floor = residue < 0 ? nearest - 1 : nearest;
    if (residue == -0.5) residue = 0.5;
    if (floor < std::numeric_limits<std::int32_t>::min() || floor >= std::numeric_limits<std::int32_t>::max())
      throw LatticeOverflow("coordinate " + std::to_string(c) + " of the point leaves the range of int32");
    base[c] = static_cast<std::int32_t>(floor);
    fractions[c] = {residue};
  }
  fractions[d] = {0};
  IndexArray order(d + 1);
  std::iota(order.begin(), order.end(), std::uint16_t{0});
  // Element d has the fraction 0 and the largest index, so it stays last.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint16_t i, std::uint16_t j) { return fractions[i] > fractions[j]; });
  IndexArray part_indices(d + 1);
  std::uint16_t part = 0;
  for (std::size_t i = 0; i <= d; ++i) {
    if (i > 0 && (full || !(fractions[order[i]] == fractions[order[i - 1]]))) ++part;
    part_indices[order[i]] = part;
  }
  return Simplex(LatticeVertex(std::span<const std::int32_t>(base.data(), d)),
                 OrderedPartition::from_part_indices({part_indices.data(), part_indices.size()}));
}

Simplex locate_in(const Triangulation& triangulation, std::span<const double> x, bool full) {
  for (const double coordinate : x)
    if (!std::isfinite(coordinate)) throw InvalidInput("x must have finite entries");
  const std::vector<double> z = triangulation.lattice_coordinates(x);
  if (!all_finite(z)) throw LatticeOverflow("x is too far away from the origin of the lattice");
  return locate_in_lattice(z, full);
}

}  // namespace

Simplex locate_lattice(std::span<const double> lattice_coordinates) {
  return locate_in_lattice(lattice_coordinates, false);
}

Simplex locate(const Triangulation& triangulation, std::span<const double> x) {
  return locate_in(triangulation, x, false);
}

Simplex locate_full_lattice(std::span<const double> lattice_coordinates) {
  return locate_in_lattice(lattice_coordinates, true);
}

Simplex locate_full(const Triangulation& triangulation, std::span<const double> x) {
  return locate_in(triangulation, x, true);
}

}  // namespace whitney::coxeter
