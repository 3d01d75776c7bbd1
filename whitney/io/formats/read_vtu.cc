// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <map>

#include <whitney/io/formats/base64.h>
#include <whitney/io/formats/mesh_builder.h>
#include <whitney/io/formats/mesh_readers.h>

namespace whitney::io {

namespace {

/// The appended arrays of the file, by section and name ("Cells/offsets"), and how to decode them.
class Vtu {
 public:
  Vtu(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    const auto appended = bytes.find("<AppendedData");
    if (appended == std::string_view::npos)
      fail(0, "not a .vtu file as this library writes it: there is no AppendedData");
    bool is_grid = false;
    std::string section;
    for (auto begin = bytes.find('<'); begin <= appended; begin = bytes.find('<', begin + 1)) {
      const auto end = bytes.find('>', begin);
      if (end == std::string_view::npos) fail(begin, "a tag does not end");
      const std::string_view tag = bytes.substr(begin + 1, end - begin - 1);
      const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n"));
      if (name == "VTKFile") {
        is_grid = attribute(tag, "type") == "UnstructuredGrid";
        if (attribute(tag, "byte_order") != "LittleEndian" || attribute(tag, "header_type") != "UInt64" ||
            !attribute(tag, "compressor").empty()) {
          fail(begin, "only little-endian files with 64-bit headers and no compression are read");
        }
      } else if (name == "Points" || name == "Cells" || name == "PointData" || name == "CellData") {
        section = name;
      } else if (name == "DataArray") {
        const std::string array_name = section == "Points" ? "" : std::string(attribute(tag, "Name"));
        arrays_.emplace(section + "/" + array_name, Array{tag, begin});
      } else if (name == "AppendedData") {
        if (attribute(tag, "encoding") != "base64") fail(begin, "only the encoding base64 is read");
        const auto start = bytes.find('_', end);
        if (start == std::string_view::npos) fail(begin, "the appended data do not begin with _");
        data_ = bytes.substr(start + 1);
        break;
      }
    }
    if (!is_grid) fail(0, "the file is not a VTKFile of type UnstructuredGrid");
  }

  bool has(const std::string& name) const { return arrays_.contains(name); }

  int components(const std::string& name) const {
    const Array& array = find(name);
    const std::string_view text = attribute(array.tag, "NumberOfComponents");
    int value = 1;
    if (!text.empty() &&
        std::from_chars(text.data(), text.data() + text.size(), value).ptr != text.data() + text.size())
      value = 0;
    if (value < 1 || value > 1000000) fail(array.position, "NumberOfComponents is out of range");
    return value;
  }

  /// The array's numbers, which must be of the given type.
  template <class T>
  std::vector<T> values(const std::string& name, std::string_view type) const {
    const Array& array = find(name);
    if (attribute(array.tag, "type") != type) fail(array.position, name + " must have the type " + std::string(type));
    if (attribute(array.tag, "format") != "appended") fail(array.position, name + " must be appended");
    const std::string_view text = attribute(array.tag, "offset");
    std::size_t offset = 0;
    if (text.empty() ||
        std::from_chars(text.data(), text.data() + text.size(), offset).ptr != text.data() + text.size() ||
        offset > data_.size()) {
      fail(array.position, name + ": the offset is missing or leads out of the file");
    }
    // The length comes first: 8 bytes, in the first 12 digits.
    const std::string_view rest = data_.substr(offset);
    const auto head = base64_decode(rest.substr(0, 12));
    std::uint64_t length = 0;
    if (!head || head->size() < sizeof(length)) fail(array.position, name + ": the data are cut short");
    std::memcpy(&length, head->data(), sizeof(length));
    if (length > rest.size() || (length + 10) / 3 * 4 > rest.size() || length % sizeof(T) != 0) {
      fail(array.position, name + ": the data are cut short, or their length is wrong");
    }
    const auto bytes = base64_decode(rest.substr(0, (length + 10) / 3 * 4));
    if (!bytes || bytes->size() != length + sizeof(length)) fail(array.position, name + ": the data are not base64");
    std::vector<T> result(length / sizeof(T));
    if (length > 0) std::memcpy(result.data(), bytes->data() + sizeof(length), length);
    return result;
  }

