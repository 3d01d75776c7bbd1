// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are lists of numbers in text: OFF, nOFF, OBJ, medit.
#include <algorithm>

#include <whitney/io/formats/mesh_writers.h>
#include <whitney/io/formats/surface.h>

namespace whitney::io {

namespace {

void write_row(AtomicFile& file, std::span<const double> row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0) file.write(' ');
    file.write(row[i]);
  }
}

void write_off_cells(AtomicFile& file, const MeshView& mesh) {
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    const auto cell = mesh.cell(c);
    file.write(std::uint64_t{cell.size()});
    for (const std::uint32_t v : cell) {
      file.write(' ');
      file.write(std::uint64_t{v});
    }
    file.write('\n');
  }
}

void write_counts(AtomicFile& file, const MeshView& mesh) {
  file.write(std::uint64_t{mesh.num_points()});
  file.write(' ');
  file.write(std::uint64_t{mesh.num_cells()});
  file.write(" 0\n");
}

}  // namespace

void write_off(AtomicFile& file, const MeshView& mesh) {
  file.write("OFF\n");
  write_counts(file, mesh);
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    write_row(file, mesh.position(i));
    file.write('\n');
  }
  write_off_cells(file, mesh);
}

void write_noff(AtomicFile& file, const MeshView& mesh) {
  const auto d = static_cast<std::size_t>(mesh.ambient_dim);
  file.write("nOFF\n");
  file.write(std::uint64_t{d});
  file.write('\n');
  write_counts(file, mesh);
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    write_row(file, mesh.points.subspan(i * d, d));
    file.write('\n');
  }
  write_off_cells(file, mesh);
  // Four corners may be a quadrangle or a tetrahedron; the format itself does not tell.
  if (mesh.polygons) file.write("# polygons\n");
}

void write_obj(AtomicFile& file, const MeshView& mesh) {
  const auto normals = mesh.dim == 2 && mesh.normals ? vertex_normals(mesh) : std::nullopt;
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    file.write("v ");
    write_row(file, mesh.position(i));
    file.write('\n');
  }
  for (std::size_t i = 0; normals && i < mesh.num_points(); ++i) {
    file.write("vn ");
    write_row(file, {normals->data() + 3 * i, 3});
    file.write('\n');
  }
  const auto labels = std::find_if(mesh.cell_data.begin(), mesh.cell_data.end(),
                                   [](const NamedArray& array) { return array.name == "stratum"; });
  const bool labelled = labels != mesh.cell_data.end() && !mesh.strata.empty();
  const auto write_group = [&](std::uint64_t stratum) {
    file.write("g stratum_");
    file.write(stratum);
    file.write('\n');
  };
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    if (labelled && (c == 0 || labels->values[c] != labels->values[c - 1]))
      write_group(static_cast<std::uint64_t>(labels->values[c]));
    file.write(mesh.dim == 1 ? 'l' : 'f');
    for (const std::uint32_t v : mesh.cell(c)) {
      file.write(' ');
      file.write(std::uint64_t{v} + 1);
      if (normals) {
        file.write("//");
        file.write(std::uint64_t{v} + 1);
      }
    }
    file.write('\n');
  }
  for (const MeshStratum& stratum : mesh.strata) {
    write_group(static_cast<std::uint64_t>(stratum.stratum));
    for (std::size_t i = 0; i < stratum.simplices.size(); ++i) {
      const bool first = i % (static_cast<std::size_t>(stratum.dim) + 1) == 0;
      if (first) file.write(stratum.dim == 0 ? "p" : "l");
      file.write(' ');
      file.write(std::uint64_t{stratum.simplices[i]} + 1);
      if ((i + 1) % (static_cast<std::size_t>(stratum.dim) + 1) == 0) file.write('\n');
    }
  }
}

void write_medit(AtomicFile& file, const MeshView& mesh) {
  constexpr const char* kKeyword[] = {"", "Edges", "Triangles", "Tetrahedra"};
  file.write("MeshVersionFormatted 2\nDimension 3\nVertices\n");
  file.write(std::uint64_t{mesh.num_points()});
  file.write('\n');
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    write_row(file, mesh.position(i));
    file.write(" 0\n");
  }
  file.write(kKeyword[mesh.dim]);
  file.write('\n');
  file.write(std::uint64_t{mesh.num_cells()});
  file.write('\n');
  for (std::size_t c = 0; c < mesh.num_cells(); ++c) {
    for (const std::uint32_t v : mesh.cell(c)) {
      file.write(std::uint64_t{v} + 1);
      file.write(' ');
    }
    file.write("0\n");
  }
  file.write("End\n");
}

}  // namespace whitney::io
