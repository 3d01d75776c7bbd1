// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/read_file.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_mesh.h>

// Meshes to write and read, and a folder for their files.

namespace whitney::mesh_cases {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MeshFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("whitney_mesh_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  SimplicialMesh read_text(const std::string& name, std::string_view text) const {
    write_file(file(name), text);
    return read_mesh(file(name));
  }

  fs::path folder_;
};

template <class Error, class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A torus (or, with a twist, a Klein bottle) of rows x rows quadrangles cut into triangles, embedded in R^4, or R^3.
inline SimplicialMesh glued_square(std::uint32_t rows, int ambient_dim, bool twisted) {
  SimplicialMesh mesh;
  mesh.ambient_dim = ambient_dim;
  mesh.dim = 2;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      const double u = 2 * M_PI * i / rows, v = 2 * M_PI * j / rows;
      const double tube = 2 + std::cos(v), up = std::sin(v);
      const double half = twisted ? u / 2 : 0.0;
      mesh.points.insert(mesh.points.end(), {tube * std::cos(u), tube * std::sin(u), up * std::cos(half)});
      if (ambient_dim == 4) mesh.points.push_back(up * std::sin(half) + 1.0 / 3);
    }
  }
  const auto id = [=](std::uint32_t i, std::uint32_t j) {
    if (twisted && i == rows) j = rows - j;
    return (i % rows) * rows + j % rows;
  };
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      mesh.simplices.insert(mesh.simplices.end(), {id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.simplices.insert(mesh.simplices.end(), {id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

/// The boundary of an (n+1)-simplex with vertices in R^d.
inline SimplicialMesh sphere(int n, int d) {
  SimplicialMesh mesh;
  mesh.ambient_dim = d;
  mesh.dim = n;
  for (int i = 0; i < n + 2; ++i) {
    for (int k = 0; k < d; ++k) mesh.points.push_back(std::sin(1.0 + 3.7 * i + 1.9 * k * i + k) / 3);
  }
  for (int omitted = 0; omitted < n + 2; ++omitted) {
    for (int i = 0; i < n + 2; ++i) {
      if (i != omitted) mesh.simplices.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return mesh;
}

inline SimplicialMesh tetrahedra_of_a_prism() {
  SimplicialMesh mesh;
  mesh.ambient_dim = 3;
  mesh.dim = 3;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1. / 3};
  mesh.simplices = {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5};
  return mesh;
}

/// A hexagon and three quadrangles around it, in R^d.
inline PolygonMesh polygons(int d) {
  PolygonMesh mesh;
  mesh.ambient_dim = d;
  for (int ring = 1; ring <= 2; ++ring) {
    for (int i = 0; i < 6; ++i) {
      mesh.points.insert(mesh.points.end(), {ring * std::cos(i * M_PI / 3), ring * std::sin(i * M_PI / 3), 0.1 * ring});
      for (int k = 3; k < d; ++k) mesh.points.push_back(ring * i * k);
    }
  }
  mesh.corners = {0, 1, 2, 3, 4, 5, 0, 6, 7, 1, 2, 1, 7, 8, 2, 3, 9, 8};
  mesh.offsets = {0, 6, 10, 14, 18};
  return mesh;
}

using Cells = std::multiset<std::set<std::uint32_t>>;

inline Cells cells_of(const SimplicialMesh& mesh) {
  Cells cells;
  const auto n = static_cast<std::size_t>(mesh.dim + 1);
  for (std::size_t i = 0; i < mesh.simplices.size(); i += n) {
    cells.emplace(mesh.simplices.begin() + static_cast<std::ptrdiff_t>(i),
                  mesh.simplices.begin() + static_cast<std::ptrdiff_t>(i + n));
  }
  return cells;
}

/// How often the edges of triangles are run through in the same direction twice.
inline int disagreements(const SimplicialMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (std::size_t i = 0; i < mesh.simplices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++count[{mesh.simplices[i + k], mesh.simplices[i + (k + 1) % 3]}];
  }
  return static_cast<int>(std::count_if(count.begin(), count.end(), [](const auto& edge) { return edge.second > 1; }));
}

inline std::vector<double> coordinates(const SimplicialMesh& mesh, std::initializer_list<std::size_t> chosen) {
  std::vector<double> result;
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    for (const std::size_t k : chosen)
      result.push_back(mesh.points[i * static_cast<std::size_t>(mesh.ambient_dim) + k]);
  }
  return result;
}

}  // namespace whitney::mesh_cases
