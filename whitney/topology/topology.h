// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <coxeter/base/run_control.h>
#include <whitney/topology/homology.h>
#include <whitney/topology/incidence.h>
#include <whitney/topology/mesh.h>
#include <whitney/topology/vertex_links.h>

namespace whitney {

/// What to compute beyond the counts, components, boundary and orientability, which are always there: with neither
/// links nor homology, time and memory are those of the faces of the complex.
struct TopologyOptions {
  bool links = true;     ///< decide whether a mesh is a manifold (not for complexes given by facets)
  bool homology = true;  ///< homology_z and betti_z2
  std::size_t max_homology_cells = std::numeric_limits<std::size_t>::max();  ///< skip homology of larger complexes
  /// Unless empty: asked before "homology" and "vertex links" begin, with the f-vector; false leaves that part out.
  std::function<bool(const char* part, const std::vector<std::size_t>& f_vector)> begin_part{};
  /// The limits of time and memory and `progress` (phases "homology" and "links"): what was asked for and would exceed
  /// them is left out, see Topology::left_out. The counts are not limited; max_simplices is not asked.
  RunControl run{};
};

/// Decided by the links of the vertices, see check_vertex_links.
enum class ManifoldKind {
  kNotChecked,    ///< options.links was false, the links were left out, or the input was not a simplicial mesh
  kClosed,        ///< every link is a sphere
  kWithBoundary,  ///< every link is a sphere or a ball, one at least a ball
  kSingular,      ///< some link is neither; `witness` says which
};

/// The topology of an n-dimensional complex.
struct Topology {
  std::vector<std::size_t> f_vector;      ///< number of cells of dimension 0..n; unused points are no cells
  std::int64_t euler_characteristic = 0;  ///< f_0 - f_1 + f_2 - ..
  std::size_t components = 0;             ///< connected components
  std::size_t unused_points = 0;          ///< points of the mesh that no simplex uses

  bool pure = true;                     ///< every cell lies in an n-cell; a mesh is always pure
  std::size_t boundary_faces = 0;       ///< (n-1)-cells in exactly one n-cell
  std::size_t boundary_components = 0;  ///< connected components of their union; for a surface: boundary loops
  std::size_t branching_faces = 0;      ///< (n-1)-cells in three or more n-cells; 0 for a pseudomanifold
  bool orientable = true;               ///< no branching faces, and the n-cells can be oriented consistently

  ManifoldKind manifold = ManifoldKind::kNotChecked;
  bool links_proved = false;  ///< false for n >= 4 if some link is only known to have the right homology
  /// Vertices with a bad link; where left_out names "vertex links", those found until then.
  std::size_t singular_vertices = 0;
  std::optional<LinkDefect> witness;  ///< the first place that is not a manifold

  std::optional<std::vector<HomologyGroup>> homology_z;  ///< H_0 .. H_n; empty when not computed
  std::optional<std::vector<std::size_t>> betti_z2;      ///< Betti numbers over Z/2

  /// What TopologyOptions asked for and a limit kept from being finished: "homology", "vertex links". Nothing stands in
  /// the place of what is left out, with one exception: a defect that was found before the limit is still a proof, so
  /// `manifold` is kSingular then.
  std::vector<std::string> left_out;
  StopReason stop_reason = StopReason::kNone;  ///< the limit; kNone if TopologyOptions::begin_part left it out

  bool is_closed_manifold() const { return manifold == ManifoldKind::kClosed; }
  /// Closed ones included.
  bool is_manifold() const { return manifold == ManifoldKind::kClosed || manifold == ManifoldKind::kWithBoundary; }
};

/// The topology of a mesh. The mesh without simplices is a closed manifold without components.
/// Throws InvalidInput for what is not a simplicial complex: a vertex out of range or twice in a simplex, two simplices
/// with the same vertices, arrays whose lengths do not fit.
Topology topology_of(const SimplicialMesh& mesh, const TopologyOptions& options = {});

/// The topology of a regular CW complex given by its facets (see chain_complex.h), pure or not; n = facets.size() - 1.
/// Throws InvalidInput as regular_cell_signs() does.
Topology topology_of(std::span<const Incidence> facets, const TopologyOptions& options = {});

}  // namespace whitney
