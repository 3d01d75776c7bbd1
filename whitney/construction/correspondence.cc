// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/correspondence.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include <Eigen/Dense>

#include <coxeter/base/error.h>
#include <whitney/construction/complex_quality.h>
#include <whitney/topology/chain_complex.h>
#include <whitney/topology/face_lattice.h>

namespace whitney {
namespace {

constexpr int kMaxIntrinsic = 15, kMaxAmbient = 31;
/// Barycentric coordinates down to minus this count as 0 (dimensionless).
constexpr double kTolerance = 1e-10;
/// Points closer than this times the longest edge are one point.
constexpr double kMerge = 1e-7;

using Frame = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

double distance(const double* a, const double* b, int d) {
  double squares = 0;
  for (int c = 0; c < d; ++c) squares += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(squares);
}

/// Solves an n x n system by elimination with row pivoting. system: n x (n + 1), the right side last; overwritten.
/// False when a pivot is 0 or not a number.
bool solve(double* system, double* x, int n) {
  const int width = n + 1;
  for (int c = 0; c < n; ++c) {
    int pivot = c;
    for (int r = c + 1; r < n; ++r)
      if (std::abs(system[r * width + c]) > std::abs(system[pivot * width + c])) pivot = r;
    if (!(std::abs(system[pivot * width + c]) > 0)) return false;
    if (pivot != c) std::swap_ranges(&system[c * width], &system[c * width] + width, &system[pivot * width]);
    for (int r = c + 1; r < n; ++r) {
      const double factor = system[r * width + c] / system[c * width + c];
      for (int i = c; i <= n; ++i) system[r * width + i] -= factor * system[c * width + i];
    }
  }
  for (int c = n - 1; c >= 0; --c) {
    x[c] = system[c * width + n];
    for (int i = c + 1; i < n; ++i) x[c] -= system[c * width + i] * x[i];
    x[c] /= system[c * width + c];
  }
  return true;
}

const SimplicialMesh& checked(const SimplicialMesh& mesh, const Submanifold& manifold, double distance_bound) {
  if (mesh.ambient_dim != manifold.ambient_dim() || mesh.dim != manifold.intrinsic_dim())
    throw InvalidInput("correspondence: the mesh and the manifold have different dimensions");
  if (mesh.dim > kMaxIntrinsic || mesh.ambient_dim > kMaxAmbient)
    throw InvalidInput("correspondence: made for n <= 15, d <= 31");
  if (mesh.num_simplices() == 0) throw InvalidInput("correspondence: the mesh is empty");
  for (const std::uint32_t v : mesh.simplices)
    if (v >= mesh.num_points()) throw InvalidInput("correspondence: a simplex has a vertex that is not there");
  if (!(distance_bound >= 0) || !std::isfinite(distance_bound))
    throw InvalidInput("correspondence: the distance bound must be finite and not negative");
  return mesh;
}

/// The points of K above a foot, from one simplex after the other.
class PointsAbove {
 public:
  /// reached: how far from the foot they may be; merge: points closer than this are the same.
  PointsAbove(const SimplicialMesh& mesh, std::span<const double> foot, std::span<const double> frame, double reached,
              double merge)
      : mesh_(mesh), foot_(foot), frame_(frame), reached_(reached), merge_(merge), x_(mesh.ambient_dim) {
    for (int a = 0; a < mesh.dim; ++a)
      for (int c = 0; c < mesh.ambient_dim; ++c) along_foot_[a] += frame[a * mesh.ambient_dim + c] * foot[c];
  }

  void look_at(std::uint32_t simplex) {
    const int d = mesh_.ambient_dim, n = mesh_.dim;
    if (!solve_in(simplex)) return;
    double first = 1, least = 1;
    for (int q = 0; q < n; ++q) {
      first -= lambda_[q];
      least = std::min(least, lambda_[q]);
    }
    least = std::min(least, first);
    if (!(least >= -kTolerance)) return;
    std::fill(x_.begin(), x_.end(), 0.0);
    std::vector<double> weights(n + 1);
    double total = 0;
    for (int q = 0; q <= n; ++q) total += weights[q] = std::max(0.0, q == 0 ? first : lambda_[q - 1]);
    for (int q = 0; q <= n; ++q) {
      weights[q] /= total;
      for (int c = 0; c < d; ++c) x_[c] += weights[q] * corner_[q][c];
    }
    if (const double off = distance(x_.data(), foot_.data(), d); off <= reached_) add(simplex, weights, off, least);
  }

