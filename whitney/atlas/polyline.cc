// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/atlas/polyline.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whitney::internal {
namespace {

/// Share of arc length that spreads points of the first polyline whose nearest points fell together.
constexpr double kSpread = 0.05;
/// Share of the index that keeps parameters apart where vertices coincide.
constexpr double kIndexShare = 1e-9;
/// Vertices are identified when they are nearer than this fraction of the segments beside them. Below 1/2, a vertex
/// has at most one partner, and the order stays.
constexpr double kIdentify = 0.25;

/// Parameters in [0, 1], strictly increasing, that are the given ones (increasing, from 0 to 1) up to kIndexShare.
std::vector<double> strictly_increasing(std::vector<double> parameters) {
  const double last = static_cast<double>(parameters.size() - 1);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i] = (1 - kIndexShare) * parameters[i] + kIndexShare * static_cast<double>(i) / last;
  }
  return parameters;
}

std::vector<double> arc_fractions(const Polyline& polyline) {
  std::vector<double> result(polyline.num_vertices());
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = polyline.length() > 0 ? polyline.arc(i) / polyline.length()
                                      : static_cast<double>(i) / static_cast<double>(result.size() - 1);
  }
  return result;
}

/// For the vertices of `first`, increasing arc lengths on `second`.
std::vector<double> walk(const Polyline& first, const Polyline& second, double slack) {
  std::vector<double> arcs(first.num_vertices(), 0);
  arcs.back() = second.length();
  for (std::size_t i = 1; i + 1 < arcs.size(); ++i) {
    const double reach = arcs[i - 1] + 3 * (first.arc(i) - first.arc(i - 1)) + slack;
    arcs[i] = std::clamp(second.nearest(first.vertex(i), arcs[i - 1], reach).arc, arcs[i - 1], second.length());
  }
  return arcs;
}

/// The length of the shorter segment at an inner vertex.
double gap(const std::vector<double>& parameters, std::size_t i) {
  return std::min(parameters[i] - parameters[i - 1], parameters[i + 1] - parameters[i]);
}

/// Moves inner parameters of `first` onto those of `second` that they are to be identified with.
void identify(std::vector<double>& first, const std::vector<double>& second) {
  const std::vector<double> before = first;
  for (std::size_t i = 1, j = 1; i + 1 < before.size(); ++i) {
    while (j + 1 < second.size() && second[j] < before[i]) ++j;
    for (const std::size_t candidate : {j - 1, j}) {
      if (candidate == 0 || candidate + 1 >= second.size()) continue;
      const double apart = std::abs(before[i] - second[candidate]);
      if (apart <= kIdentify * std::min(gap(before, i), gap(second, candidate))) first[i] = second[candidate];
    }
  }
}

PolylinePlace inner_place(const std::vector<double>& parameters, std::size_t next, double parameter) {
  const double width = parameters[next] - parameters[next - 1];
  return {next - 1, false, std::clamp((parameter - parameters[next - 1]) / width, 0.0, 1.0)};
}

/// All vertices of both, in order; parameters that are equal are one station.
std::vector<CommonRefinement::Station> merged(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<CommonRefinement::Station> stations{{}};
  const std::size_t last_i = first.size() - 1, last_j = second.size() - 1;
  for (std::size_t i = 1, j = 1; i < last_i || j < last_j;) {
    if (i < last_i && j < last_j && first[i] == second[j]) {
      stations.push_back({{i++, true, 0}, {j++, true, 0}});
    } else if (j == last_j || (i < last_i && first[i] < second[j])) {
      stations.push_back({{i, true, 0}, inner_place(second, j, first[i])});
      ++i;
    } else {
      stations.push_back({inner_place(first, i, second[j]), {j, true, 0}});
      ++j;
    }
  }
  stations.push_back({{last_i, true, 0}, {last_j, true, 0}});
  return stations;
}

std::vector<double> point_at(const Polyline& polyline, const PolylinePlace& place) {
  if (!place.is_vertex) return polyline.point(place.index, place.fraction);
  const auto vertex = polyline.vertex(place.index);
  return {vertex.begin(), vertex.end()};
}

}  // namespace

