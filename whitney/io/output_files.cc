// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/output_files.h>

#include <algorithm>
#include <cctype>
#include <exception>
#include <filesystem>
#include <system_error>
#include <unistd.h>

#include <coxeter/base/error.h>
#include <whitney/cells/subdivide.h>

namespace whitney {
namespace fs = std::filesystem;

namespace {

fs::path folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

/// Whether two names are of one file, there or not yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::exists(a, error) && fs::exists(b, error)) {
    if (!fs::is_regular_file(a, error) && !fs::is_directory(a, error)) return false;  // /dev/null takes everything
    return fs::equivalent(a, b, error);
  }
  return fs::weakly_canonical(fs::absolute(a), error) == fs::weakly_canonical(fs::absolute(b), error);
}

void check_folder(const std::string& file) {
  std::error_code error;
  const fs::path folder = folder_of(file);
  if (!fs::is_directory(folder, error)) throw FileError(file + ": there is no folder " + folder.string());
  if (fs::is_directory(file, error)) throw FileError(file + ": there is a folder of this name");
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    if (access(file.c_str(), W_OK) != 0) throw FileError(file + ": no permission to write to it");
    return;  // a device or a pipe
  }
  if (access(folder.c_str(), W_OK) != 0) throw FileError(file + ": no permission to write into " + folder.string());
  const fs::space_info space = fs::space(folder, error);
  if (!error && space.available == 0) throw FileError(file + ": the disk is full");
}

/// Whether `file` is "name_<number>.vtu" of the pattern "name.vtu".
bool matches(const std::string& file, const std::string& pattern) {
  const fs::path path(file), like(pattern);
  if (path.extension() != like.extension()) return false;
  const std::string stem = path.stem().string(), begin = like.stem().string() + "_";
  if (!stem.starts_with(begin) || stem.size() == begin.size()) return false;
  if (!std::all_of(stem.begin() + static_cast<std::ptrdiff_t>(begin.size()), stem.end(),
                   [](unsigned char c) { return std::isdigit(c) != 0; }))
    return false;
  return same_file(folder_of(file).string(), folder_of(pattern).string());
}

}  // namespace

void check_output_files(const std::string& input, const std::vector<std::string>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string& file = outputs[i];
    if (file.empty()) continue;
    check_folder(file);
    if (!input.empty() && same_file(file, input))
      throw InvalidInput(file + ": this is the input, which would be overwritten");
    for (std::size_t j = 0; j < i; ++j)
      if (!outputs[j].empty() && same_file(file, outputs[j]))
        throw InvalidInput(file + ": two outputs would go into this file" +
                           (outputs[j] == file ? "" : " (" + outputs[j] + " is the same)"));
  }
}

void check_strata_pattern(const std::string& input, const std::vector<std::string>& outputs, const std::string& pattern,
                          int intrinsic_dim) {
  check_folder(pattern);
  if (matches(input, pattern)) throw InvalidInput(input + ": this is the input, which strata could overwrite");
  for (const std::string& file : outputs)
    if (!file.empty() && matches(file, pattern))
      throw InvalidInput(file + ": a stratum could go into this file, too (--strata " + pattern + ")");
  for (int dim = 0; dim < intrinsic_dim; ++dim) {
    try {
      return check_mesh_format(pattern, dim);
    } catch (const InvalidInput&) {
    }
  }
  check_mesh_format(pattern, intrinsic_dim);
}

std::vector<std::string> write_meshes(const std::vector<std::string>& outputs, const SimplicialMesh& mesh,
                                      const PolygonMesh* polygons, const MeshWriteOptions& options) {
  std::vector<std::string> failed;
  for (const std::string& file : outputs) {
    try {
      if (polygons != nullptr)
        write_mesh(file, *polygons, options);
      else
        write_mesh(file, mesh, options);
    } catch (const std::exception& error) {
      const std::string what = error.what();
      failed.push_back(what.find(file) != std::string::npos ? what : file + ": " + what);
    }
  }
  return failed;
}

WrittenStrata write_strata(const std::string& pattern, const SimplicialMesh& mesh, std::size_t num_strata,
                           const MeshWriteOptions& options) {
  const fs::path path(pattern);
  WrittenStrata out;
  for (std::size_t s = 0; s < num_strata; ++s) {
    const SimplicialMesh piece = stratum_mesh(mesh, static_cast<int>(s));
    const std::string name =
        (path.parent_path() / (path.stem().string() + "_" + std::to_string(s) + path.extension().string())).string();
    try {
      check_mesh_format(name, piece.dim);
    } catch (const InvalidInput&) {
      continue;
    }
    try {
      write_mesh(name, piece, options);
      out.files.push_back(name);
    } catch (const std::exception& error) {
      out.failed.emplace_back(error.what());
    }
  }
  return out;
}

}  // namespace whitney
