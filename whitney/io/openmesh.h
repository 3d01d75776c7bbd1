// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Meshes of ours to OpenMesh's half-edge meshes, and back, with nothing lost in silence.
///
/// The one public header that includes OpenMesh: who includes it compiles and links with OpenMesh (pkg-config module
/// `openmesh`) besides whitney::whitney. The library itself does not need OpenMesh.

#if !__has_include(<OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>)
#error "whitney/io/openmesh.h needs OpenMesh (Debian: libopenmesh-dev; pkg-config: openmesh)"
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <coxeter/base/error.h>
#include <whitney/topology/half_edges.h>
#include <whitney/topology/mesh.h>

namespace whitney {

/// The vertex property, a std::vector<double>, that holds all d coordinates of a point.
inline constexpr const char* kOpenMeshCoordinates = "whitney:coordinates";
/// The property, an int, of a vertex that is a stratum of dimension 0, and of a half-edge that is a simplex of a
/// stratum of dimension 1, in its direction: the number of the stratum; -1 elsewhere. (SimplicialMesh::strata. The
/// arrays "stratum" of point_data and cell_data are properties under their own name, like every other array.)
inline constexpr const char* kOpenMeshStratum = "whitney:stratum";

/// A cell that OpenMesh takes no face for.
struct RefusedCell {
  enum class Reason {
    kEdge,  ///< one of its half-edges has a face: the edge is in three cells, or its two cells cannot agree (one-sided)
    kVertex,  ///< a closed fan of faces surrounds one of its corners
    kFan,     ///< it would close a fan at a corner where another fan is
  };
  std::uint32_t cell = 0;
  Reason reason = Reason::kEdge;

  bool operator==(const RefusedCell&) const = default;
};

struct ToOpenMeshOptions {
  /// Where a point of R^d (d numbers) is put in R^3. Not given: its first three coordinates, 0 where d < 3.
  std::function<std::array<double, 3>(std::span<const double>)> projection{};
  /// Turns cells until neighbours agree, in every orientable component, as the component's first cell runs. Otherwise
  /// OpenMesh refuses a cell that does not agree with its neighbours.
  bool orient = true;
};

template <class Mesh>
struct ToOpenMeshResult {
  Mesh mesh;                                ///< vertex i is point i; faces are the cells in order, but for `refused`
  std::vector<RefusedCell> refused;         ///< by increasing cell
  std::vector<std::uint32_t> cell_of_face;  ///< of each face
  std::vector<std::uint32_t> turned;        ///< cells whose corners but the first are in reverse order, increasing
  /// Simplices of strata that no vertex or half-edge holds: no edge of `mesh`, or already in another stratum.
  std::vector<MeshStratum> refused_strata;

  /// All cells and strata are in `mesh`.
  bool complete() const { return refused.empty() && refused_strata.empty(); }
};

struct FromOpenMeshOptions {
  /// Coordinates are those of the mesh's own points (d their number, mostly 3) although kOpenMeshCoordinates is there:
  /// for a mesh whose points were moved.
  bool own_points = false;
};

namespace openmesh_detail {

/// Silences OpenMesh, which reports every face it refuses on a stream. The stream belongs to the whole program.
class Quiet {
 public:
  Quiet() : enabled_(omerr().is_enabled()) { omerr().disable(); }
  ~Quiet() {
    if (enabled_) omerr().enable();
  }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  bool enabled_;
};

inline void require(bool condition, const std::string& message) {
  if (!condition) throw InvalidInput("mesh: " + message);
}

inline void check_arrays(std::span<const NamedArray> arrays, std::size_t count) {
  for (const NamedArray& array : arrays) {
    require(array.components >= 1 && array.values.size() == count * static_cast<std::size_t>(array.components),
            "the array \"" + array.name + "\" has " + std::to_string(array.values.size()) + " values, expected " +
                std::to_string(count) + " x " + std::to_string(array.components));
    require(array.name != kOpenMeshCoordinates && array.name != kOpenMeshStratum,
            "the name \"" + array.name + "\" of an array is taken by whitney/io/openmesh.h");
  }
}

inline void check_cells(const Incidence& cells, std::size_t num_points, bool triangles) {
  std::vector<std::uint32_t> sorted;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string name = "cell " + std::to_string(c);
    require(cells[c].size() >= 3, name + " has fewer than 3 corners");
    require(!triangles || cells[c].size() == 3,
            name + " has " + std::to_string(cells[c].size()) + " corners; a TriMesh holds triangles only");
    sorted.assign(cells[c].begin(), cells[c].end());
    std::sort(sorted.begin(), sorted.end());
    require(sorted.back() < num_points,
            name + " names point " + std::to_string(sorted.back()) + ", there are " + std::to_string(num_points));
    require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(), name + " names a point twice");
  }
}

