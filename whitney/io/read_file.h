// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace whitney {

/// All bytes of a file. Throws FileError naming the file and the system's reason.
std::string read_file(const std::filesystem::path& path);

}  // namespace whitney
