// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <coxeter/base/matrix.h>

namespace whitney::coxeter {

/// A Coxeter-Freudenthal-Kuhn triangulation of R^d: the image of the Freudenthal triangulation of Z^d under
/// x = Lambda z + b. Immutable.
///
/// Its simplices have as vertices monotone chains z_0 < z_1 < .. < z_m in Z^d with z_m - z_0 in {0,1}^d; they are given
/// by permutahedral representations (see simplex.h), on which Lambda and b have no influence.
/// Source: SoCG 2021, Sect. 2.
class Triangulation {
 public:
  /// The image of the Freudenthal triangulation of Z^d under x = linear z + offset.
  /// linear: d x d, regular; offset: d. Throws InvalidInput on wrong sizes, values that are not finite, or a matrix
  /// that is numerically singular.
  Triangulation(Matrix linear, std::vector<double> offset);

  int ambient_dim() const { return static_cast<int>(offset_.size()); }
  const Matrix& linear() const { return linear_; }
  const std::vector<double>& offset() const { return offset_; }

  /// Longest edge of the d-simplices (a length). Every d-simplex has, up to symmetry, the same edges: the vectors
  /// Lambda e(U) over the proper subsets U of {0..d}, e_d = -(e_0 + .. + e_{d-1}).
  /// By closed form for freudenthal, coxeter_a and their similar copies (a Gram matrix with equal diagonal and equal
  /// off-diagonal entries up to 1e-12); for any other affine image the maximum is over 2^d - 1 subsets when d <= 20 and
  /// an upper bound (sum of column norms) beyond.
  double edge_length() const { return edge_length_; }

  /// x = Lambda z + b for one lattice vertex; z: d, x: d. The order of the additions is fixed (b, then column by
  /// column), so the same z gives the same bytes. Throws InvalidInput on wrong sizes.
  void cartesian(std::span<const std::int32_t> z, std::span<double> x) const;

  /// z = Lambda^-1 (x - b), in floating point; x: d. Throws InvalidInput on a wrong size.
  std::vector<double> lattice_coordinates(std::span<const double> x) const;

  /// The image of this triangulation under x -> matrix x + shift; matrix: d x d, regular; shift: d.
  /// Throws InvalidInput as the constructor does.
  Triangulation transformed(const Matrix& matrix, std::span<const double> shift) const;

  friend Triangulation freudenthal(int ambient_dim, double edge_length);
  friend Triangulation coxeter_a(int ambient_dim, double edge_length);

 private:
  struct Factors;

  Triangulation(Matrix linear, std::vector<double> offset, double edge_length);

  Matrix linear_;
  std::vector<double> offset_;
  std::shared_ptr<const Factors> factors_;  // of linear_; never changed, so copies share them
  double edge_length_ = 0;
};

/// The Freudenthal triangulation scaled so that the longest edge of a d-simplex, the cube's diagonal, is edge_length
/// (> 0, a length); the grid spacing is edge_length / sqrt(d), exactly so when the quotient is exact. Offset 0.
/// Throws InvalidInput unless 1 <= ambient_dim <= 65534 and edge_length is finite and positive.
Triangulation freudenthal(int ambient_dim, double edge_length);

/// The Coxeter triangulation of type A~_d with longest edge edge_length (> 0, a length), offset 0.
/// Lambda = s (I - c J), J all ones, c = (1 - 1/sqrt(d+1))/d: the symmetric square root of the Gram matrix I - J/(d+1)
/// of the vectors e_0 .. e_{d-1}; an edge e(U) with |U| = m has length s sqrt(m (d+1-m) / (d+1)), longest at
/// m = floor((d+1)/2). Throws as freudenthal does.
Triangulation coxeter_a(int ambient_dim, double edge_length);

}  // namespace whitney::coxeter
