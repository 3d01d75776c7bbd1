// SPDX-License-Identifier: GPL-3.0-or-later
// The formats that are binary or text: PLY, STL.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <unordered_map>

#include <whitney/io/formats/mesh_readers.h>
#include <whitney/io/formats/text_reader.h>

namespace whitney::io {

namespace {

template <class T>
T load(const char* bytes, bool swap) {
  std::array<char, sizeof(T)> copy;
  std::memcpy(copy.data(), bytes, sizeof(T));
  if (swap) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<T>(copy);
}

enum class Scalar : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

std::optional<Scalar> scalar_named(std::string_view name) {
  constexpr std::array<std::array<std::string_view, 2>, 8> kNames = {{{"char", "int8"},
                                                                      {"uchar", "uint8"},
                                                                      {"short", "int16"},
                                                                      {"ushort", "uint16"},
                                                                      {"int", "int32"},
                                                                      {"uint", "uint32"},
                                                                      {"float", "float32"},
                                                                      {"double", "float64"}}};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (name == kNames[i][0] || name == kNames[i][1]) return static_cast<Scalar>(i);
  }
  return std::nullopt;
}

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

struct Property {
  std::string name;
  Scalar type{};
  std::optional<Scalar> list_size_type{};
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties{};
};

enum class Coding : std::uint8_t { kText, kLittleEndian, kBigEndian };

struct PlyHeader {
  Coding coding = Coding::kText;
  std::vector<Element> elements;
};

PlyHeader read_ply_header(TextReader& text) {
  PlyHeader header;
  const auto scalar = [&text]() {
    const std::string_view name = text.word();
    const auto type = scalar_named(name);
    if (!type) text.fail("unknown type of a property: \"" + std::string(name) + "\"");
    return *type;
  };
  if (!text.next_line() || text.word() != "ply") text.fail("the file does not begin with ply");
  bool has_format = false;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "end_header") {
      if (!has_format) text.fail("the header has no format");
      return header;
    }
    if (keyword == "format") {
      const std::string_view format = text.word();
      has_format = true;
      if (format == "ascii") {
        header.coding = Coding::kText;
      } else if (format == "binary_little_endian") {
        header.coding = Coding::kLittleEndian;
      } else if (format == "binary_big_endian") {
        header.coding = Coding::kBigEndian;
      } else {
        text.fail("unknown format \"" + std::string(format) + "\"");
      }
    } else if (keyword == "element") {
      const std::string name(text.word());
      header.elements.push_back({name, text.count(text.word())});
    } else if (keyword == "property") {
      if (header.elements.empty()) text.fail("a property before any element");
      Property property;
      std::string_view type = text.word();
      if (type == "list") {
        property.list_size_type = scalar();
        if (*property.list_size_type >= Scalar::kFloat) text.fail("the length of a list must be an integer");
        property.type = scalar();
      } else {
        const auto known = scalar_named(type);
        if (!known) text.fail("unknown type of a property: \"" + std::string(type) + "\"");
        property.type = *known;
      }
      property.name = text.word();
      header.elements.back().properties.push_back(property);
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail("unknown keyword \"" + std::string(keyword) + "\" in the header");
    }
  }
  text.fail("the file ends inside the header");
}

/// The numbers after the header, one after the other, in any coding.
class PlyBody {
 public:
  PlyBody(std::string path, Coding coding, TextReader text)
      : path_(std::move(path)), coding_(coding), text_(std::move(text)), bytes_(text_.rest()) {}

  void start_row(const Element& element, std::uint64_t row) {
    element_ = &element;
    row_ = row;
  }