  Preimage result() {
    result_.num_points = points_.size() / mesh_.ambient_dim;
    result_.status = result_.num_points == 0   ? Preimage::Status::kNone
                     : result_.num_points == 1 ? Preimage::Status::kFound
                                               : Preimage::Status::kAmbiguous;
    return std::move(result_);
  }

 private:
  /// Barycentric coordinates 1 .. n of the point with the tangential coordinates of the foot.
  bool solve_in(std::uint32_t simplex) {
    const int d = mesh_.ambient_dim, n = mesh_.dim;
    const std::uint32_t* v = &mesh_.simplices[std::size_t{simplex} * (n + 1)];
    for (int q = 0; q <= n; ++q) corner_[q] = &mesh_.points[std::size_t{v[q]} * d];
    for (int a = 0; a < n; ++a) {
      const double* tangent = &frame_[a * d];
      double* row = &system_[a * (n + 1)];
      double origin = 0;
      for (int c = 0; c < d; ++c) origin += tangent[c] * corner_[0][c];
      row[n] = along_foot_[a] - origin;
      for (int q = 1; q <= n; ++q) {
        row[q - 1] = -origin;
        for (int c = 0; c < d; ++c) row[q - 1] += tangent[c] * corner_[q][c];
      }
    }
    return solve(system_.data(), lambda_.data(), n);
  }

  /// Of several points the nearest one is kept; of several simplices around one point the one that it is most inside.
  void add(std::uint32_t simplex, const std::vector<double>& weights, double off, double least) {
    const int d = mesh_.ambient_dim;
    bool is_new = true;
    for (std::size_t i = 0; i < points_.size() && is_new; i += d) is_new = distance(x_.data(), &points_[i], d) > merge_;
    if (points_.empty() ||
        (is_new ? off < result_.distance : distance(x_.data(), result_.point.data(), d) <= merge_ && least > best_)) {
      best_ = least;
      result_.simplex = simplex;
      result_.barycentric = weights;
      result_.point = x_;
      result_.distance = off;
    }
    if (is_new) points_.insert(points_.end(), x_.begin(), x_.end());
  }

