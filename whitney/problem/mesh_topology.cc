// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/mesh_topology.h>

#include <new>
#include <string>
#include <utility>

#include <whitney/problem/memory_estimate.h>

namespace whitney {
namespace {

constexpr const char* kCounts = "counts of faces and Euler characteristic";

/// One attempt. False when the memory was not enough after all.
bool try_topology(const SimplicialMesh& mesh, TopologyLevel level, Budget& budget, Report& report) {
  TopologyOptions options;
  options.links = options.homology = level == TopologyLevel::kFull;
  std::string part = kCounts;
  options.begin_part = [&](const char* name, const std::vector<std::size_t>& f_vector) {
    part = name;
    return budget.allows(name, name == std::string("homology") ? homology_bytes(f_vector) : link_bytes(f_vector));
  };
  try {
    report.topology = topology_of(mesh, options);
    return true;
  } catch (const std::bad_alloc&) {
    budget.leave_out(part, StopReason::kMemoryLimit);
    return false;
  }
}

}  // namespace

void report_topology(const SimplicialMesh& mesh, TopologyLevel level, Budget& budget, Report& report) {
  report.topology_level = TopologyLevel::kNone;
  if (level == TopologyLevel::kNone || !budget.allows(kCounts, face_bytes(mesh))) return;
  while (!try_topology(mesh, level, budget, report)) {
    if (level == TopologyLevel::kEuler) return;
    level = TopologyLevel::kEuler;
  }
  report.topology_level = level;
}

void count_cells(const CellComplex& complex, Report& report) {
  if (report.topology_level == TopologyLevel::kNone) return;
  report.topology.f_vector.clear();
  for (int j = 0; j <= complex.intrinsic_dim; ++j) report.topology.f_vector.push_back(complex.num_cells(j));
}

}  // namespace whitney