inline Incidence cells_of(const SimplicialMesh& mesh) {
  require(mesh.dim == 2, "OpenMesh holds surfaces; dim is " + std::to_string(mesh.dim));
  require(mesh.simplices.size() % 3 == 0, "the number of corners is not a multiple of dim + 1");
  Incidence cells;
  for (std::size_t end = 3; end <= mesh.simplices.size(); end += 3)
    cells.offset.push_back(static_cast<std::uint32_t>(end));
  cells.index = mesh.simplices;
  return cells;
}

inline Incidence cells_of(const PolygonMesh& mesh) {
  require(mesh.dim == 2, "OpenMesh holds surfaces; dim is " + std::to_string(mesh.dim));
  require(!mesh.offsets.empty() && mesh.offsets.front() == 0 && mesh.offsets.back() == mesh.corners.size() &&
              std::is_sorted(mesh.offsets.begin(), mesh.offsets.end()),
          "the offsets do not increase from 0 to the number of corners");
  return {mesh.offsets, mesh.corners};
}

/// Turns the cells; returns those that it turned.
inline std::vector<std::uint32_t> orient(Incidence& cells, std::size_t num_points) {
  const CellOrientation orientation = orient_polygons(cells, num_points);
  std::vector<std::uint32_t> turned;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (orientation.sign[c] > 0) continue;
    turned.push_back(static_cast<std::uint32_t>(c));
    std::reverse(cells.index.begin() + cells.offset[c] + 1, cells.index.begin() + cells.offset[c + 1]);
  }
  return turned;
}

inline OpenMesh::VertexHandle vertex(std::uint32_t i) { return OpenMesh::VertexHandle(static_cast<int>(i)); }

template <class Mesh>
void add_points(Mesh& out, const std::vector<double>& points, int ambient_dim, const ToOpenMeshOptions& options) {
  using Point = typename Mesh::Point;
  using Scalar = typename OpenMesh::vector_traits<Point>::value_type;
  constexpr std::size_t kSize = OpenMesh::vector_traits<Point>::size_;
  OpenMesh::VPropHandleT<std::vector<double>> coordinates;
  out.add_property(coordinates, kOpenMeshCoordinates);
  const auto d = static_cast<std::size_t>(ambient_dim);
  for (std::size_t i = 0; i < points.size(); i += d) {
    const std::span<const double> x(points.data() + i, d);
    std::array<double, 3> projected{};
    if (options.projection) projected = options.projection(x);
    const std::span<const double> place = options.projection ? std::span<const double>(projected) : x;
    Point point;
    for (std::size_t k = 0; k < kSize; ++k) point[k] = k < place.size() ? static_cast<Scalar>(place[k]) : Scalar(0);
    out.property(coordinates, out.add_vertex(point)).assign(x.begin(), x.end());
  }
}

/// Adds the face, or says why not.
template <class Mesh>
bool add_face(Mesh& out, const std::vector<OpenMesh::VertexHandle>& face, RefusedCell::Reason& reason) {
  for (std::size_t i = 0; i < face.size(); ++i) {
    const OpenMesh::HalfedgeHandle h = out.find_halfedge(face[i], face[i + 1 == face.size() ? 0 : i + 1]);
    reason = RefusedCell::Reason::kEdge;
    if (h.is_valid() && !out.is_boundary(h)) return false;
  }
  reason = RefusedCell::Reason::kVertex;
  for (const OpenMesh::VertexHandle v : face) {
    if (!out.is_boundary(v)) return false;
  }
  reason = RefusedCell::Reason::kFan;
  return out.add_face(face).is_valid();
}

template <class Mesh>
void add_faces(ToOpenMeshResult<Mesh>& out, const Incidence& cells) {
  const Quiet quiet;
  std::vector<OpenMesh::VertexHandle> face;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto cell = static_cast<std::uint32_t>(c);
    face.clear();
    for (const std::uint32_t v : cells[c]) face.push_back(vertex(v));
    RefusedCell::Reason reason{};
    if (add_face(out.mesh, face, reason)) {
      out.cell_of_face.push_back(cell);
    } else {
      out.refused.push_back({cell, reason});
    }
  }
}

