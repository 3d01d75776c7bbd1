// SPDX-License-Identifier: GPL-3.0-or-later
#include <perturbation/violation.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <perturbation/certificate_proof.h>
#include <perturbation/inside.h>
#include <perturbation/interval.h>

namespace whitney::perturbation {
namespace {

/// A simplex of dimension m in R^d: m + 1 points, one after the other.
using Piece = std::vector<double>;

class Searcher {
 public:
  Searcher(PerturbedTriangulation& near, const ViolationOptions& options)
      : near_(near),
        options_(options),
        d_(near.ambient_dim()),
        k_(near.codim()),
        certificate_(d_, d_ - k_, near.oracle().reach(), near.oracle().curvature_radius(), k_),
        prover_(certificate_),
        feet_are_closest_(near.oracle().promise() ==
                          FootPromise{FootPromise::Place::kGlobal, FootPromise::Errors::kProven}),
        point_(d_),
        frame_(d_ * d_) {}

  std::optional<Violation> examine(std::uint32_t s) {
    const VertexSubsets& faces = near_.certificate().hit_candidates();
    bool all_empty = true;
    for (std::size_t f = 0; f < faces.num(); ++f) {
      Piece piece;
      for (int j = 0; j <= k_; ++j) {
        const double* x = near_.position(near_.corners(s)[faces[f][j]]);
        piece.insert(piece.end(), x, x + d_);
      }
      const Face face = look_at(piece);
      if (face.points.size() >= 2 * static_cast<std::size_t>(d_))
        return Violation{Violation::Kind::kTwoPointsOnFace, near_.simplex(s),
                         std::vector<int>(faces[f], faces[f] + k_ + 1), face.points};
      all_empty = all_empty && face.empty;
    }
    if (!all_empty || !feet_are_closest_) return std::nullopt;
    return point_inside(s);
  }

 private:
  struct Face {
    bool empty = true;           ///< proved to hold no point of M
    std::vector<double> points;  ///< d for each piece proved to hold one
  };

  bool project(const std::vector<double>& x, FootErrors& errors) {
    return near_.oracle().foot(x, point_, frame_, errors);
  }

  Face look_at(const Piece& whole) {
    Face face;
    std::vector<Piece> stack{whole};
    std::size_t pieces = 0;
    while (!stack.empty()) {
      const Piece piece = std::move(stack.back());
      stack.pop_back();
      if (++pieces > options_.max_pieces || ++all_pieces_ > options_.max_all_pieces) {
        face.empty = false;
        return face;
      }
      std::vector<double> centre(d_, 0.0);
      for (int j = 0; j <= k_; ++j)
        for (int c = 0; c < d_; ++c) centre[c] += piece[j * d_ + c] / (k_ + 1);
      FootErrors errors;
      const bool exists = project(centre, errors);
      double largest = 0;
      for (const double x : piece) largest = std::max(largest, std::abs(x));
      // A piece is as far from the exact one as the rounding of its midpoints took it, at most one unit in the last
      // place for each of fewer than a hundred bisections. It counts like an error of the foot.
      errors.point += 100 * d_ * largest * std::numeric_limits<double>::epsilon();
      if (exists) {
        if (is_empty(piece, centre, errors.point)) continue;
        std::vector<const double*> corner(k_ + 1);
        for (int j = 0; j <= k_; ++j) corner[j] = &piece[j * d_];
        const Proof proof = prover_.prove(corner.data(), {point_.data(), frame_.data(), errors});
        if (proof.proven() && proof.num_hit == 1) {
          face.empty = false;
          face.points.insert(face.points.end(), point_.begin(), point_.end());
          if (face.points.size() >= 2 * static_cast<std::size_t>(d_)) return face;
          continue;
        }
      }
      bisect(piece, stack);
    }
    return face;
  }

  /// Whether the foot of `centre` is further from it than all of the piece: by the distances of the vertices.
  bool is_empty(const Piece& piece, const std::vector<double>& centre, double error) const {
    const Rounding rounding;
    double size = 0;
    for (int j = 0; j <= k_; ++j)
      size = std::max(size, distance_above({&piece[j * d_], static_cast<std::size_t>(d_)}, centre));
    return (Interval(distance_below(centre, point_)) - Interval(error) - Interval(size)).inf() > 0;
  }

  void bisect(const Piece& piece, std::vector<Piece>& stack) const {
    double longest = -1;
    int a = 0, b = 0;
    for (int i = 0; i <= k_; ++i)
      for (int j = 0; j < i; ++j) {
        double squared = 0;
        for (int c = 0; c < d_; ++c) squared += std::pow(piece[i * d_ + c] - piece[j * d_ + c], 2);
        if (squared <= longest) continue;
        longest = squared;
        a = i;
        b = j;
      }
    for (const int replaced : {a, b}) {
      Piece half = piece;
      for (int c = 0; c < d_; ++c) half[replaced * d_ + c] = (piece[a * d_ + c] + piece[b * d_ + c]) / 2;
      stack.push_back(std::move(half));
    }
  }

  /// A foot of the barycentre or of a vertex that lies inside the simplex by more than its error.
  std::optional<Violation> point_inside(std::uint32_t s) {
    std::vector<const double*> corner(d_ + 1);
    for (int q = 0; q <= d_; ++q) corner[q] = near_.position(near_.corners(s)[q]);
    for (std::uint16_t candidate = 0; candidate <= d_ + 1; ++candidate) {
      FootView foot{};
      if (near_.foot(s, candidate, foot) && proved_inside(corner.data(), d_, foot.point, foot.errors.point))
        return Violation{Violation::Kind::kMissesAllFaces, near_.simplex(s), {}, {foot.point, foot.point + d_}};
    }
    return std::nullopt;
  }

  PerturbedTriangulation& near_;
  const ViolationOptions& options_;
  int d_, k_;
  std::size_t all_pieces_ = 0;
  Certificate certificate_;
  CertificateProver prover_;
  bool feet_are_closest_;  ///< proved: distances from feet are distances from M
  std::vector<double> point_, frame_;
};

}  // namespace

std::string describe(const Violation& violation) {
  return violation.kind == Violation::Kind::kTwoPointsOnFace
             ? "the manifold crosses one face of dimension k of the triangulation twice"
             : "the manifold meets a simplex of the triangulation but none of its faces of dimension k";
}

std::optional<Violation> find_violation(PerturbedTriangulation& near, std::span<const std::uint32_t> simplices,
                                        const ViolationOptions& options) {
  Searcher searcher(near, options);
  for (std::size_t i = 0; i < simplices.size() && i < options.max_simplices; ++i)
    if (auto violation = searcher.examine(simplices[i])) return violation;
  return std::nullopt;
}

}  // namespace whitney::perturbation
