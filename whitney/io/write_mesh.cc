// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/write_mesh.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include <coxeter/base/error.h>
#include <whitney/functions/projection.h>
#include <whitney/io/formats/mesh_writers.h>
#include <whitney/io/formats/surface.h>

namespace whitney {

namespace {

using io::MeshView;

struct Format {
  std::string_view extension;
  void (*write)(AtomicFile&, const MeshView&);
  int min_dim, max_dim;
  bool polygons;
};

constexpr int kAnyDim = 1 << 20;
constexpr std::array kFormats = {
    Format{".noff", io::write_noff, 0, kAnyDim, true}, Format{".vtu", io::write_vtu, 0, 3, true},
    Format{".ply", io::write_ply, 1, 2, true},         Format{".obj", io::write_obj, 1, 2, true},
    Format{".off", io::write_off, 2, 2, true},         Format{".stl", io::write_stl, 2, 2, true},
    Format{".mesh", io::write_medit, 1, 3, false},     Format{".pov", io::write_pov, 1, 2, true},
};

bool holds(const Format& format, int dim, bool polygons) {
  return dim >= format.min_dim && dim <= format.max_dim && (format.polygons || !polygons);
}

const Format& find_format(const std::filesystem::path& path, int dim, bool polygons) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string known, fitting;
  for (const Format& format : kFormats) {
    known += " " + std::string(format.extension);
    if (holds(format, dim, polygons)) fitting += " " + std::string(format.extension);
  }
  const auto format = std::find_if(kFormats.begin(), kFormats.end(), [&](auto& f) { return f.extension == extension; });
  if (format == kFormats.end()) {
    throw InvalidInput(path.string() + ": the extension is not that of a mesh format; known are" + known);
  }
  if (!holds(*format, dim, polygons)) {
    throw InvalidInput(path.string() + ": " + extension + " cannot hold " + (polygons ? "polygons" : "simplices") +
                       " of dimension " + std::to_string(dim) + "; these can:" + fitting);
  }
  return *format;
}

void check_arrays(std::span<const NamedArray> arrays, std::size_t count) {
  for (const NamedArray& array : arrays) {
    if (array.components < 1 || array.values.size() != count * static_cast<std::size_t>(array.components)) {
      throw InvalidInput("mesh: the array \"" + array.name + "\" has " + std::to_string(array.values.size()) +
                         " values, expected " + std::to_string(count) + " x " + std::to_string(array.components));
    }
  }
}

void check(const MeshView& mesh) {
  if (mesh.ambient_dim < 1 || mesh.points.size() % static_cast<std::size_t>(mesh.ambient_dim) != 0) {
    throw InvalidInput("mesh: the number of coordinates is not a multiple of ambient_dim, or ambient_dim < 1");
  }
  const std::size_t corners = mesh.corners.size();
  if (mesh.polygons) {
    if (mesh.offsets.empty() || mesh.offsets.front() != 0 || mesh.offsets.back() != corners) {
      throw InvalidInput("mesh: the offsets do not begin with 0 and end with the number of corners");
    }
    const std::uint32_t least = mesh.dim == 1 ? 2 : 3;
    for (std::size_t i = 0; i + 1 < mesh.offsets.size(); ++i) {
      if (mesh.offsets[i + 1] < mesh.offsets[i] || mesh.offsets[i + 1] - mesh.offsets[i] < least ||
          mesh.offsets[i + 1] > corners || (mesh.dim == 1 && mesh.offsets[i + 1] - mesh.offsets[i] != 2)) {
        throw InvalidInput("mesh: cell " + std::to_string(i) + " has too few corners, or too many for an edge");
      }
    }
  } else if (corners % static_cast<std::size_t>(mesh.dim + 1) != 0) {
    throw InvalidInput("mesh: the number of corners is not a multiple of dim + 1");
  }
  const std::size_t num_points = mesh.num_points();
  for (const std::uint32_t v : mesh.corners) {
    if (v >= num_points) {
      throw InvalidInput("mesh: a cell names point " + std::to_string(v) + ", there are " + std::to_string(num_points));
    }
  }
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    const auto cell = mesh.cell(c);
    for (std::size_t i = 1; i < cell.size(); ++i) {
      if (std::find(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(i), cell[i]) !=
          cell.begin() + static_cast<std::ptrdiff_t>(i)) {
        throw InvalidInput("mesh: cell " + std::to_string(c) + " names point " + std::to_string(cell[i]) + " twice");
      }
    }
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (!std::isfinite(mesh.points[i])) {
      throw InvalidInput("mesh: point " + std::to_string(i / static_cast<std::size_t>(mesh.ambient_dim)) +
                         " has a coordinate that is not finite");
    }
  }
  for (const MeshStratum& stratum : mesh.strata) {
    const auto size = static_cast<std::size_t>(stratum.dim) + 1;
    if (stratum.dim < 0 || stratum.dim >= mesh.dim || stratum.simplices.size() % size != 0 ||
        std::any_of(stratum.simplices.begin(), stratum.simplices.end(), [&](auto v) { return v >= num_points; })) {
      throw InvalidInput("mesh: stratum " + std::to_string(stratum.stratum) + " is no list of simplices of the mesh");
    }
  }
  check_arrays(mesh.point_data, num_points);
  check_arrays(mesh.cell_data, mesh.num_cells());
}