/// One property per array: a double for one component, else a std::vector<double>. `source` is the row of the array
/// for each element.
template <template <class> class PropHandle, class Handle, class Mesh>
void add_arrays(Mesh& out, std::span<const NamedArray> arrays, std::size_t count, auto source) {
  for (const NamedArray& array : arrays) {
    const auto size = static_cast<std::size_t>(array.components);
    PropHandle<double> number;
    PropHandle<std::vector<double>> vector;
    if (size == 1) {
      out.add_property(number, array.name);
    } else {
      out.add_property(vector, array.name);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Handle handle(static_cast<int>(i));
      const double* row = array.values.data() + source(i) * size;
      if (size == 1) {
        out.property(number, handle) = *row;
      } else {
        out.property(vector, handle).assign(row, row + size);
      }
    }
  }
}

template <class Mesh>
void add_strata(ToOpenMeshResult<Mesh>& out, const SimplicialMesh& mesh) {
  if (mesh.strata.empty()) return;
  OpenMesh::VPropHandleT<int> of_vertex;
  OpenMesh::HPropHandleT<int> of_halfedge;
  out.mesh.add_property(of_vertex, kOpenMeshStratum);
  out.mesh.add_property(of_halfedge, kOpenMeshStratum);
  for (const auto v : out.mesh.vertices()) out.mesh.property(of_vertex, v) = -1;
  for (const auto h : out.mesh.halfedges()) out.mesh.property(of_halfedge, h) = -1;
  for (const MeshStratum& stratum : mesh.strata) {
    const auto size = static_cast<std::size_t>(stratum.dim) + 1;
    MeshStratum left{stratum.stratum, stratum.dim, {}};
    for (std::size_t i = 0; i < stratum.simplices.size(); i += size) {
      const OpenMesh::VertexHandle a = vertex(stratum.simplices[i]);
      int* place = nullptr;
      if (size == 1) {
        place = &out.mesh.property(of_vertex, a);
        if (*place != -1) place = nullptr;
      } else if (const auto h = out.mesh.find_halfedge(a, vertex(stratum.simplices[i + 1])); h.is_valid()) {
        place = &out.mesh.property(of_halfedge, h);
        if (*place != -1 || out.mesh.property(of_halfedge, out.mesh.opposite_halfedge_handle(h)) != -1) place = nullptr;
      }
      if (place != nullptr) {
        *place = stratum.stratum;
      } else {
        left.simplices.insert(left.simplices.end(), stratum.simplices.begin() + static_cast<std::ptrdiff_t>(i),
                              stratum.simplices.begin() + static_cast<std::ptrdiff_t>(i + size));
      }
    }
    if (!left.simplices.empty()) out.refused_strata.push_back(std::move(left));
  }
}

inline void check_strata(const SimplicialMesh& mesh) {
  for (const MeshStratum& stratum : mesh.strata) {
    const std::size_t size = stratum.dim == 0 ? 1 : 2;
    require(stratum.stratum >= 0 && (stratum.dim == 0 || stratum.dim == 1) && stratum.simplices.size() % size == 0 &&
                std::all_of(stratum.simplices.begin(), stratum.simplices.end(),
                            [&](std::uint32_t v) { return v < mesh.num_points(); }),
            "stratum " + std::to_string(stratum.stratum) + " is no list of points or edges of the mesh");
  }
}

/// Reads the property `base` as an array if it is one of numbers: appends the rows of `handles`.
template <class Handles>
void read_array(std::vector<NamedArray>& out, const OpenMesh::BaseProperty* base, const Handles& handles) {
  if (base == nullptr || base->name() == kOpenMeshCoordinates) return;
  if (const auto* number = dynamic_cast<const OpenMesh::PropertyT<double>*>(base)) {
    NamedArray& array = out.emplace_back(NamedArray{base->name(), 1, {}});
    for (const auto h : handles) array.values.push_back((*number)[h.idx()]);
  } else if (const auto* vector = dynamic_cast<const OpenMesh::PropertyT<std::vector<double>>*>(base)) {
    NamedArray& array = out.emplace_back(NamedArray{base->name(), 1, {}});
    bool first = true;
    for (const auto h : handles) {
      const std::vector<double>& row = (*vector)[h.idx()];
      if (std::exchange(first, false)) array.components = static_cast<int>(row.size());
      require(!row.empty() && row.size() == static_cast<std::size_t>(array.components),
              "the property \"" + array.name + "\" of element " + std::to_string(h.idx()) + " has " +
                  std::to_string(row.size()) + " numbers, others have " + std::to_string(array.components));
      array.values.insert(array.values.end(), row.begin(), row.end());
    }
  }
}