  const SimplicialMesh& mesh_;
  std::span<const double> foot_, frame_;
  double reached_, merge_;
  std::array<double, kMaxIntrinsic> along_foot_{}, lambda_{};
  std::array<double, kMaxIntrinsic*(kMaxIntrinsic + 1)> system_;
  std::array<const double*, kMaxIntrinsic + 1> corner_;
  std::vector<double> x_;
  double best_ = 0;             // least barycentric coordinate of the solution kept
  std::vector<double> points_;  // distinct solutions
  Preimage result_;
};

std::vector<double> barycentres_of(const SimplicialMesh& mesh) {
  const int d = mesh.ambient_dim, size = mesh.dim + 1;
  std::vector<double> points(mesh.num_simplices() * d, 0.0);
  for (std::size_t s = 0; s < mesh.num_simplices(); ++s)
    for (int q = 0; q < size; ++q)
      for (int c = 0; c < d; ++c)
        points[s * d + c] += mesh.points[std::size_t{mesh.simplices[s * size + q]} * d + c] / size;
  return points;
}

}  // namespace

Correspondence::Correspondence(SimplicialMesh mesh, Submanifold manifold, double distance_bound)
    : mesh_(std::move(mesh)),
      manifold_(std::move(manifold)),
      distance_bound_(distance_bound),
      barycentres_(barycentres_of(checked(mesh_, manifold_, distance_bound)), mesh_.ambient_dim) {
  const int d = mesh_.ambient_dim, size = mesh_.dim + 1;
  for (std::size_t s = 0; s < mesh_.num_simplices(); ++s) {
    double radius = 0;
    for (int q = 0; q < size; ++q) {
      const double* x = &mesh_.points[std::size_t{mesh_.simplices[s * size + q]} * d];
      radius = std::max(radius, distance(x, barycentres_.point(s).data(), d));
      for (int r = 0; r < q; ++r)
        longest_edge_ =
            std::max(longest_edge_, distance(x, &mesh_.points[std::size_t{mesh_.simplices[s * size + r]} * d], d));
    }
    radius_.push_back(radius);
    largest_radius_ = std::max(largest_radius_, radius);
  }
}

std::vector<double> Correspondence::to_manifold(std::span<const double> x) const {
  const int d = mesh_.ambient_dim;
  std::vector<double> point(d), frame(static_cast<std::size_t>(d) * d);
  FootErrors errors;
  if (!manifold_.project(x, point, frame, errors)) return {};
  return point;
}

Preimage Correspondence::from_manifold(std::span<const double> y) const {
  const int d = mesh_.ambient_dim, n = mesh_.dim;
  std::vector<double> foot(d), frame(static_cast<std::size_t>(d) * d);
  FootErrors errors;
  if (!manifold_.project(y, foot, frame, errors)) {
    Preimage result;
    result.status = Preimage::Status::kNoFoot;
    return result;
  }
  // Room for the rounding of the foot and of the bound.
  const double reached = distance_bound_ + 1e-9 * longest_edge_ + errors.point;
  std::vector<KdTree::Neighbor> near;
  barycentres_.within(foot, largest_radius_ + reached, near);

  PointsAbove above(mesh_, foot, frame, reached, kMerge * longest_edge_);
  for (const KdTree::Neighbor& neighbor : near) {
    const double limit = radius_[neighbor.index] + reached;
    if (neighbor.squared_distance > limit * limit) continue;
    // The solution has the tangential coordinates of the foot, so the barycentre cannot be far in these.
    const double radius = radius_[neighbor.index] * (1 + 1e-9);
    const double* centre = barycentres_.point(neighbor.index).data();
    double tangential = 0;
    for (int a = 0; a < n; ++a) {
      double along = 0;
      for (int c = 0; c < d; ++c) along += frame[a * d + c] * (centre[c] - foot[c]);
      tangential += along * along;
    }
    if (tangential <= radius * radius) above.look_at(static_cast<std::uint32_t>(neighbor.index));
  }
  return above.result();
}

std::optional<std::vector<double>> Correspondence::carry(std::span<const double> values, int components,
                                                         std::span<const double> y) const {
  if (components < 1 || values.size() != mesh_.num_points() * static_cast<std::size_t>(components))
    throw InvalidInput("carry: " + std::to_string(values.size()) + " values, expected " +
                       std::to_string(mesh_.num_points()) + " x " + std::to_string(components));
  const Preimage preimage = from_manifold(y);
  if (!preimage.found()) return std::nullopt;
  std::vector<double> result(components, 0.0);
  const int size = mesh_.dim + 1;
  for (int q = 0; q < size; ++q) {
    const std::size_t v = mesh_.simplices[std::size_t{preimage.simplex} * size + q];
    for (int c = 0; c < components; ++c) result[c] += preimage.barycentric[q] * values[v * components + c];
  }
  return result;
}

namespace {

/// Condition (2) for one simplex after the other.
class AngleCheck {
 public:
  AngleCheck(const Correspondence& correspondence, const Bending& bending, int max_depth, CorrespondenceCheck& report)
      : mesh_(correspondence.mesh()),
        manifold_(correspondence.manifold()),
        turn_(bending.reach / (bending.reach - correspondence.distance_bound()) /
              std::max(bending.reach, bending.curvature_radius)),
        max_depth_(max_depth),
        report_(report),
        point_(mesh_.ambient_dim),
        frame_(static_cast<std::size_t>(mesh_.ambient_dim) * mesh_.ambient_dim) {}

