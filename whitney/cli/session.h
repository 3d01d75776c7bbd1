// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <whitney/io/read_problem.h>
#include <whitney/io/write_mesh.h>
#include <whitney/topology/mesh.h>
#include <whitney/tracing/trace.h>

// What the subcommands have in common.

namespace whitney::cli {

/// Seconds since the last call.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// While one is alive, SIGINT does not end the program but is remembered.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  bool interrupted() const;
};

/// Refuses before the work begins what can be refused then. Throws FileError when the folder of a file is not there or
/// may not be written into, InvalidInput when a mesh format does not fit the dimension.
void check_outputs(const std::vector<std::string>& outputs, const std::string& stats, int intrinsic_dim, bool polygons);

/// Writes every file, even if another fails; returns what went wrong, a line each, empty if nothing did.
std::string write_outputs(const std::vector<std::string>& outputs, const SimplicialMesh& mesh,
                          const PolygonMesh* polygons, const MeshWriteOptions& options);

/// The box of a problem, or nothing when it has none.
std::optional<Box> box_of(const Problem& problem);
/// The same of a list of sides.
std::optional<Box> to_box(const std::vector<std::array<double, 2>>& sides);

}  // namespace whitney::cli