/// Sets ambient_dim and points.
template <class Result, class Mesh>
void read_points(Result& out, const Mesh& mesh, const std::vector<OpenMesh::VertexHandle>& vertices,
                 const FromOpenMeshOptions& options) {
  using Point = typename Mesh::Point;
  OpenMesh::VPropHandleT<std::vector<double>> coordinates;
  if (options.own_points || !mesh.get_property_handle(coordinates, kOpenMeshCoordinates)) {
    out.ambient_dim = OpenMesh::vector_traits<Point>::size_;
    for (const auto v : vertices) {
      const Point& point = mesh.point(v);
      for (int k = 0; k < out.ambient_dim; ++k)
        out.points.push_back(static_cast<double>(point[static_cast<std::size_t>(k)]));
    }
    return;
  }
  out.ambient_dim = vertices.empty() ? OpenMesh::vector_traits<Point>::size_
                                     : static_cast<int>(mesh.property(coordinates, vertices[0]).size());
  for (const auto v : vertices) {
    const std::vector<double>& x = mesh.property(coordinates, v);
    require(!x.empty() && x.size() == static_cast<std::size_t>(out.ambient_dim),
            "vertex " + std::to_string(v.idx()) + " has " + std::to_string(x.size()) + " coordinates in \"" +
                kOpenMeshCoordinates + "\", others have " + std::to_string(out.ambient_dim));
    out.points.insert(out.points.end(), x.begin(), x.end());
  }
}

/// Strata by number, then dimension; the simplices of each in the order of vertices or half-edges.
template <class Mesh>
std::vector<MeshStratum> read_strata(const Mesh& mesh, const std::vector<std::uint32_t>& index) {
  std::map<std::pair<int, int>, MeshStratum> strata;
  const auto at = [&strata](int number, int dim) -> std::vector<std::uint32_t>& {
    return strata.try_emplace({number, dim}, MeshStratum{number, dim, {}}).first->second.simplices;
  };
  const auto index_of = [&index](OpenMesh::VertexHandle v) { return index[static_cast<std::size_t>(v.idx())]; };
  OpenMesh::VPropHandleT<int> of_vertex;
  if (mesh.get_property_handle(of_vertex, kOpenMeshStratum)) {
    for (const auto v : mesh.vertices()) {
      if (const int number = mesh.property(of_vertex, v); number >= 0) at(number, 0).push_back(index_of(v));
    }
  }
  OpenMesh::HPropHandleT<int> of_halfedge;
  if (mesh.get_property_handle(of_halfedge, kOpenMeshStratum)) {
    for (const auto h : mesh.halfedges()) {
      const int number = mesh.property(of_halfedge, h);
      if (number < 0) continue;
      std::vector<std::uint32_t>& simplices = at(number, 1);
      simplices.push_back(index_of(mesh.from_vertex_handle(h)));
      simplices.push_back(index_of(mesh.to_vertex_handle(h)));
    }
  }
  std::vector<MeshStratum> sorted;
  for (auto& [key, stratum] : strata) sorted.push_back(std::move(stratum));
  return sorted;
}

}  // namespace openmesh_detail

