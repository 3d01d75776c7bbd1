// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <perturbation/foot_oracle.h>

namespace whitney {

/// How much a submanifold M of R^d bends, and who says so.
struct Bending {
  using Source = perturbation::ReachSource;  ///< kProven, kCaller, kEstimated
  /// A lower bound of the reach (a length, > 0): every point closer to M than this has one closest point on M.
  double reach = 0;
  /// 1 / curvature_radius bounds the norm of the second fundamental form everywhere on M; at least `reach`.
  double curvature_radius = 0;
  Source source = Source::kCaller;
};

using perturbation::FootErrors;
using perturbation::FootPromise;
using perturbation::to_string;

/// A compact C^{1,1} submanifold M of R^d without boundary, of dimension n and codimension k = d - n, given by an
/// oracle: the foot (closest point) of x on M and the tangent space there. Orientable or not.
///
/// A value: cheap to copy, immutable, safe to call from several threads.
class Submanifold {
 public:
  /// The interface behind a Submanifold.
  class Model {
   public:
    virtual ~Model() = default;
    virtual int ambient_dim() const = 0;
    virtual int intrinsic_dim() const = 0;
    /// point (d) = the point of M closest to x (d), as far as promise() says so; any of them when there are several.
    /// frame: d x d, row-major, its rows orthonormal: first n that span the tangent space at that point, then k that
    /// span the normal space.
    /// The result is a pure function of x; errors: bounds that hold for this result. False when no foot was found
    /// (x on the medial axis of M, an iteration that did not converge); then nothing is said.
    virtual bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
                         FootErrors& errors) const = 0;
    /// What holds of every foot: whether it is proved to be the closest point of M, and what `errors` rest on.
    virtual FootPromise promise() const { return {}; }
    /// What is known of the bending of M; empty when nothing is.
    virtual std::optional<Bending> bending() const = 0;
    /// m x d: points on M (or near it: they are projected), one at least in every connected component, as far as the
    /// model knows.
    virtual std::vector<double> seed_points() const = 0;
    /// M is connected by its definition, so that one seed point stands for all of it.
    virtual bool is_connected() const { return false; }
  };

  explicit Submanifold(std::shared_ptr<const Model> model) : model_(std::move(model)) {}

  int ambient_dim() const { return model_->ambient_dim(); }
  int intrinsic_dim() const { return model_->intrinsic_dim(); }
  int codim() const { return ambient_dim() - intrinsic_dim(); }

  /// As Model::project. Throws InvalidInput when a size does not fit, OracleError (naming x) when the model returns
  /// values that are not finite.
  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame, FootErrors& errors) const;
  FootPromise promise() const { return model_->promise(); }
  std::optional<Bending> bending() const { return model_->bending(); }
  std::vector<double> seed_points() const { return model_->seed_points(); }
  bool is_connected() const { return model_->is_connected(); }

 private:
  std::shared_ptr<const Model> model_;
};

/// M itself, with what the caller knows of its bending in place of what the model says. curvature_radius 0 stands for
/// `reach`. Throws InvalidInput unless reach is finite and positive and curvature_radius is 0 or at least reach.
Submanifold with_bending(Submanifold manifold, Bending bending);

/// Replaces `frame` (d x d, row-major) whose first num_given rows are linearly independent by an orthonormal frame with
/// the same span of those rows (modified Gram-Schmidt, twice), the further rows completing it to R^d. Returns false
/// when the rows are numerically dependent.
bool complete_frame(std::span<double> frame, int ambient_dim, int num_given);

}  // namespace whitney
