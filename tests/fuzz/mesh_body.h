// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <coxeter/base/error.h>
#include <whitney/io/formats/mesh_readers.h>
#include "bytes.h"

namespace whitney::fuzz {

/// Byte 0 chooses the reader, the rest is the file: a mesh that is well-formed, or a FileError.
inline void mesh_body(Bytes bytes) {
  using Reader = SimplicialMesh (*)(const std::string&, std::string_view);
  constexpr std::array<Reader, 6> kReaders = {io::read_off, io::read_ply,   io::read_obj,
                                              io::read_stl, io::read_medit, io::read_vtu};
  if (bytes.empty()) return;
  SimplicialMesh mesh;
  try {
    mesh = kReaders[bytes[0] % kReaders.size()]("fuzz", text_of(bytes.subspan(1)));
  } catch (const FileError&) {
    return;
  }
  demand(mesh.dim >= 0 && mesh.ambient_dim >= 0, "dimensions are not negative");
  demand(mesh.ambient_dim == 0 || mesh.points.size() % static_cast<std::size_t>(mesh.ambient_dim) == 0,
         "points are rows of d coordinates");
  demand(mesh.simplices.size() % static_cast<std::size_t>(mesh.dim + 1) == 0, "simplices are rows of n + 1 indices");
  for (const double x : mesh.points) demand(std::isfinite(x), "coordinates are finite");
  for (const std::uint32_t v : mesh.simplices) demand(v < mesh.num_points(), "indices are those of points");
  for (std::size_t i = 0; i < mesh.num_simplices(); ++i) {
    std::vector<std::uint32_t> corners(mesh.simplices.begin() + static_cast<std::ptrdiff_t>(i * (mesh.dim + 1)),
                                       mesh.simplices.begin() + static_cast<std::ptrdiff_t>((i + 1) * (mesh.dim + 1)));
    std::sort(corners.begin(), corners.end());
    demand(std::adjacent_find(corners.begin(), corners.end()) == corners.end(), "corners of a simplex are different");
  }
}

}  // namespace whitney::fuzz
