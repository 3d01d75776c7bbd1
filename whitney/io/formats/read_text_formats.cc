// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are lists of numbers in text: OFF, nOFF, OBJ, medit.
#include <algorithm>
#include <array>
#include <limits>

#include <whitney/io/formats/mesh_readers.h>
#include <whitney/io/formats/text_reader.h>

namespace whitney::io {

namespace {

/// A list of points as long as the header says, each a number of words that may be followed by others on its line.
void read_points(TextReader& text, MeshBuilder& builder, std::uint64_t count, std::uint64_t dim) {
  for (std::uint64_t i = 0; i < count; ++i) {
    for (std::uint64_t k = 0; k < dim; ++k) {
      text.check(builder.add_coordinate(text.number(text.word_anywhere("a coordinate"))));
    }
    while (!text.word().empty()) {
    }
  }
}

}  // namespace

SimplicialMesh read_off(const std::string& path, std::string_view bytes) {
  TextReader text(path, bytes);
  const std::string_view magic = text.word_anywhere("the header OFF");
  std::string_view prefix = magic;
  const auto ends = [&prefix](std::string_view s) {
    return prefix.size() >= s.size() && prefix.substr(0, s.size()) == s;
  };
  for (const std::string_view part : {"ST", "C", "N"}) {
    if (ends(part)) prefix.remove_prefix(part.size());
  }
  if (prefix != "OFF" && prefix != "nOFF") text.fail("the header is not OFF, nOFF, or one of these after ST, C, N");
  std::uint64_t dim = 3;
  std::string_view word = text.word_anywhere("the number of vertices");
  if (word == "BINARY") text.fail("binary OFF is not read; convert it to text");
  if (prefix == "nOFF") {
    dim = text.count(word);
    if (dim < 1 || dim > 1000000) text.fail("the dimension of the space must be from 1 to 1000000");
    word = text.word_anywhere("the number of vertices");
  }
  const std::uint64_t num_points = text.count(word);
  const std::uint64_t num_cells = text.count(text.word_anywhere("the number of cells"));
  while (!text.word().empty()) {  // the number of edges, often absent
  }
  MeshBuilder builder(static_cast<int>(dim));
  read_points(text, builder, num_points, dim);
  std::vector<std::uint64_t> cell;
  for (std::uint64_t i = 0; i < num_cells; ++i) {
    const std::uint64_t size = text.count(text.word_anywhere("a cell"));
    cell.clear();
    for (std::uint64_t k = 0; k < size; ++k) cell.push_back(text.count(text.word_anywhere("a point of a cell")));
    text.check(builder.add_cell(cell));
    while (!text.word().empty()) {  // a colour
    }
  }
  return builder.finish(path, prefix == "nOFF" && bytes.find("\n# polygons") == std::string_view::npos);
}

SimplicialMesh read_obj(const std::string& path, std::string_view bytes) {
  TextReader text(path, bytes);
  MeshBuilder builder(3);
  std::vector<std::uint64_t> cell;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      for (int k = 0; k < 3; ++k) text.check(builder.add_coordinate(text.number(text.word())));
    } else if (keyword == "f" || keyword == "l") {
      cell.clear();
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        const std::int64_t index = text.integer(word.substr(0, word.find('/')));
        const auto known = static_cast<std::int64_t>(builder.num_points());
        const std::int64_t point = index < 0 ? known + index : index - 1;
        if (index == 0 || point < 0 || point >= known) {
          text.fail("vertex " + std::to_string(index) + " is not one of the " + std::to_string(known) +
                    " before this line");
        }
        cell.push_back(static_cast<std::uint64_t>(point));
      }
      if (cell.size() < (keyword == "f" ? 3U : 2U)) text.fail("too few vertices");
      if (keyword == "f") {
        text.check(builder.add_cell(cell));
      } else {
        for (std::size_t i = 0; i + 1 < cell.size(); ++i) text.check(builder.add_cell({cell.data() + i, 2}));
      }
    }
  }
  return builder.finish(path, false);
}

SimplicialMesh read_medit(const std::string& path, std::string_view bytes) {
  struct Kind {
    std::string_view keyword;
    std::size_t corners;
    int dim;
  };
  constexpr std::array<Kind, 4> kKinds = {
      {{"Edges", 2, 1}, {"Triangles", 3, 2}, {"Quadrilaterals", 4, 2}, {"Tetrahedra", 4, 3}}};
  constexpr const char* kEnd = "the keyword End";

  TextReader text(path, bytes);
  std::uint64_t dim = 0;
  std::vector<double> points;
  // Cells by dimension: corners and sizes, with the line of each section's cells checked as they are read.
  struct Cells {
    std::vector<std::uint64_t> corners;
    std::vector<std::size_t> sizes;
    std::size_t line = 0;
  };
  std::array<Cells, 4> found;
  std::uint64_t num_points = 0;
  std::string_view word = text.word_anywhere("MeshVersionFormatted");
  if (word != "MeshVersionFormatted") text.fail("the file does not begin with MeshVersionFormatted");
  text.count(text.word_anywhere("the version"));
  while (word = text.word_anywhere(kEnd), word != "End") {
    if (word == "Dimension") {
      dim = text.count(text.word_anywhere("the dimension"));
      if (dim != 2 && dim != 3) text.fail("the dimension must be 2 or 3");
    } else if (word == "Vertices") {
      if (dim == 0 || num_points > 0) text.fail("Vertices must come once, after Dimension");
      num_points = text.count(text.word_anywhere("the number of vertices"));
      for (std::uint64_t i = 0; i < num_points; ++i) {
        for (std::uint64_t k = 0; k < dim; ++k) points.push_back(text.number(text.word_anywhere("a coordinate")));
        text.number(text.word_anywhere("the reference of a vertex"));
      }
    } else if (const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&](auto& k) { return k.keyword == word; });
               kind != kKinds.end()) {
      Cells& cells = found[static_cast<std::size_t>(kind->dim)];
      const std::uint64_t count = text.count(text.word_anywhere("the number of cells"));
      for (std::uint64_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < kind->corners; ++k) {
          const std::uint64_t index = text.count(text.word_anywhere("a vertex of a cell"));
          if (index < 1 || index > num_points) {
            text.fail("vertex " + std::to_string(index) + " is not one of the " + std::to_string(num_points) +
                      " before this line");
          }
          cells.corners.push_back(index - 1);
        }
        text.number(text.word_anywhere("the reference of a cell"));
        cells.sizes.push_back(kind->corners);
      }
      cells.line = text.line_number();
    } else if (word == "Hexahedra" || word == "Prisms" || word == "Pyramids") {
      text.fail(std::string(word) + " are not simplices");
    }
    // Anything else is a keyword that is of no use here, or the numbers after one.
  }
  if (dim == 0) text.fail("the file has no Dimension");
  MeshBuilder builder(static_cast<int>(dim));
  for (const double x : points) text.check(builder.add_coordinate(x));
  for (std::size_t n = found.size(); n-- > 1;) {
    if (found[n].sizes.empty()) continue;
    std::size_t first = 0;
    for (const std::size_t size : found[n].sizes) {
      const std::string reason = builder.add_cell({found[n].corners.data() + first, size});
      if (!reason.empty()) fail_reading(path, found[n].line, "in the cells that end here: " + reason);
      first += size;
    }
    return builder.finish(path, n == 3);
  }
  text.fail("the file has no cells");
}

}  // namespace whitney::io
