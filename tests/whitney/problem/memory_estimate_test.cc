// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/memory_estimate.h>

#include <cmath>

#include <gtest/gtest.h>

namespace whitney {
namespace {

TEST(MemoryEstimate, CellsOfASurfaceInSpace) {
  // A closed surface, triangles and quadrangles: v - e + f = 0 on average, and every vertex has as many edges as faces.
  const double edges = cells_per_simplex(3, 1, 1), faces = cells_per_simplex(3, 1, 2);
  EXPECT_NEAR(1 - edges + faces, 0, 0.1);
  EXPECT_EQ(cells_per_simplex(3, 1, 0), 1);
}

TEST(MemoryEstimate, GrowsWithTheComplex) {
  EXPECT_GT(work_bytes_per_simplex(5, 1, MeshKind::kBarycentric), work_bytes_per_simplex(5, 1, MeshKind::kPulled));
  EXPECT_GT(work_bytes_per_simplex(5, 1, MeshKind::kPulled), work_bytes_per_simplex(3, 1, MeshKind::kPulled));
  EXPECT_GT(homology_bytes({100, 300, 200}), homology_bytes({10, 30, 20}));
  EXPECT_GT(link_bytes({100, 300, 200}), link_bytes({10, 30, 20}));
}

}  // namespace
}  // namespace whitney
