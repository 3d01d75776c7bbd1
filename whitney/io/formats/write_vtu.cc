// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

#include <whitney/io/formats/base64.h>
#include <whitney/io/formats/mesh_writers.h>

static_assert(std::endian::native == std::endian::little, "binary files are written in the byte order of the machine");

namespace whitney::io {

namespace {

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 32 ? '_' : c;
    }
  }
  return result;
}

/// One array: its tag, and its bytes produced in pieces so that a big mesh is not held twice.
struct Block {
  std::string tag;  ///< <DataArray ... with the offset still missing
  std::uint64_t bytes = 0;
  std::function<void(std::function<void(std::string_view)>)> produce;
};

Block make_block(const std::string& type, const std::string& name, int components, std::uint64_t bytes,
                 std::function<void(std::function<void(std::string_view)>)> produce) {
  return {"<DataArray type=\"" + type + "\" Name=\"" + xml_escaped(name) + "\" NumberOfComponents=\"" +
              std::to_string(components) + "\" format=\"appended\" offset=\"",
          bytes, std::move(produce)};
}

Block array_block(const std::string& name, int components, std::span<const double> values) {
  return make_block("Float64", name, components, values.size_bytes(), [values](const auto& sink) {
    sink({reinterpret_cast<const char*>(values.data()), values.size_bytes()});
  });
}

template <class T, class Value>
Block generated_block(const std::string& type, const std::string& name, std::uint64_t count, Value value) {
  return make_block(type, name, 1, count * sizeof(T), [count, value](const auto& sink) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const T v = value(i);
      sink({reinterpret_cast<const char*>(&v), sizeof(T)});
    }
  });
}

std::uint64_t encoded_size(std::uint64_t bytes) { return (bytes + 8 + 2) / 3 * 4; }

/// The block as ParaView wants it: its length and its bytes, together in base64.
void write_encoded(AtomicFile& file, const Block& block) {
  constexpr std::size_t kPiece = 3 << 14;  // a multiple of 3: pieces join without padding
  const std::uint64_t length = block.bytes;
  std::string pending(reinterpret_cast<const char*>(&length), sizeof(length));
  block.produce([&](std::string_view bytes) {
    while (!bytes.empty()) {
      const std::string_view part = bytes.substr(0, kPiece - pending.size());
      pending.append(part);
      bytes.remove_prefix(part.size());
      if (pending.size() == kPiece) {
        file.write(base64_encode(pending));
        pending.clear();
      }
    }
  });
  file.write(base64_encode(pending));
}

}  // namespace

void write_vtu(AtomicFile& file, const MeshView& mesh) {
  constexpr std::uint8_t kCellType[] = {1, 3, 5, 10};  // vertex, line, triangle, tetrahedron
  constexpr std::uint8_t kPolygon = 7;

  // Strata follow the cells, as cells of lower dimension.
  const std::uint64_t num_corners = mesh.corners.size(), num_cells = mesh.num_cells();
  std::vector<std::uint32_t> corners;
  std::vector<std::uint64_t> ends;
  std::vector<std::uint8_t> types;
  std::vector<double> strata;
  for (const MeshStratum& stratum : mesh.strata) {
    const std::size_t size = static_cast<std::size_t>(stratum.dim) + 1;
    for (std::size_t i = 0; i < stratum.simplices.size(); i += size) {
      ends.push_back(num_corners + corners.size() + i + size);
      types.push_back(kCellType[stratum.dim]);
      strata.push_back(stratum.stratum);
    }
    corners.insert(corners.end(), stratum.simplices.begin(), stratum.simplices.end());
  }

  std::uint64_t offset = 0;
  std::vector<Block> blocks;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(mesh.num_points()) + "\" NumberOfCells=\"" + std::to_string(num_cells + types.size()) + "\">\n";
  const auto add = [&](Block block) {
    xml += block.tag + std::to_string(offset) + "\"/>\n";
    offset += encoded_size(block.bytes);
    blocks.push_back(std::move(block));
  };
  const auto add_arrays = [&](std::span<const NamedArray> arrays) {
    for (const NamedArray& array : arrays) add(array_block(array.name, array.components, array.values));
  };

  xml += "<Points>\n";
  add(array_block("Points", 3, mesh.xyz));
  xml += "</Points>\n<Cells>\n";
  add(generated_block<std::int64_t>("Int64", "connectivity", num_corners + corners.size(), [&](std::uint64_t i) {
    return i < num_corners ? mesh.corners[i] : corners[i - num_corners];
  }));
  add(generated_block<std::int64_t>("Int64", "offsets", num_cells + types.size(), [&](std::uint64_t i) {
    if (i >= num_cells) return ends[i - num_cells];
    return mesh.offsets.empty() ? (i + 1) * static_cast<std::uint64_t>(mesh.dim + 1) : mesh.offsets[i + 1];
  }));
  add(generated_block<std::uint8_t>("UInt8", "types", num_cells + types.size(), [&](std::uint64_t i) {
    if (i >= num_cells) return types[i - num_cells];
    return mesh.polygons ? kPolygon : kCellType[mesh.dim];
  }));
  xml += "</Cells>\n<PointData>\n";
  add(array_block("coordinates", mesh.ambient_dim, mesh.points));
  add_arrays(mesh.point_data);
  xml += "</PointData>\n<CellData>\n";
  std::vector<NamedArray> cell_data;
  if (types.empty()) {
    add_arrays(mesh.cell_data);
  } else {
    cell_data.assign(mesh.cell_data.begin(), mesh.cell_data.end());
    for (NamedArray& array : cell_data) {
      if (array.name == "stratum" && array.components == 1)
        array.values.insert(array.values.end(), strata.begin(), strata.end());
      else
        array.values.resize((num_cells + types.size()) * static_cast<std::size_t>(array.components),
                            std::numeric_limits<double>::quiet_NaN());
    }
    add_arrays(cell_data);
  }
  xml += "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"base64\">\n_";

  file.write(xml);
  for (const Block& block : blocks) write_encoded(file, block);
  file.write("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace whitney::io
