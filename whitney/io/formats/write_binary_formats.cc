// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <set>

#include <whitney/io/formats/color_map.h>
#include <whitney/io/formats/mesh_writers.h>
#include <whitney/io/formats/surface.h>

// Not by OpenMesh's writer, which rounds coordinates and normals to float.
static_assert(std::endian::native == std::endian::little, "binary files are written in the byte order of the machine");

namespace whitney::io {

namespace {

template <class T>
void append(std::string& row, T value) {
  row.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Names for the components of arrays that are legal in PLY (no blanks) and not taken.
std::vector<std::string> property_names(std::span<const NamedArray> arrays, std::set<std::string> taken) {
  std::vector<std::string> names;
  for (const NamedArray& array : arrays) {
    std::string base;
    for (const char c : array.name) base += std::isgraph(static_cast<unsigned char>(c)) ? c : '_';
    if (base.empty()) base = "value";
    for (int k = 1; k <= array.components; ++k) {
      std::string name = array.components == 1 ? base : base + "_" + std::to_string(k);
      while (!taken.insert(name).second) name += "_";
      names.push_back(name);
    }
  }
  return names;
}

void append_values(std::string& row, std::span<const NamedArray> arrays, std::size_t i) {
  for (const NamedArray& array : arrays) {
    const auto n = static_cast<std::size_t>(array.components);
    for (std::size_t k = 0; k < n; ++k) append(row, array.values[i * n + k]);
  }
}

}  // namespace

void write_ply(AtomicFile& file, const MeshView& mesh) {
  const auto d = static_cast<std::size_t>(mesh.ambient_dim);
  const auto normals = mesh.dim == 2 && mesh.normals ? vertex_normals(mesh) : std::nullopt;

  std::set<std::string> taken = {"x",   "y",     "z",    "nx",      "ny",      "nz",
                                 "red", "green", "blue", "vertex1", "vertex2", "vertex_indices"};
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment written by whitney-toolkit\n";
  std::string vertex = "element vertex " + std::to_string(mesh.num_points()) +
                       "\nproperty double x\nproperty double y\nproperty double z\n";
  if (normals) vertex += "property double nx\nproperty double ny\nproperty double nz\n";
  if (!mesh.color.empty()) vertex += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (d > 3) {
    for (std::size_t i = 0; i < d; ++i) {
      const std::string name = "x" + std::to_string(i + 1);
      taken.insert(name);
      vertex += "property double " + name + "\n";
      std::string variable = mesh.variables[i];
      std::replace_if(
          variable.begin(), variable.end(), [](unsigned char c) { return std::iscntrl(c); }, ' ');
      if (variable != name) header += "comment " + name + " is " + variable + "\n";
    }
  }
  for (const std::string& name : property_names(mesh.point_data, taken)) vertex += "property double " + name + "\n";

  std::size_t most_corners = 0;
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) most_corners = std::max(most_corners, mesh.cell(c).size());
  const bool short_counts = most_corners < 256;
  std::string cells = mesh.dim == 1 ? "element edge " + std::to_string(mesh.num_cells()) +
                                          "\nproperty uint vertex1\nproperty uint vertex2\n"
                                    : "element face " + std::to_string(mesh.num_cells()) + "\nproperty list " +
                                          (short_counts ? "uchar" : "uint") + " uint vertex_indices\n";
  for (const std::string& name : property_names(mesh.cell_data, taken)) cells += "property double " + name + "\n";
  // The curves on a surface that are strata of it; its corners are marked at the vertices.
  std::string edges;
  for (const MeshStratum& stratum : mesh.strata) {
    if (mesh.dim != 2 || stratum.dim != 1) continue;
    for (std::size_t i = 0; i < stratum.simplices.size(); i += 2) {
      append(edges, stratum.simplices[i]);
      append(edges, stratum.simplices[i + 1]);
      append(edges, static_cast<double>(stratum.stratum));
    }
  }
  if (!edges.empty())
    cells += "element edge " + std::to_string(edges.size() / 16) +
             "\nproperty uint vertex1\nproperty uint vertex2\nproperty double stratum\n";
  file.write(header + vertex + cells + "end_header\n");

  std::string row;
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    row.clear();
    for (const double x : mesh.position(i)) append(row, x);
    for (std::size_t k = 0; normals && k < 3; ++k) append(row, (*normals)[3 * i + k]);
    if (!mesh.color.empty()) {
      for (const double c : color_of(mesh.color[i])) append(row, static_cast<std::uint8_t>(std::lround(255 * c)));
    }
    for (std::size_t k = 0; d > 3 && k < d; ++k) append(row, mesh.points[i * d + k]);
    append_values(row, mesh.point_data, i);
    file.write(row);
  }
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    row.clear();
    const auto cell = mesh.cell(c);
    if (mesh.dim == 2 && short_counts) append(row, static_cast<std::uint8_t>(cell.size()));
    if (mesh.dim == 2 && !short_counts) append(row, static_cast<std::uint32_t>(cell.size()));
    for (const std::uint32_t v : cell) append(row, v);
    append_values(row, mesh.cell_data, c);
    file.write(row);
  }
  file.write(edges);
}

void write_stl(AtomicFile& file, const MeshView& mesh) {
  std::uint32_t facets = 0;
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) facets += static_cast<std::uint32_t>(mesh.cell(c).size()) - 2;
  std::string row = "written by whitney-toolkit, binary STL";  // must not begin with "solid"
  row.resize(80, ' ');
  append(row, facets);
  file.write(row);
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    const auto normal = area_vector(mesh, c);
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    const auto cell = mesh.cell(c);
    for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
      row.clear();
      for (const double x : normal) append(row, static_cast<float>(length > 0 ? x / length : 0));
      for (const std::uint32_t v : {cell[0], cell[i], cell[i + 1]}) {
        for (const double x : mesh.position(v)) append(row, static_cast<float>(x));
      }
      append(row, std::uint16_t{0});
      file.write(row);
    }
  }
}

}  // namespace whitney::io
