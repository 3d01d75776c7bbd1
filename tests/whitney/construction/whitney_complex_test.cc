// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/whitney_complex.h>

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include <coxeter/triangulation.h>
#include <perturbation/foot_oracle.h>

namespace whitney {
namespace {

using perturbation::HitWalk;
using perturbation::PerturbedTriangulation;

/// The unit circle for x_1 < limit; no foot beyond.
class PartOfACircle : public perturbation::FootOracle {
 public:
  explicit PartOfACircle(double limit) : limit_(limit) {}
  int ambient_dim() const override { return 2; }
  int intrinsic_dim() const override { return 1; }
  double reach() const override { return 1; }
  double curvature_radius() const override { return 1; }
  bool foot(std::span<const double> x, std::span<double> point, std::span<double> frame,
            perturbation::FootErrors& errors) const override {
    const double length = std::hypot(x[0], x[1]);
    if (!(length > 0.1) || x[0] >= limit_) return false;
    for (int c = 0; c < 2; ++c) frame[2 + c] = point[c] = x[c] / length;
    frame[0] = -frame[3];
    frame[1] = frame[2];
    errors = {1e-15, 1e-15};
    return true;
  }

 private:
  double limit_;
};

TEST(WhitneyComplex, OneCellPerHitFace) {
  const PartOfACircle circle(10);
  const auto triangulation = coxeter::coxeter_a(2, 0.3);
  PerturbedTriangulation near(triangulation, circle);
  const std::vector<std::uint32_t> starts{perturbation::find_start(near, std::vector<double>{1, 0})};
  const HitWalk walk = perturbation::walk_hit_facets(near, starts);
  const WhitneyComplex cut = whitney_complex(near, walk, true);
  EXPECT_EQ(cut.complex.num_cells(1), cut.complex.num_cells(0));  // a closed curve
  EXPECT_EQ(cut.complex.num_cells(1), walk.simplices.size());
  EXPECT_FALSE(cut.cut);
}

TEST(WhitneyComplex, SimplicesWithoutAFoot) {
  for (const double limit : {0.2, -0.5, -2.0}) {
    const PartOfACircle part(limit);
    const auto triangulation = coxeter::coxeter_a(2, 0.3);
    PerturbedTriangulation near(triangulation, part);
    // The simplex at (1, 0) has no foot, wherever its vertices are.
    const std::vector<std::uint32_t> starts{near.locate(std::vector<double>{1, 0}),
                                            perturbation::find_start(near, std::vector<double>{-1, 0})};
    const HitWalk walk = perturbation::walk_hit_facets(near, starts);
    const WhitneyComplex cut = whitney_complex(near, walk, false);
    EXPECT_EQ(cut.complex.ambient_dim, 2) << limit;
    EXPECT_LT(cut.complex.num_cells(1), walk.simplices.size());
  }
}

}  // namespace
}  // namespace whitney