double distance(std::span<const double> x, std::span<const double> y) {
  double squared = 0;
  for (std::size_t i = 0; i < x.size(); ++i) squared += (x[i] - y[i]) * (x[i] - y[i]);
  return std::sqrt(squared);
}

Polyline::Polyline(std::vector<double> points, std::size_t ambient_dim)
    : dim_(ambient_dim), points_(std::move(points)), arc_(points_.size() / ambient_dim, 0) {
  for (std::size_t i = 1; i < arc_.size(); ++i) arc_[i] = arc_[i - 1] + distance(vertex(i - 1), vertex(i));
}

double Polyline::longest_segment() const {
  double longest = 0;
  for (std::size_t i = 1; i < arc_.size(); ++i) longest = std::max(longest, arc_[i] - arc_[i - 1]);
  return longest;
}

std::vector<double> Polyline::point(std::size_t segment, double fraction) const {
  std::vector<double> result(dim_);
  const auto a = vertex(segment), b = vertex(segment + 1);
  for (std::size_t i = 0; i < dim_; ++i) result[i] = (1 - fraction) * a[i] + fraction * b[i];
  return result;
}

std::vector<double> Polyline::point_at(double arc) const {
  arc = std::clamp(arc, 0.0, length());
  const auto after = std::upper_bound(arc_.begin() + 1, arc_.end() - 1, arc);
  const std::size_t segment = after - arc_.begin() - 1;
  const double width = arc_[segment + 1] - arc_[segment];
  return point(segment, width > 0 ? std::min(1.0, (arc - arc_[segment]) / width) : 0);
}

Polyline::Foot Polyline::nearest(std::span<const double> x, double from, double to) const {
  Foot best;
  std::size_t segment = std::upper_bound(arc_.begin(), arc_.end() - 1, from) - arc_.begin();
  if (segment > 0) --segment;
  for (; segment + 1 < num_vertices() && arc_[segment] <= to; ++segment) {
    const auto a = vertex(segment), b = vertex(segment + 1);
    double along = 0, squared = 0;
    for (std::size_t i = 0; i < dim_; ++i) {
      along += (x[i] - a[i]) * (b[i] - a[i]);
      squared += (b[i] - a[i]) * (b[i] - a[i]);
    }
    double fraction = squared > 0 ? along / squared : 0;
    const double width = arc_[segment + 1] - arc_[segment];
    if (width > 0) {
      fraction = std::min(fraction, (to - arc_[segment]) / width);
      fraction = std::max(fraction, (from - arc_[segment]) / width);
    }
    fraction = std::clamp(fraction, 0.0, 1.0);
    double apart = 0;
    for (std::size_t i = 0; i < dim_; ++i) {
      const double difference = x[i] - ((1 - fraction) * a[i] + fraction * b[i]);
      apart += difference * difference;
    }
    apart = std::sqrt(apart);
    if (apart < best.distance) best = {segment, fraction, arc_[segment] + fraction * width, apart};
  }
  return best;
}

CommonRefinement common_refinement(const Polyline& first, const Polyline& second, double slack) {
  std::vector<double> on_first = walk(first, second, slack);
  const std::vector<double> own_fractions = arc_fractions(first);
  for (std::size_t i = 0; i < on_first.size(); ++i) {
    const double walked = second.length() > 0 ? on_first[i] / second.length() : own_fractions[i];
    on_first[i] = (1 - kSpread) * walked + kSpread * own_fractions[i];
  }
  // From here on both polylines are parametrised over [0, 1], by (about) the arc length of the second.
  on_first = strictly_increasing(std::move(on_first));
  const std::vector<double> on_second = strictly_increasing(arc_fractions(second));

  CommonRefinement result;
  for (const CommonRefinement::Station& station : merged(on_first, on_second)) {
    std::vector<double> here = internal::point_at(first, station.first);
    const double apart = distance(here, internal::point_at(second, station.second));
    if (result.worst_place.empty() || apart > result.worst_distance) {
      result.worst_distance = apart;
      result.worst_place = std::move(here);
    }
  }
  identify(on_first, on_second);
  result.stations = merged(on_first, on_second);
  return result;
}

}  // namespace whitney::internal