  [[noreturn]] void fail_at(const std::string& name, const std::string& reason) const {
    fail(find(name).position, name + ": " + reason);
  }

 private:
  struct Array {
    std::string_view tag;
    std::size_t position = 0;
  };

  static std::string_view attribute(std::string_view tag, std::string_view name) {
    const std::string key = " " + std::string(name) + "=\"";
    const auto begin = tag.find(key);
    if (begin == std::string_view::npos) return {};
    const std::string_view value = tag.substr(begin + key.size());
    return value.substr(0, value.find('"'));
  }

  const Array& find(const std::string& name) const {
    const auto found = arrays_.find(name);
    if (found == arrays_.end()) fail_reading(path_, "the file has no array " + name);
    return found->second;
  }

  [[noreturn]] void fail(std::size_t position, const std::string& reason) const {
    const auto lines = std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(position), '\n');
    fail_reading(path_, static_cast<std::size_t>(lines) + 1, reason);
  }

  std::string path_;
  std::string_view bytes_;
  std::string_view data_{};
  std::map<std::string, Array> arrays_;
};

constexpr std::string_view kPoints = "Points/";

}  // namespace

SimplicialMesh read_vtu(const std::string& path, std::string_view bytes) {
  const Vtu vtu(path, bytes);
  const std::string where = vtu.has("PointData/coordinates") ? "PointData/coordinates" : std::string(kPoints);
  const int d = vtu.components(where);
  const std::vector<double> points = vtu.values<double>(where, "Float64");
  if (points.size() % static_cast<std::size_t>(d) != 0) vtu.fail_at(where, "the number of coordinates does not fit");
  MeshBuilder builder(d);
  for (const double x : points) {
    if (const char* reason = builder.add_coordinate(x)) vtu.fail_at(where, reason);
  }
  const auto connectivity = vtu.values<std::int64_t>("Cells/connectivity", "Int64");
  const auto offsets = vtu.values<std::int64_t>("Cells/offsets", "Int64");
  const auto types = vtu.values<std::uint8_t>("Cells/types", "UInt8");
  if (types.size() != offsets.size()) vtu.fail_at("Cells/types", "there are not as many types as cells");
  const bool tetrahedra = std::find(types.begin(), types.end(), 10) != types.end();
  std::int64_t first = 0;
  std::vector<std::uint64_t> cell;
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    if (offsets[i] < first || offsets[i] > static_cast<std::int64_t>(connectivity.size())) {
      vtu.fail_at("Cells/offsets", "cell " + std::to_string(i) + " leads out of the connectivity");
    }
    cell.assign(connectivity.begin() + first, connectivity.begin() + offsets[i]);  // a negative index becomes too large
    first = offsets[i];
    const std::size_t n = cell.size();
    const bool fits = types[i] == 1   ? n == 1
                      : types[i] == 3 ? n == 2
                      : types[i] == 5 ? n == 3
                      : types[i] == 7 ? n >= 3
                      : types[i] == 9 ? n == 4
                                      : types[i] == 10 && n == 4;
    if (!fits || (tetrahedra && (types[i] == 7 || types[i] == 9))) {
      vtu.fail_at("Cells/types",
                  "cell " + std::to_string(i) +
                      " is not a simplex or polygon, has a wrong number of points, or differs in dimension");
    }
    const std::string reason = builder.add_cell(cell);
    if (!reason.empty()) vtu.fail_at("Cells/connectivity", "cell " + std::to_string(i) + ": " + reason);
  }
  return builder.finish(path, tetrahedra);
}

}  // namespace whitney::io
