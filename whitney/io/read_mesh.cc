// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/read_mesh.h>

#include <array>
#include <cctype>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/io/formats/mesh_readers.h>
#include <whitney/io/read_file.h>

namespace whitney {

SimplicialMesh read_mesh(const std::filesystem::path& path) {
  using Reader = SimplicialMesh (*)(const std::string&, std::string_view);
  constexpr std::array<std::pair<std::string_view, Reader>, 7> kReaders = {{{".off", io::read_off},
                                                                            {".noff", io::read_off},
                                                                            {".ply", io::read_ply},
                                                                            {".obj", io::read_obj},
                                                                            {".stl", io::read_stl},
                                                                            {".mesh", io::read_medit},
                                                                            {".vtu", io::read_vtu}}};
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::string known;
  for (const auto& [name, read] : kReaders) {
    if (name == extension) return read(path.string(), read_file(path));
    known += " " + std::string(name);
  }
  throw InvalidInput(path.string() + ": the extension is not that of a mesh format that can be read; known are" +
                     known);
}

}  // namespace whitney
