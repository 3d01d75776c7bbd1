// SPDX-License-Identifier: GPL-3.0-or-later
// Whitney's construction for a manifold that only the user knows: a cylinder's closed cousin, the torus of all points
// at distance 0.5 from the unit circle in R^3, by closest points. Prints the verdict.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include <whitney/cells/subdivide.h>
#include <whitney/construction/triangulate.h>
#include <whitney/io/write_mesh.h>
#include <whitney/manifolds/submanifold.h>

class Ring : public whitney::Submanifold::Model {
 public:
  int ambient_dim() const override { return 3; }
  int intrinsic_dim() const override { return 2; }

  bool project(std::span<const double> x, std::span<double> point, std::span<double> frame,
               whitney::FootErrors& errors) const override {
    const double rho = std::hypot(x[0], x[1]);
    if (!(rho > 1e-9)) return false;  // on the axis every turn is as close
    const double c = x[0] / rho, s = x[1] / rho;
    const double u = rho - 1, v = x[2], r = std::hypot(u, v);
    if (!(r > 1e-9)) return false;  // so it is on the circle
    const double a = u / r, b = v / r;
    const double foot[] = {(1 + kTube * a) * c, (1 + kTube * a) * s, kTube * b};
    std::ranges::copy(foot, point.begin());
    // Row by row: along the circle, around the tube, and the normal.
    const double rows[] = {-s, c, 0, -b * c, -b * s, a, a * c, a * s, b};
    std::ranges::copy(rows, frame.begin());
    // A few roundings, which grow where rho and r are small.
    errors.point = errors.angle = 1e-14 * (1 + 1 / rho + 1 / r);
    return true;
  }
  /// The reach is that of the tube's circles, proved by geometry.
  std::optional<whitney::Bending> bending() const override {
    return whitney::Bending{kTube, kTube, whitney::Bending::Source::kProven};
  }
  std::vector<double> seed_points() const override { return {1 + kTube, 0, 0}; }

 private:
  static constexpr double kTube = 0.5;
};

int main() {
  const whitney::Submanifold M(std::make_shared<Ring>());
  const auto result = whitney::triangulate(M, *M.bending(), whitney::coxeter::coxeter_a(3, 0.3), M.seed_points());
  const bool certified = result.certificate.verdict == whitney::perturbation::Verdict::kCertified;
  whitney::write_mesh("ring.ply", whitney::barycentric_subdivision(result.complex));
  std::puts(certified ? "certified" : "not certified");
  return certified ? 0 : 1;
}