  bool is_transversal(std::size_t s) {
    const int d = mesh_.ambient_dim, n = mesh_.dim;
    Eigen::MatrixXd corners(d, n + 1);
    for (int q = 0; q <= n; ++q)
      for (int c = 0; c < d; ++c) corners(c, q) = mesh_.points[std::size_t{mesh_.simplices[s * (n + 1) + q]} * d + c];
    return piece(s, corners, 0);
  }

  /// angle_at_vertices_max: one foot for all simplices around a vertex.
  void look_at_vertices() {
    const int d = mesh_.ambient_dim, size = mesh_.dim + 1;
    std::vector<std::uint32_t> begin(mesh_.num_points() + 1, 0), star(mesh_.simplices.size());
    for (const std::uint32_t v : mesh_.simplices) ++begin[v + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i)
      star[next[mesh_.simplices[i]]++] = static_cast<std::uint32_t>(i / size);
    for (std::size_t v = 0; v < mesh_.num_points(); ++v) {
      if (begin[v] == begin[v + 1]) continue;
      FootErrors errors;
      if (!manifold_.project({&mesh_.points[v * d], static_cast<std::size_t>(d)}, point_, frame_, errors)) {
        ++report_.feet_missing;
        continue;
      }
      for (std::uint32_t i = begin[v]; i < begin[v + 1]; ++i)
        report_.angle_at_vertices_max =
            std::max(report_.angle_at_vertices_max, tangent_angle(mesh_, star[i], frame_.data()));
    }
  }

 private:
  /// pi without a foot: more than any angle.
  double angle(std::size_t s, const Eigen::VectorXd& x) {
    FootErrors errors;
    if (!manifold_.project({x.data(), static_cast<std::size_t>(x.size())}, point_, frame_, errors)) {
      ++report_.feet_missing;
      return std::numbers::pi;
    }
    return tangent_angle(mesh_, s, frame_.data()) + errors.angle;
  }

  bool piece(std::size_t s, const Eigen::MatrixXd& corners, int depth) {
    const Eigen::VectorXd centre = corners.rowwise().mean();
    const double radius = std::sqrt((corners.colwise() - centre).colwise().squaredNorm().maxCoeff());
    const double here = angle(s, centre);
    report_.angle_max = std::max(report_.angle_max, here);
    if (here + radius * turn_ < std::numbers::pi / 2) return true;
    if (depth == max_depth_ || here >= std::numbers::pi / 2) return false;
    int a = 0, b = 1;
    double longest = 0;
    for (int i = 0; i < corners.cols(); ++i)
      for (int j = i + 1; j < corners.cols(); ++j)
        if (const double length = (corners.col(i) - corners.col(j)).norm(); length > longest) {
          longest = length;
          a = i;
          b = j;
        }
    for (const int replaced : {a, b}) {
      Eigen::MatrixXd half = corners;
      half.col(replaced) = (corners.col(a) + corners.col(b)) / 2;
      if (!piece(s, half, depth + 1)) return false;
    }
    return true;
  }

