// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include <whitney/topology/mesh.h>

namespace whitney::io {

// One reader per format, of a file's whole contents; `path` is for messages. All throw FileError.
SimplicialMesh read_off(const std::string& path, std::string_view bytes);
SimplicialMesh read_ply(const std::string& path, std::string_view bytes);
SimplicialMesh read_obj(const std::string& path, std::string_view bytes);
SimplicialMesh read_stl(const std::string& path, std::string_view bytes);
SimplicialMesh read_medit(const std::string& path, std::string_view bytes);
SimplicialMesh read_vtu(const std::string& path, std::string_view bytes);

}  // namespace whitney::io