/// The surface as a half-edge mesh: `Mesh` is an OpenMesh::PolyMesh_ArrayKernelT<Traits> or, for triangles, an
/// OpenMesh::TriMesh_ArrayKernelT<Traits>; `Ours` is SimplicialMesh of dim 2 or PolygonMesh of dim 2. Coordinates,
/// strata and arrays become properties (see kOpenMeshCoordinates, kOpenMeshStratum): an array of point_data or
/// cell_data a vertex or face property under its name, a double for one component, else a std::vector<double>.
///
/// A half-edge mesh holds no edge in three faces, and at no point another face beside a closed fan. Cells are added in
/// order, and those that OpenMesh refuses are listed in the result: which ones depends on the order. Open fans that
/// meet in a point are taken (Mesh::is_manifold(vertex) tells). OpenMesh's error stream omerr(), which the whole
/// program shares, is silent meanwhile: no other thread may switch it at the same time.
///
/// Throws InvalidInput for another dimension, an index or a size out of range, a cell that names a point twice, a
/// polygon with more than three corners for a TriMesh, an array that has the name of one of ours.
template <class Mesh, class Ours>
ToOpenMeshResult<Mesh> to_openmesh(const Ours& mesh, const ToOpenMeshOptions& options = {}) {
  namespace detail = openmesh_detail;
  detail::require(mesh.ambient_dim >= 1 && mesh.points.size() % static_cast<std::size_t>(mesh.ambient_dim) == 0,
                  "the number of coordinates is not a multiple of ambient_dim, or ambient_dim < 1");
  Incidence cells = detail::cells_of(mesh);
  detail::check_cells(cells, mesh.num_points(), Mesh::is_trimesh());
  detail::check_arrays(mesh.point_data, mesh.num_points());
  detail::check_arrays(mesh.cell_data, cells.size());
  if constexpr (std::is_same_v<Ours, SimplicialMesh>) detail::check_strata(mesh);

  ToOpenMeshResult<Mesh> out;
  out.mesh.reserve(mesh.num_points(), cells.index.size() / 2 + 1, cells.size());
  if (options.orient) out.turned = detail::orient(cells, mesh.num_points());
  detail::add_points(out.mesh, mesh.points, mesh.ambient_dim, options);
  detail::add_faces(out, cells);
  detail::add_arrays<OpenMesh::VPropHandleT, OpenMesh::VertexHandle>(out.mesh, mesh.point_data, mesh.num_points(),
                                                                     [](std::size_t i) { return i; });
  detail::add_arrays<OpenMesh::FPropHandleT, OpenMesh::FaceHandle>(
      out.mesh, mesh.cell_data, out.cell_of_face.size(),
      [&out](std::size_t i) { return std::size_t{out.cell_of_face[i]}; });
  if constexpr (std::is_same_v<Ours, SimplicialMesh>) detail::add_strata(out, mesh);
  return out;
}

/// The way back, `Ours` = SimplicialMesh or PolygonMesh. Points and cells are the vertices and faces that are not
/// marked as deleted, in their order, a face from the corner it was made from. Coordinates are kOpenMeshCoordinates if
/// there, else the mesh's own points. Every vertex and face property of type double or std::vector<double> becomes an
/// array; those of other types (OpenMesh's own normals and colors too) have no place here. The strata (of a
/// SimplicialMesh) are sorted by number, then dimension; their edges by half-edge.
///
/// Throws InvalidInput for a face of more than three corners when `Ours` is SimplicialMesh, and for vectors of
/// different lengths (or none) in one property, as of vertices that were added since: set them, or ask for
/// `own_points`.
template <class Ours, class Mesh>
Ours from_openmesh(const Mesh& mesh, const FromOpenMeshOptions& options = {}) {
  namespace detail = openmesh_detail;
  std::vector<OpenMesh::VertexHandle> vertices;
  std::vector<OpenMesh::FaceHandle> faces;
  std::vector<std::uint32_t> index(mesh.n_vertices(), 0);
  for (const auto v : mesh.vertices()) {
    index[static_cast<std::size_t>(v.idx())] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(v);
  }
  Ours out;
  out.dim = 2;
  detail::read_points(out, mesh, vertices, options);
  for (const auto f : mesh.faces()) {
    faces.push_back(f);
    std::vector<std::uint32_t> corners;
    for (auto v = mesh.cfv_begin(f); v.is_valid(); ++v) corners.push_back(index[static_cast<std::size_t>((*v).idx())]);
    if constexpr (std::is_same_v<Ours, SimplicialMesh>) {
      detail::require(corners.size() == 3, "face " + std::to_string(f.idx()) + " has " +
                                               std::to_string(corners.size()) + " corners; ask for a PolygonMesh");
      out.simplices.insert(out.simplices.end(), corners.begin(), corners.end());
    } else {
      out.corners.insert(out.corners.end(), corners.begin(), corners.end());
      out.offsets.push_back(static_cast<std::uint32_t>(out.corners.size()));
    }
  }
  for (auto p = mesh.vprops_begin(); p != mesh.vprops_end(); ++p) detail::read_array(out.point_data, *p, vertices);
  for (auto p = mesh.fprops_begin(); p != mesh.fprops_end(); ++p) detail::read_array(out.cell_data, *p, faces);
  if constexpr (std::is_same_v<Ours, SimplicialMesh>) out.strata = detail::read_strata(mesh, index);
  return out;
}

}  // namespace whitney