  const SimplicialMesh& mesh_;
  const Submanifold& manifold_;
  double turn_;  // of the tangent space, per length in K
  int max_depth_;
  CorrespondenceCheck& report_;
  std::vector<double> point_, frame_;
};

/// Condition (3): on which side of the facet with these vertices the vertex `apex` lies, as a determinant in the
/// tangent space.
double side(const SimplicialMesh& mesh, const std::uint32_t* facet, std::uint32_t apex, const double* frame) {
  const int d = mesh.ambient_dim, n = mesh.dim;
  const auto at = [&](std::uint32_t v) {
    return Eigen::Map<const Eigen::VectorXd>(&mesh.points[std::size_t{v} * d], d);
  };
  const Frame rows(frame, d, d);
  Eigen::MatrixXd projected(n, n);
  for (int q = 1; q <= n; ++q)
    projected.col(q - 1) = (rows.topRows(n) * (at(q < n ? facet[q] : apex) - at(facet[0]))).normalized();
  return projected.determinant();
}

/// The first reason that speaks against a homeomorphism, or none.
void conclude(bool complete, CorrespondenceCheck& report) {
  const auto say = [&](std::size_t count, const char* what) {
    if (count > 0 && report.reason.empty()) report.reason = std::to_string(count) + what;
  };
  say(report.feet_missing, " places of the complex have no closest point on the manifold");
  say(report.bad_facets, " facets do not lie in exactly two simplices");
  say(report.folded_facets, " facets are folds of the projection");
  say(report.steep, " simplices may be orthogonal to the manifold somewhere");
  say(report.covered_twice, " components are not projected injectively");
  if (!complete && report.reason.empty()) report.reason = "the check was stopped";
  report.homeomorphism = report.reason.empty();
}

}  // namespace

CorrespondenceCheck check_correspondence(const Correspondence& correspondence, const Bending& bending,
                                         const CorrespondenceCheckOptions& options) {
  if (!(bending.reach > 0)) throw InvalidInput("check_correspondence: reach must be positive");
  const SimplicialMesh& mesh = correspondence.mesh();
  const Submanifold& manifold = correspondence.manifold();
  const int d = mesh.ambient_dim, n = mesh.dim;
  CorrespondenceCheck report;
  report.within_reach = correspondence.distance_bound() < bending.reach;
  if (!report.within_reach) {
    report.reason = "points of the complex may be further from the manifold than its reach";
    return report;
  }
  const FaceLattice lattice = face_lattice(mesh, n - 1);
  const Incidence cofacets = transposed(lattice.facets[n], lattice.num_faces(n - 1));

  AngleCheck angles(correspondence, bending, options.max_depth, report);
  angles.look_at_vertices();
  bool complete = true;
  const auto go_on = [&](std::size_t i) {
    if (i % 64 == 63 && options.keep_going && !options.keep_going()) complete = false;
    return complete;
  };
  for (std::size_t s = 0; s < mesh.num_simplices() && go_on(s); ++s) report.steep += !angles.is_transversal(s);

  std::vector<double> x(d), point(d), frame(static_cast<std::size_t>(d) * d);
  FootErrors errors;
  for (std::size_t f = 0; f < cofacets.size() && go_on(f); ++f) {
    if (cofacets[f].size() != 2) {
      ++report.bad_facets;
      continue;
    }
    const std::uint32_t* facet = &lattice.vertices[n - 1][f * n];
    std::fill(x.begin(), x.end(), 0.0);
    for (int q = 0; q < n; ++q)
      for (int c = 0; c < d; ++c) x[c] += mesh.points[std::size_t{facet[q]} * d + c] / n;
    if (!manifold.project(x, point, frame, errors)) {
      ++report.feet_missing;
      continue;
    }
    double sides[2] = {0, 0};
    for (int i = 0; i < 2; ++i)
      for (int q = 0; q <= n; ++q) {
        const std::uint32_t v = mesh.simplices[std::size_t{cofacets[f][i]} * (n + 1) + q];
        if (std::find(facet, facet + n, v) == facet + n) sides[i] = side(mesh, facet, v, frame.data());
      }
    report.folded_facets += !((sides[0] > 0 && sides[1] < 0) || (sides[0] < 0 && sides[1] > 0));
  }

  std::vector<char> seen(mesh.num_simplices(), 0);
  std::vector<std::uint32_t> open;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++report.components;
    seen[start] = 1;
    open.push_back(start);
    while (!open.empty()) {
      const std::uint32_t s = open.back();
      open.pop_back();
      for (const std::uint32_t f : lattice.facets[n][s])
        for (const std::uint32_t t : cofacets[f])
          if (!seen[t]) {
            seen[t] = 1;
            open.push_back(t);
          }
    }
    std::fill(x.begin(), x.end(), 0.0);
    for (int q = 0; q <= n; ++q)
      for (int c = 0; c < d; ++c)
        x[c] += mesh.points[std::size_t{mesh.simplices[std::size_t{start} * (n + 1) + q]} * d + c] / (n + 1);
    report.covered_twice += !correspondence.from_manifold(x).found();
  }

  conclude(complete, report);
  return report;
}

}  // namespace whitney