  double scalar(Scalar type) {
    if (coding_ == Coding::kText) return text_.number(text_.word_anywhere("the value of a property"));
    const std::size_t size = size_of(type);
    if (bytes_.size() < size) fail("the file is cut short");
    const char* p = bytes_.data();
    bytes_.remove_prefix(size);
    const bool swap = (coding_ == Coding::kBigEndian) != (std::endian::native == std::endian::big);
    switch (type) {
      case Scalar::kInt8:
        return load<std::int8_t>(p, swap);
      case Scalar::kUint8:
        return load<std::uint8_t>(p, swap);
      case Scalar::kInt16:
        return load<std::int16_t>(p, swap);
      case Scalar::kUint16:
        return load<std::uint16_t>(p, swap);
      case Scalar::kInt32:
        return load<std::int32_t>(p, swap);
      case Scalar::kUint32:
        return load<std::uint32_t>(p, swap);
      case Scalar::kFloat:
        return load<float>(p, swap);
      case Scalar::kDouble:
        return load<double>(p, swap);
    }
    return 0;
  }

  /// An index or a length. Doubles hold every integer of the types of PLY.
  std::uint64_t index(Scalar type) {
    const double value = scalar(type);
    if (!(value >= 0 && value < 4294967296.0) || value != std::floor(value))
      fail("an index or a length is not a number >= 0");
    return static_cast<std::uint64_t>(value);
  }

  [[noreturn]] void fail(const std::string& reason) const {
    if (coding_ == Coding::kText) text_.fail(reason);
    fail_reading(path_, element_->name + " " + std::to_string(row_) + ": " + reason);
  }

 private:
  std::string path_;
  Coding coding_;
  TextReader text_;
  std::string_view bytes_;
  const Element* element_ = nullptr;
  std::uint64_t row_ = 0;
};

std::optional<std::size_t> find_property(const Element& element, std::string_view name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name && !element.properties[i].list_size_type) return i;
  }
  return std::nullopt;
}

/// Which properties of a vertex are its coordinates: x1 .. xd with d > 3, as we write them, or else x, y and z.
std::vector<std::size_t> coordinate_properties(const Element& vertex, const std::string& path) {
  std::vector<std::size_t> result;
  while (const auto p = find_property(vertex, "x" + std::to_string(result.size() + 1))) result.push_back(*p);
  if (result.size() > 3) return result;
  result.clear();
  for (const char* name : {"x", "y", "z"}) {
    const auto p = find_property(vertex, name);
    if (!p) fail_reading(path, std::string("the vertices have no property ") + name);
    result.push_back(*p);
  }
  return result;
}

/// Points by their coordinates.
class PointSet {
 public:
  explicit PointSet(MeshBuilder& builder) : builder_(builder) {}

  std::uint64_t find_or_add(std::array<double, 3> p, const auto& check) {
    for (double& x : p) x += 0.0;  // -0 is 0
    const auto [found, is_new] = index_.try_emplace(p, builder_.num_points());
    if (is_new) {
      for (const double x : p) check(builder_.add_coordinate(x));
    }
    return found->second;
  }

 private:
  struct Hash {
    std::size_t operator()(const std::array<double, 3>& p) const {
      std::uint64_t h = 0;
      for (const double x : p) {
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15U;
        h ^= h >> 29;
      }
      return h;
    }
  };

  MeshBuilder& builder_;
  std::unordered_map<std::array<double, 3>, std::uint64_t, Hash> index_;
};

SimplicialMesh read_binary_stl(const std::string& path, std::string_view bytes, std::size_t num_facets) {
  constexpr std::size_t kHeader = 84, kFacet = 50, kNormal = 12;
  MeshBuilder builder(3);
  PointSet points(builder);
  for (std::size_t i = 0; i < num_facets; ++i) {
    const auto check = [&](const std::string& reason) {
      if (!reason.empty()) fail_reading(path, "facet " + std::to_string(i) + ": " + reason);
    };
    const auto check_coordinate = [&](const char* reason) { check(reason == nullptr ? "" : reason); };
    std::array<std::uint64_t, 3> cell{};
    for (std::size_t v = 0; v < 3; ++v) {
      std::array<double, 3> p{};
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = load<float>(bytes.data() + kHeader + i * kFacet + kNormal + 12 * v + 4 * k,
                           std::endian::native == std::endian::big);
      }
      cell[v] = points.find_or_add(p, check_coordinate);
    }
    check(builder.add_cell(cell));
  }
  return builder.finish(path, false);
}

}  // namespace

