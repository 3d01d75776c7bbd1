// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/check_mesh.h>

#include <gtest/gtest.h>

namespace whitney {
namespace {

SimplicialMesh sphere() {
  return {.ambient_dim = 3,
          .dim = 2,
          .points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
          .simplices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
}

TEST(CheckMesh, LevelsAndLimits) {
  const Report full = check_mesh(sphere());
  EXPECT_TRUE(full.topology.is_closed_manifold());
  EXPECT_TRUE(full.topology.homology_z);
  const Report euler = check_mesh(sphere(), TopologyLevel::kEuler);
  EXPECT_EQ(euler.topology.euler_characteristic, 2);
  EXPECT_FALSE(euler.topology.homology_z);
  EXPECT_EQ(euler.topology.manifold, ManifoldKind::kNotChecked);
  EXPECT_TRUE(check_mesh(sphere(), TopologyLevel::kNone).topology.f_vector.empty());
  RunControl tiny;
  tiny.memory_limit = 1;
  const Report nothing = check_mesh(sphere(), TopologyLevel::kFull, tiny);
  EXPECT_EQ(nothing.stop_reason, StopReason::kMemoryLimit);
  EXPECT_EQ(nothing.left_out.size(), 1u);
}

}  // namespace
}  // namespace whitney
