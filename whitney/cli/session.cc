// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/session.h>

#include <csignal>
#include <filesystem>
#include <unistd.h>

#include <coxeter/base/error.h>

namespace whitney::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_seen = 0;
  std::signal(SIGINT, [](int) { interrupt_seen = 1; });
}

InterruptGuard::~InterruptGuard() { std::signal(SIGINT, SIG_DFL); }

bool InterruptGuard::interrupted() const { return interrupt_seen != 0; }

void check_outputs(const std::vector<std::string>& outputs, const std::string& stats, int intrinsic_dim,
                   bool polygons) {
  std::vector<std::string> files = outputs;
  if (!stats.empty()) files.push_back(stats);
  for (const std::string& file : files) {
    std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (folder.empty()) folder = ".";
    if (!std::filesystem::is_directory(folder)) throw FileError(file + ": there is no folder " + folder.string());
    if (access(folder.c_str(), W_OK) != 0) throw FileError(file + ": no permission to write into " + folder.string());
  }
  for (const std::string& file : outputs) check_mesh_format(file, intrinsic_dim, polygons);
}

std::string write_outputs(const std::vector<std::string>& outputs, const SimplicialMesh& mesh,
                          const PolygonMesh* polygons, const MeshWriteOptions& options) {
  std::string failed;
  for (const std::string& file : outputs) {
    try {
      if (polygons != nullptr)
        write_mesh(file, *polygons, options);
      else
        write_mesh(file, mesh, options);
    } catch (const std::exception& error) {
      failed += (failed.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  return failed;
}

std::optional<Box> to_box(const std::vector<std::array<double, 2>>& sides) {
  if (sides.empty()) return std::nullopt;
  Box box;
  for (const auto& [lower, upper] : sides) {
    box.lower.push_back(lower);
    box.upper.push_back(upper);
  }
  return box;
}

std::optional<Box> box_of(const Problem& problem) { return to_box(problem.box); }

}  // namespace whitney::cli
