// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/formats/mesh_builder.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney::io {

namespace {

constexpr std::size_t kMaxPoints = std::numeric_limits<std::uint32_t>::max();

}  // namespace

void fail_reading(const std::string& path, const std::string& reason) { throw FileError(path + ": " + reason); }

void fail_reading(const std::string& path, std::size_t line, const std::string& reason) {
  throw FileError(path + ":" + std::to_string(line) + ": " + reason);
}

const char* MeshBuilder::add_coordinate(double value) {
  if (!std::isfinite(value)) return "a coordinate is not finite";
  if (mesh_.points.size() / static_cast<std::size_t>(mesh_.ambient_dim) >= kMaxPoints) return "too many points";
  mesh_.points.push_back(value);
  return nullptr;
}

std::string MeshBuilder::add_cell(std::span<const std::uint64_t> points) {
  if (points.empty()) return "a cell has no points";
  for (const std::uint64_t p : points) {
    if (p >= num_points()) {
      return "a cell names point " + std::to_string(p) + " (counted from 0), there are " + std::to_string(num_points());
    }
  }
  sorted_.assign(points.begin(), points.end());
  std::sort(sorted_.begin(), sorted_.end());
  const auto twice = std::adjacent_find(sorted_.begin(), sorted_.end());
  if (twice != sorted_.end()) return "a cell names point " + std::to_string(*twice) + " (counted from 0) twice";
  for (const std::uint64_t p : points) corners_.push_back(static_cast<std::uint32_t>(p));
  offsets_.push_back(corners_.size());
  return {};
}

// Takes out cells of a lower dimension than the others: strata that a mesh is labelled with. They must be faces of
// cells.
void MeshBuilder::drop_lower_cells(const std::string& path, bool simplices) {
  std::size_t most = 0;
  for (std::size_t c = 0; c < num_cells(); ++c) most = std::max(most, offsets_[c + 1] - offsets_[c]);
  const std::size_t least = simplices ? most : std::min<std::size_t>(most, 3);
  std::set<std::vector<std::uint32_t>> lower;
  std::vector<std::size_t> offsets{0};
  std::vector<std::uint32_t> corners, face;
  for (std::size_t c = 0; c < num_cells(); ++c) {
    const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(offsets_[c]),
               end = corners_.begin() + static_cast<std::ptrdiff_t>(offsets_[c + 1]);
    if (offsets_[c + 1] - offsets_[c] >= least) {
      corners.insert(corners.end(), begin, end);
      offsets.push_back(corners.size());
    } else {
      face.assign(begin, end);
      std::sort(face.begin(), face.end());
      lower.insert(face);
    }
  }
  if (lower.empty()) return;
  corners_ = std::move(corners);
  offsets_ = std::move(offsets);
  for (std::size_t c = 0; c < num_cells() && !lower.empty(); ++c) {
    const std::span cell(corners_.data() + offsets_[c], corners_.data() + offsets_[c + 1]);
    const std::size_t size = cell.size();
    auto cross_out = [&] {
      std::sort(face.begin(), face.end());
      lower.erase(face);
    };
    for (std::size_t i = 0; i < size; ++i) {
      face = {cell[i]};
      cross_out();
      // Sides of a polygon, or the faces of a simplex of at most four corners.
      for (std::size_t j = i + 1; j < size; ++j) {
        if (!simplices && size > 3 && j != i + 1 && (i != 0 || j != size - 1)) continue;
        face = {cell[i], cell[j]};
        cross_out();
        for (std::size_t k = j + 1; simplices && k < size; ++k) {
          face = {cell[i], cell[j], cell[k]};
          cross_out();
        }
      }
    }
  }
  if (!lower.empty()) fail_reading(path, "the file mixes cells of several dimensions");
}

SimplicialMesh MeshBuilder::finish(const std::string& path, bool simplices) {
  if (num_cells() == 0) fail_reading(path, "the file has no cells");
  drop_lower_cells(path, simplices);
  std::size_t least = corners_.size(), most = 0;
  for (std::size_t c = 0; c < num_cells(); ++c) {
    least = std::min(least, offsets_[c + 1] - offsets_[c]);
    most = std::max(most, offsets_[c + 1] - offsets_[c]);
  }
  if (least == most && (simplices || most <= 3)) {
    mesh_.dim = static_cast<int>(most) - 1;
    mesh_.simplices = std::move(corners_);
    return std::move(mesh_);
  }
  mesh_.dim = 2;
  const auto d = static_cast<std::size_t>(mesh_.ambient_dim);
  for (std::size_t c = 0; c < num_cells(); ++c) {
    const std::span cell(corners_.data() + offsets_[c], corners_.data() + offsets_[c + 1]);
    if (cell.size() == 3) {
      mesh_.simplices.insert(mesh_.simplices.end(), cell.begin(), cell.end());
      continue;
    }
    if (mesh_.num_points() >= kMaxPoints) fail_reading(path, "too many points");
    const auto center = static_cast<std::uint32_t>(mesh_.num_points());
    for (std::size_t k = 0; k < d; ++k) {
      double mean = 0;
      for (const std::uint32_t v : cell) mean += mesh_.points[v * d + k] / static_cast<double>(cell.size());
      mesh_.points.push_back(mean);
    }
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const std::uint32_t next = cell[i + 1 == cell.size() ? 0 : i + 1];
      mesh_.simplices.insert(mesh_.simplices.end(), {center, cell[i], next});
    }
  }
  return std::move(mesh_);
}

}  // namespace whitney::io
