// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/manifolds/kd_tree.h>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

TEST(KdTree, AgreesWithBruteForce) {
  std::mt19937 generator(1);
  std::uniform_int_distribution<int> coarse(-6, 6);  // many ties, many equal points
  for (const int d : {1, 2, 4, 9}) {
    for (const std::size_t m : {1, 7, 8, 9, 500}) {
      std::vector<double> points(m * d);
      for (double& c : points) c = coarse(generator);
      const KdTree tree(points, d);
      ASSERT_EQ(tree.size(), m);
      std::vector<KdTree::Neighbor> found;
      for (int query = 0; query < 50; ++query) {
        std::vector<double> x(d);
        for (double& c : x) c = 0.5 * coarse(generator);
        const auto squared = [&](std::size_t i) {
          double sum = 0;
          for (int c = 0; c < d; ++c) sum += (x[c] - points[i * d + c]) * (x[c] - points[i * d + c]);
          return sum;
        };
        std::size_t best = 0, inside = 0;
        for (std::size_t i = 0; i < m; ++i) {
          if (squared(i) < squared(best)) best = i;
          inside += squared(i) <= 9;
          EXPECT_EQ(tree.point(i)[0], points[i * d]);
        }
        EXPECT_EQ(tree.nearest(x).index, best);
        EXPECT_EQ(tree.nearest(x).squared_distance, squared(best));
        tree.within(x, 3, found);
        ASSERT_EQ(found.size(), inside);
        for (std::size_t i = 0; i < found.size(); ++i) {
          EXPECT_EQ(found[i].squared_distance, squared(found[i].index));
          EXPECT_TRUE(i == 0 || found[i - 1].squared_distance < found[i].squared_distance ||
                      found[i - 1].index < found[i].index);
        }
      }
    }
  }
}

TEST(KdTree, RejectsBadInput) {
  EXPECT_THROW(KdTree({}, 2), InvalidInput);
  EXPECT_THROW(KdTree({1, 2, 3}, 2), InvalidInput);
  EXPECT_THROW(KdTree({1, NAN}, 2), InvalidInput);
  EXPECT_THROW(KdTree({1, 2}, 0), InvalidInput);
  EXPECT_THROW(KdTree({1, 2}, 2).nearest(std::vector<double>{1}), InvalidInput);
}

}  // namespace
}  // namespace whitney