SimplicialMesh read_ply(const std::string& path, std::string_view bytes) {
  constexpr char kNoComment = '\n';
  TextReader text(path, bytes, 1, kNoComment);
  const PlyHeader header = read_ply_header(text);
  PlyBody body(path, header.coding, text);
  std::optional<MeshBuilder> builder;
  std::vector<double> row;
  std::vector<std::uint64_t> cell;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;  // nothing in the file, whatever its number
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face", is_edge = element.name == "edge";
    std::vector<std::size_t> coordinates;
    if (is_vertex) {
      if (builder) text.fail("the element vertex comes twice");
      coordinates = coordinate_properties(element, path);
      builder.emplace(static_cast<int>(coordinates.size()));
    }
    if ((is_face || is_edge) && !builder) text.fail("the element vertex must come before faces and edges");
    const auto vertex1 = find_property(element, "vertex1"), vertex2 = find_property(element, "vertex2");
    if (is_edge && !(vertex1 && vertex2)) text.fail("the edges have no properties vertex1 and vertex2");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      body.start_row(element, i);
      row.assign(element.properties.size(), 0.0);
      bool has_cell = false;
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        if (!property.list_size_type) {
          row[k] = body.scalar(property.type);
          continue;
        }
        const std::uint64_t length = body.index(*property.list_size_type);
        const bool is_cell = is_face && (property.name == "vertex_indices" || property.name == "vertex_index");
        if (is_cell) cell.clear();
        for (std::uint64_t j = 0; j < length; ++j) {
          if (is_cell) {
            cell.push_back(body.index(property.type));
          } else {
            body.scalar(property.type);
          }
        }
        has_cell |= is_cell;
      }
      if (is_vertex) {
        for (const std::size_t k : coordinates) {
          if (const char* reason = builder->add_coordinate(row[k])) body.fail(reason);
        }
      } else if (is_face) {
        if (!has_cell) body.fail("the faces have no property vertex_indices");
        if (const std::string reason = builder->add_cell(cell); !reason.empty()) body.fail(reason);
      } else if (is_edge) {
        const double ends[] = {row[*vertex1], row[*vertex2]};
        cell.clear();
        for (const double end : ends) {
          if (!(end >= 0 && end < 4294967296.0)) body.fail("an edge has an end that is not a number >= 0");
          cell.push_back(static_cast<std::uint64_t>(end));
        }
        if (const std::string reason = builder->add_cell(cell); !reason.empty()) body.fail(reason);
      }
    }
  }
  if (!builder) fail_reading(path, "the file has no vertices");
  return builder->finish(path, false);
}

SimplicialMesh read_stl(const std::string& path, std::string_view bytes) {
  // Text begins with "solid", but so do some binary files: their length decides.
  if (bytes.size() >= 84) {
    const std::size_t num_facets = load<std::uint32_t>(bytes.data() + 80, std::endian::native == std::endian::big);
    if (bytes.size() == 84 + 50 * num_facets) return read_binary_stl(path, bytes, num_facets);
  }
  if (bytes.substr(0, 5) != "solid")
    fail_reading(path, "neither text STL, nor binary STL of the length that its header says");
  TextReader text(path, bytes);
  MeshBuilder builder(3);
  PointSet points(builder);
  std::vector<std::uint64_t> cell;
  bool inside = false;
  while (text.next_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "outer") {
      if (inside) text.fail("outer loop inside a loop");
      inside = true;
      cell.clear();
    } else if (keyword == "vertex") {
      if (!inside) text.fail("vertex outside a loop");
      std::array<double, 3> p{};
      for (double& x : p) x = text.number(text.word());
      cell.push_back(points.find_or_add(p, [&](const char* reason) { text.check(reason); }));
    } else if (keyword == "endloop") {
      if (!inside || cell.size() != 3) text.fail("a facet must have three vertices");
      inside = false;
      text.check(builder.add_cell(cell));
    } else if (keyword != "solid" && keyword != "facet" && keyword != "endfacet" && keyword != "endsolid") {
      text.fail("unknown keyword \"" + std::string(keyword.substr(0, 40)) + "\"");
    }
  }
  if (inside) text.fail("the file ends inside a facet");
  return builder.finish(path, false);
}

}  // namespace whitney::io
