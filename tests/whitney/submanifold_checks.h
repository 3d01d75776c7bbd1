// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <whitney/manifolds/submanifold.h>

namespace whitney {

/// Feet of points near M, met on a random walk over it.
struct Feet {
  std::vector<double> sources;  ///< m x d: the points projected
  std::vector<double> points;   ///< m x d
  std::vector<double> frames;   ///< m x d x d
  std::vector<FootErrors> errors;
  std::size_t size() const { return errors.size(); }
};

/// `distance`: about how far the points are from M, and the length of the walk's steps.
inline Feet random_feet(const Submanifold& M, double distance, std::size_t count, unsigned rng_seed = 1) {
  const std::size_t d = M.ambient_dim();
  std::mt19937 generator(rng_seed);
  std::normal_distribution<double> normal(0, distance / std::sqrt(static_cast<double>(d)));
  Feet feet;
  std::vector<double> at = M.seed_points(), x(d), point(d), frame(d * d);
  at.resize(d);
  for (std::size_t tries = 0; feet.size() < count && tries < 10 * count; ++tries) {
    for (std::size_t c = 0; c < d; ++c) x[c] = at[c] + normal(generator);
    FootErrors errors;
    if (!M.project(x, point, frame, errors)) continue;
    at = point;
    feet.sources.insert(feet.sources.end(), x.begin(), x.end());
    feet.points.insert(feet.points.end(), point.begin(), point.end());
    feet.frames.insert(feet.frames.end(), frame.begin(), frame.end());
    feet.errors.push_back(errors);
  }
  return feet;
}

inline double distance(const double* a, const double* b, std::size_t d) {
  double sum = 0;
  for (std::size_t c = 0; c < d; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return std::sqrt(sum);
}

/// Every promise of Submanifold::Model::project that can be seen from outside, on points less than the reach away.
/// size: a length, of M's coordinates; reach: of M, or less.
inline void check_feet(const Submanifold& M, double size, double reach) {
  const std::size_t d = M.ambient_dim(), n = M.intrinsic_dim();
  const Feet feet = random_feet(M, 0.4 * reach, 300);
  const Feet cloud = random_feet(M, 0.4 * reach, 1000, 2);
  ASSERT_EQ(feet.size(), 300);
  double defect = 0, tangential = 0, moved = 0, off = 0, nearer = 0, largest_error = 0;
  std::vector<double> x(d), point(d), frame(d * d);
  FootErrors errors;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double *source = &feet.sources[i * d], *p = &feet.points[i * d], *F = &feet.frames[i * d * d];
    const double from_M = distance(source, p, d);
    if (from_M > 0.8 * reach) continue;
    largest_error = std::max({largest_error, feet.errors[i].point / size, feet.errors[i].angle});
    for (std::size_t a = 0; a < d; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        double dot = 0;
        for (std::size_t c = 0; c < d; ++c) dot += F[a * d + c] * F[b * d + c];
        defect = std::max(defect, std::abs(dot - (a == b)));
      }
      if (a >= n) continue;
      double along = 0;
      for (std::size_t c = 0; c < d; ++c) along += F[a * d + c] * (source[c] - p[c]);
      tangential = std::max(tangential, std::abs(along) / size);
      // A step along a tangent, projected, has hardly moved: by h^2 / (2 reach) at most, and further.
      const double h = 1e-4 * reach;
      for (std::size_t c = 0; c < d; ++c) x[c] = p[c] + h * F[a * d + c];
      ASSERT_TRUE(M.project(x, point, frame, errors));
      off = std::max(off, distance(x.data(), point.data(), d) / (h * h / reach));
    }
    // A foot is its own foot.
    ASSERT_TRUE(M.project({p, d}, point, frame, errors));
    moved = std::max(moved, distance(p, point.data(), d) / size);
    for (std::size_t j = 0; j < cloud.size(); ++j)
      nearer = std::max(nearer, (from_M - distance(source, &cloud.points[j * d], d)) / size);
    // The same again, to the last bit.
    ASSERT_TRUE(M.project({source, d}, point, frame, errors));
    EXPECT_TRUE(std::equal(point.begin(), point.end(), p));
    EXPECT_TRUE(std::equal(frame.begin(), frame.end(), F));
  }
  EXPECT_LT(defect, 1e-13);
  EXPECT_LT(tangential, 1e-8);
  EXPECT_LT(moved, 1e-12);
  EXPECT_LT(off, 1);
  EXPECT_LT(nearer, 1e-13);
  EXPECT_LT(largest_error, 1e-9);
  EXPECT_GT(largest_error, 0);
}

/// No foot for points that are not finite; sizes that do not fit throw.
inline void check_bad_points(const Submanifold& M) {
  const std::size_t d = M.ambient_dim();
  std::vector<double> point(d), frame(d * d);
  FootErrors errors;
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    for (std::size_t c = 0; c < d; ++c) {
      std::vector<double> x = M.seed_points();
      x.resize(d);
      x[c] = bad;
      EXPECT_FALSE(M.project(x, point, frame, errors)) << bad << " at " << c;
    }
  }
}

}  // namespace whitney
