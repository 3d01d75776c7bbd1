// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// A face of a mesh whose link is neither a sphere nor a ball.
struct LinkDefect {
  std::vector<std::uint32_t> face;  ///< its vertices, ascending; the mesh is no manifold at any of them
  std::string reason;               ///< a sentence about the link
};

struct LinkReport {
  /// Vertices on a face with a bad link, i.e. with a bad link themselves; those found so far when the run was stopped.
  std::size_t singular_vertices = 0;
  std::optional<LinkDefect> first;  ///< the defect at the vertex of the lowest index; a proof even when stopped
  /// Every link is proved a PL sphere or ball. Always so for n <= 3. For n >= 4 a link counts as good when it is a
  /// homology manifold with the integral homology of a sphere or ball; it is proved to be one when discrete Morse
  /// theory leaves no more than 2 or 1 cells of it. If that fails (the suspension of the Poincare sphere), this is
  /// false, and the mesh is a homology manifold, perhaps not a manifold.
  bool proved = true;
  StopReason stop_reason = StopReason::kNone;  ///< the limit that stopped the run; then not all links were looked at
};

/// Looks at the links of all vertices: the mesh is an n-manifold, with or without boundary, exactly when all are
/// spheres or balls of dimension n-1. Inside, every face is looked at once: the link of a vertex is a homology manifold
/// when the links of the larger faces around it are right. Time: linear for n <= 3 in the number of simplices; for n >=
/// 4 one homology computation per face of dimension <= n-4. Throws InvalidInput as face_lattice() does.
/// Of `run`, the limits of time and memory and `progress` (phase "links") are asked now and then.
LinkReport check_vertex_links(const SimplicialMesh& mesh, const RunControl& run = {});

}  // namespace whitney
