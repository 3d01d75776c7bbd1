// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/mesh_topology.h>

#include <new>
#include <set>
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
  std::set<std::string> refused;  // the budget has noted these
  options.begin_part = [&](const char* name, const std::vector<std::size_t>& f_vector) {
    part = name;
    const bool allowed =
        budget.allows(name, name == std::string("homology") ? homology_bytes(f_vector) : link_bytes(f_vector));
    if (!allowed) refused.insert(name);
    return allowed;
  };
  options.run = budget.rest();
  try {
    report.topology = topology_of(mesh, options);
    if (report.topology.stop_reason != StopReason::kNone) {
      const StopReason ended = budget.ended(report.topology.stop_reason);
      for (const std::string& what : report.topology.left_out)
        if (refused.count(what) == 0) budget.leave_out(what, ended);
    }
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
