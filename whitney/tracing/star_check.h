// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <coxeter/triangulation.h>
#include <whitney/functions/enclosure.h>

namespace whitney {

/// The pieces of the time interval [0, 1] of the isotopy: end points.
inline constexpr std::array<double, 5> kIsotopyTimes{0, 0.08, 0.25, 0.5, 1};
inline constexpr int kIsotopyPieces = 4;

/// What is proved about the star of one lattice vertex v; see CERTIFICATE.md for the symbols.
struct StarReport {
  enum class Outcome : std::uint8_t {
    kRegular,    ///< a positive w with B w < w was found for every piece of time
    kUnbounded,  ///< second derivatives are not bounded over the star: f may not be defined or not smooth there
    kSingular,   ///< Df(v) has, in floating point, rank below k: no proof, but no C either
    kEmpty,      ///< no F_t has a zero in the star. Never so next to a crossed simplex: what contradicts itself fails
    kIrregular   ///< B has a spectral radius of 1 or more, as far as this test sees
  };
  Outcome outcome = Outcome::kIrregular;
  double radius = 0;  ///< an estimate of the largest spectral radius of B
  /// By piece of time: a bound for the change of sums of hat functions along the isotopy, times the piece's length.
  std::array<double, kIsotopyPieces> drop{};
  /// By piece of time: how far the isotopy moves a point while it is in the star (a length). A point may be in other
  /// stars in other pieces: the largest ones of all stars add up.
  std::array<double, kIsotopyPieces> displacement{};

  bool is_regular() const { return outcome == Outcome::kRegular; }
  double total_drop() const { return drop[0] + drop[1] + drop[2] + drop[3]; }
};

/// Tests one star after the other. Everything that a verdict rests on is rounded outward; only the guesses (the inverse
/// C, the middle of M C, its inverse, the vector w) are plain floating point.
class StarCheck {
 public:
  /// value_error: k upper bounds for |value used by the tracer - f| at all lattice vertices at which it asked.
  /// sample: m x d lattice vertices by which equations are scaled.
  StarCheck(const Enclosure& f, const coxeter::Triangulation& triangulation, std::span<const double> value_error,
            std::span<const std::int32_t> sample);

  StarReport operator()(std::span<const std::int32_t> vertex);

  /// Encloses the exact position Lambda z + b; box: d.
  void enclose_vertex(std::span<const std::int32_t> vertex, std::span<Range> box) const;
  /// Encloses the star of the vertex given last to enclose_vertex.
  void enclose_star(std::span<const Range> vertex_box, std::span<Range> box) const;

 private:
  /// What is known of one equation over a star; lattice coordinates unless said otherwise.
  struct Equation {
    double scale = 1;  ///< a power of 2
    double value_error = 0;
    bool is_linear = false, is_curvature_known = false;
    std::vector<double> hessian;                   ///< d x d, middle
    std::vector<double> curvature;                 ///< pairs i < j <= d: half of |a_ij|
    std::vector<double> column_sums;               ///< d: sum over i of |hessian_ij|
    double plus = 0, minus = 0;                    ///< sums of the positive and of the negative a_ij
    double rounding = 0;                           ///< the largest sum of a row of what hessian may be off by
    std::vector<double> spread;                    ///< d: Cartesian remainder, sum over j of R_ij reach_j
    std::vector<double> lattice_spread;            ///< d: the remainder along each lattice direction
    double interpolation_error = 0;                ///< e: |g^ - g| on the star
    double quadratic_low = 0, quadratic_high = 0;  ///< of u H u / 2 over the star
  };

  bool load(std::span<const std::int32_t> vertex);
  bool set_curvature(Equation& equation, const Range* hessian);
  bool choose_inverse();
  /// The entries of M C, smooth and piecewise linear; false: no zero in the star.
  bool enclose_products();
  void enclose_products_of(int a);
  void conclude(int num_pieces, StarReport& report);
  bool conclude_piece(double begin, double end, StarReport& report, double& drop, double& displacement);
  double half_variation(const double* c) const;
  double length(const double* c) const;
  double range(const double* h) const;

  const Enclosure& f_;
  int d_, k_, pairs_;
  std::vector<double> lambda_, inverse_, offset_;  ///< d x d row-major; inverse: a guess; d
  std::vector<double> reach_;                      ///< d: |x_i - v_i| over a star
  double longest_ = 0, spread_of_simplex_ = 0;     ///< longest edge; tr Cov of points of a d-simplex at most
  std::vector<Equation> equations_;
  Enclosure::Workspace workspace_;
  Enclosure::Jets jets_, star_jets_;
  std::vector<Range> vertex_box_, star_box_;
  std::vector<double> value_, value_radius_;           // k
  std::vector<double> cartesian_gradient_;             // k x d
  std::vector<double> gradient_, gradient_radius_;     // k x d, lattice
  std::vector<double> gradient_sum_, radius_sum_;      // k: sums of absolute values of rows
  std::vector<double> c_, c_cartesian_, differences_;  // k x d; k x d absolute values; k x pairs absolute values
  std::vector<double> c_sum_;                          // k: sum of |c|
  std::vector<double> smooth_low_, smooth_high_, linear_low_, linear_high_;  // k x k
  bool is_empty_ = false;
  std::vector<double> mid_, spread_, guess_, b_, neumann_;  // k x k
  std::vector<double> w_, sigma_, columns_;                 // k; k; k x d
  mutable std::vector<double> sort_;
  std::vector<double> scratch_;
};

}  // namespace whitney