/// The values that colour the vertices, spread over [0, 1]; empty for no colours.
std::vector<double> color_values(const MeshView& mesh, const std::string& color_by, const std::vector<double>& placed) {
  const auto m = mesh.num_points();
  const auto d = static_cast<std::size_t>(mesh.ambient_dim);
  std::vector<double> values(m);
  if (color_by.empty()) {
    if (mesh.ambient_dim <= 3) return {};
    for (std::size_t i = 0; i < m; ++i) values[i] = placed[4 * i + 3];
  } else {
    const auto array = std::find_if(mesh.point_data.begin(), mesh.point_data.end(),
                                    [&](const NamedArray& a) { return a.name == color_by && a.components == 1; });
    const auto variable = std::find(mesh.variables.begin(), mesh.variables.end(), color_by) - mesh.variables.begin();
    if (array != mesh.point_data.end()) {
      values = array->values;
    } else if (static_cast<std::size_t>(variable) < d) {
      for (std::size_t i = 0; i < m; ++i) values[i] = mesh.points[i * d + static_cast<std::size_t>(variable)];
    } else {
      throw InvalidInput("color_by: \"" + color_by + "\" is neither a point array of one component nor a variable");
    }
  }
  double low = 0, high = 0;
  bool any = false;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    low = any ? std::min(low, v) : v;
    high = any ? std::max(high, v) : v;
    any = true;
  }
  for (double& v : values) v = std::isfinite(v) && high > low ? (v / 2 - low / 2) / (high / 2 - low / 2) : 0.5;
  return values;
}

void write_view(const std::filesystem::path& path, MeshView mesh, const MeshWriteOptions& options) {
  const Format& format = find_format(path, mesh.dim, mesh.polygons);
  check(mesh);
  mesh.variables = options.variables;
  if (mesh.variables.empty()) {
    for (int i = 1; i <= mesh.ambient_dim; ++i) mesh.variables.push_back("x" + std::to_string(i));
  }
  mesh.normals = options.normals;
  if (format.write != io::write_noff) {
    const std::size_t m = mesh.num_points();
    std::vector<double> placed;
    if (m > 0)
      placed = project(make_projection(options.projection, mesh.points, mesh.ambient_dim, mesh.variables), mesh.points);
    mesh.xyz.resize(3 * m);
    for (std::size_t i = 0; i < m; ++i)
      std::copy_n(placed.begin() + static_cast<std::ptrdiff_t>(4 * i), 3,
                  mesh.xyz.begin() + static_cast<std::ptrdiff_t>(3 * i));
    mesh.color = color_values(mesh, options.color_by, placed);
  }
  if (mesh.dim == 2) mesh.oriented = io::orient_cells(mesh);
  AtomicFile file(path);
  format.write(file, mesh);
  file.commit();
}

}  // namespace

void write_mesh(const std::filesystem::path& path, const SimplicialMesh& mesh, const MeshWriteOptions& options) {
  if (mesh.dim < 0) throw InvalidInput("mesh: dim is negative");
  MeshView view;
  view.ambient_dim = mesh.ambient_dim;
  view.dim = mesh.dim;
  view.points = mesh.points;
  view.corners = mesh.simplices;
  view.point_data = mesh.point_data;
  view.cell_data = mesh.cell_data;
  view.strata = mesh.strata;
  write_view(path, std::move(view), options);
}

void write_mesh(const std::filesystem::path& path, const PolygonMesh& mesh, const MeshWriteOptions& options) {
  if (mesh.dim != 1 && mesh.dim != 2) throw InvalidInput("mesh: the cells of a polygon mesh have dimension 1 or 2");
  MeshView view;
  view.ambient_dim = mesh.ambient_dim;
  view.dim = mesh.dim;
  view.polygons = mesh.dim == 2;
  view.points = mesh.points;
  view.corners = mesh.corners;
  view.offsets = mesh.offsets;
  view.point_data = mesh.point_data;
  view.cell_data = mesh.cell_data;
  if (mesh.offsets.empty()) throw InvalidInput("mesh: the offsets must begin with 0");
  write_view(path, std::move(view), options);
}

void check_mesh_format(const std::filesystem::path& path, int intrinsic_dim, bool polygons) {
  find_format(path, intrinsic_dim, polygons);
}

}  // namespace whitney
