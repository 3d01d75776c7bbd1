// SPDX-License-Identifier: GPL-3.0-or-later
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/Traits.hh>

#include <whitney/io/formats/surface.h>

namespace whitney::io {

namespace {

using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// Silences OpenMesh for as long as it lives: it reports every face it refuses on a stream, a library must not.
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

}  // namespace

std::optional<std::vector<double>> vertex_normals(const MeshView& mesh) {
  if (!mesh.oriented) return std::nullopt;
  const Quiet quiet;
  HalfEdgeMesh half_edges;
  const std::size_t m = mesh.num_points();
  half_edges.reserve(m, mesh.corners.size() / 2 + 1, mesh.num_cells());
  for (std::size_t i = 0; i < m; ++i) half_edges.add_vertex(HalfEdgeMesh::Point(mesh.position(i).data()));
  std::vector<HalfEdgeMesh::VertexHandle> face;
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    face.clear();
    for (const std::uint32_t v : mesh.cell(c)) face.emplace_back(static_cast<int>(v));
    if (!half_edges.add_face(face).is_valid()) return std::nullopt;
  }
  if (half_edges.n_faces() != mesh.num_cells()) return std::nullopt;
  half_edges.request_face_normals();
  half_edges.request_vertex_normals();
  half_edges.update_normals();
  std::vector<double> normals;
  normals.reserve(3 * m);
  for (std::size_t i = 0; i < m; ++i) {
    const auto n = half_edges.normal(HalfEdgeMesh::VertexHandle(static_cast<int>(i)));
    normals.insert(normals.end(), n.data(), n.data() + 3);
  }
  return normals;
}

}  // namespace whitney::io
