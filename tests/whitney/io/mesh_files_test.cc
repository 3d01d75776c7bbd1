// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <set>
#include <unistd.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/io/atomic_file.h>
#include <whitney/io/read_file.h>
#include <whitney/io/read_mesh.h>
#include <whitney/io/write_mesh.h>

namespace whitney {
namespace {

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
SimplicialMesh glued_square(std::uint32_t rows, int ambient_dim, bool twisted) {
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
SimplicialMesh sphere(int n, int d) {
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

SimplicialMesh tetrahedra_of_a_prism() {
  SimplicialMesh mesh;
  mesh.ambient_dim = 3;
  mesh.dim = 3;
  mesh.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1. / 3};
  mesh.simplices = {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5};
  return mesh;
}

/// A hexagon and three quadrangles around it, in R^d.
PolygonMesh polygons(int d) {
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

Cells cells_of(const SimplicialMesh& mesh) {
  Cells cells;
  const auto n = static_cast<std::size_t>(mesh.dim + 1);
  for (std::size_t i = 0; i < mesh.simplices.size(); i += n) {
    cells.emplace(mesh.simplices.begin() + static_cast<std::ptrdiff_t>(i),
                  mesh.simplices.begin() + static_cast<std::ptrdiff_t>(i + n));
  }
  return cells;
}

/// How often the edges of triangles are run through in the same direction twice.
int disagreements(const SimplicialMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (std::size_t i = 0; i < mesh.simplices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++count[{mesh.simplices[i + k], mesh.simplices[i + (k + 1) % 3]}];
  }
  return static_cast<int>(std::count_if(count.begin(), count.end(), [](const auto& edge) { return edge.second > 1; }));
}

std::vector<double> coordinates(const SimplicialMesh& mesh, std::initializer_list<std::size_t> chosen) {
  std::vector<double> result;
  for (std::size_t i = 0; i < mesh.num_points(); ++i) {
    for (const std::size_t k : chosen)
      result.push_back(mesh.points[i * static_cast<std::size_t>(mesh.ambient_dim) + k]);
  }
  return result;
}

// --- there and back

TEST_F(MeshFilesTest, EveryBitOfTheCoordinatesComesBack) {
  const SimplicialMesh torus = glued_square(9, 3, false);
  for (const char* name : {"a.off", "a.noff", "a.ply", "a.obj", "a.mesh", "a.vtu", "a.OFF"}) {
    write_mesh(file(name), torus);
    const SimplicialMesh back = read_mesh(file(name));
    EXPECT_EQ(back.ambient_dim, 3) << name;
    EXPECT_EQ(back.dim, 2) << name;
    EXPECT_EQ(back.points, torus.points) << name;
    EXPECT_EQ(back.simplices, torus.simplices) << name;
  }
}

TEST_F(MeshFilesTest, AllCoordinatesOfR4ComeBackWhereTheFormatHoldsThem) {
  const SimplicialMesh klein = glued_square(8, 4, true);
  for (const char* name : {"a.noff", "a.ply", "a.vtu"}) {
    write_mesh(file(name), klein);
    const SimplicialMesh back = read_mesh(file(name));
    EXPECT_EQ(back.ambient_dim, 4) << name;
    EXPECT_EQ(back.points, klein.points) << name;
    EXPECT_EQ(back.simplices, klein.simplices) << name;
  }
  MeshWriteOptions options;
  options.projection = "x4,1,2";
  for (const char* name : {"a.off", "a.obj", "a.mesh"}) {
    write_mesh(file(name), klein, options);
    const SimplicialMesh back = read_mesh(file(name));
    EXPECT_EQ(back.ambient_dim, 3) << name;
    EXPECT_EQ(back.points, coordinates(klein, {3, 0, 1})) << name;
    EXPECT_EQ(cells_of(back), cells_of(klein)) << name;
  }
}

TEST_F(MeshFilesTest, StlGivesTheSameSurfaceInFloat) {
  const SimplicialMesh torus = glued_square(9, 3, false);
  write_mesh(file("a.stl"), torus);
  EXPECT_EQ(fs::file_size(file("a.stl")), 84 + 50 * torus.num_simplices());
  const SimplicialMesh back = read_mesh(file("a.stl"));
  ASSERT_EQ(back.num_points(), torus.num_points());
  ASSERT_EQ(back.num_simplices(), torus.num_simplices());
  for (std::size_t i = 0; i < torus.simplices.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(back.points[3 * back.simplices[i] + k], static_cast<float>(torus.points[3 * torus.simplices[i] + k]));
    }
  }
}

TEST_F(MeshFilesTest, EveryDimension) {
  for (int n = 0; n <= 6; ++n) {
    const SimplicialMesh mesh = sphere(n, n + 3);
    for (const char* name : {"a.noff", "a.vtu", "a.mesh", "a.ply", "a.obj", "a.off", "a.stl", "a.pov"}) {
      const std::string extension = fs::path(name).extension();
      const bool fits =
          extension == ".noff" || (extension == ".vtu" && n <= 3) || (extension == ".mesh" && n >= 1 && n <= 3) ||
          ((extension == ".ply" || extension == ".obj" || extension == ".pov") && (n == 1 || n == 2)) || n == 2;
      if (!fits) {
        EXPECT_THAT(message_of<InvalidInput>([&] { write_mesh(file(name), mesh); }), HasSubstr(".noff")) << name << n;
        EXPECT_THROW(check_mesh_format(name, n), InvalidInput);
        continue;
      }
      check_mesh_format(name, n);
      write_mesh(file(name), mesh);
      if (extension == ".pov") continue;
      const SimplicialMesh back = read_mesh(file(name));
      EXPECT_EQ(back.dim, n) << name;
      if (extension != ".stl") {
        EXPECT_EQ(cells_of(back), cells_of(mesh)) << name;
      }
      if (extension == ".noff" || extension == ".vtu") {
        EXPECT_EQ(back.points, mesh.points) << name;
      }
    }
  }
  const SimplicialMesh prism = tetrahedra_of_a_prism();
  for (const char* name : {"a.noff", "a.vtu", "a.mesh"}) {
    write_mesh(file(name), prism);
    const SimplicialMesh back = read_mesh(file(name));
    EXPECT_EQ(back.points, prism.points) << name;
    EXPECT_EQ(back.simplices, prism.simplices) << name;
  }
}

TEST_F(MeshFilesTest, PlanesAndLinesGetZeros) {
  SimplicialMesh mesh;
  mesh.ambient_dim = 2;
  mesh.dim = 1;
  mesh.points = {0.1, 0.2, 0.3, 0.4};
  mesh.simplices = {0, 1};
  write_mesh(file("a.obj"), mesh);
  EXPECT_THAT(read_mesh(file("a.obj")).points, ::testing::ElementsAre(0.1, 0.2, 0, 0.3, 0.4, 0));
  write_mesh(file("a.vtu"), mesh);
  EXPECT_EQ(read_mesh(file("a.vtu")).points, mesh.points);
}

TEST_F(MeshFilesTest, PolygonsComeBackAsFansAroundANewPoint) {
  for (const char* name : {"a.off", "a.noff", "a.ply", "a.obj", "a.vtu"}) {
    const PolygonMesh mesh = polygons(3);
    write_mesh(file(name), mesh);
    const SimplicialMesh back = read_mesh(file(name));
    EXPECT_EQ(back.dim, 2) << name;
    EXPECT_EQ(back.num_points(), mesh.num_points() + 4) << name;
    EXPECT_EQ(back.num_simplices(), 18U) << name;
    EXPECT_EQ(disagreements(back), 0) << name;
    EXPECT_TRUE(std::equal(mesh.points.begin(), mesh.points.end(), back.points.begin())) << name;
    // The centre of the hexagon.
    EXPECT_NEAR(back.points[3 * mesh.num_points()], 0, 1e-15);
    EXPECT_NEAR(back.points[3 * mesh.num_points() + 2], 0.1, 1e-15);
  }
  // Quadrangles alone could be taken for tetrahedra.
  PolygonMesh squares = polygons(5);
  squares.corners.erase(squares.corners.begin(), squares.corners.begin() + 6);
  squares.offsets = {0, 4, 8, 12};
  write_mesh(file("b.noff"), squares);
  EXPECT_EQ(read_mesh(file("b.noff")).dim, 2);
  write_mesh(file("b.stl"), squares);
  EXPECT_EQ(read_mesh(file("b.stl")).num_simplices(), 6U);
  write_mesh(file("b.pov"), squares);
  EXPECT_THAT(message_of<InvalidInput>([&] { write_mesh(file("b.mesh"), squares); }), HasSubstr(".vtu"));
}

TEST_F(MeshFilesTest, NoffIsTheFormThatIsDocumented) {
  SimplicialMesh mesh;
  mesh.ambient_dim = 4;
  mesh.dim = 1;
  mesh.points = {1, 2, 3, 0.5, -1e-7, 1.0 / 3, 1e22, 0};
  mesh.simplices = {0, 1};
  write_mesh(file("a.noff"), mesh);
  EXPECT_EQ(read_file(file("a.noff")), "nOFF\n4\n2 1 0\n1 2 3 0.5\n-1e-07 0.3333333333333333 1e+22 0\n2 0 1\n");
}

TEST_F(MeshFilesTest, VtuInParaviewsWords) {
  SimplicialMesh mesh = sphere(2, 4);
  mesh.point_data.push_back({"a<b", 2, std::vector<double>(8, 0.5)});
  mesh.cell_data.push_back({"quality", 1, {1, 2, 3, 4}});
  write_mesh(file("a.vtu"), mesh);
  const std::string text = read_file(file("a.vtu"));
  EXPECT_THAT(text, HasSubstr("NumberOfPoints=\"4\" NumberOfCells=\"4\""));
  EXPECT_THAT(text, HasSubstr("Name=\"coordinates\" NumberOfComponents=\"4\""));
  EXPECT_THAT(text, HasSubstr("Name=\"a&lt;b\" NumberOfComponents=\"2\""));
  EXPECT_THAT(text, HasSubstr("Name=\"quality\""));
  EXPECT_EQ(read_mesh(file("a.vtu")).points, mesh.points);
}

TEST_F(MeshFilesTest, PlyCarriesArraysAndNames) {
  SimplicialMesh mesh = sphere(2, 4);
  mesh.point_data.push_back({"f value", 1, {1, 2, 3, 4}});
  mesh.point_data.push_back({"x1", 2, std::vector<double>(8, 7)});  // a name that is taken
  mesh.cell_data.push_back({"quality", 1, {1, 2, 3, 4}});
  MeshWriteOptions options;
  options.variables = {"a", "b", "theta", "x4"};
  options.color_by = "f value";
  write_mesh(file("a.ply"), mesh, options);
  const std::string text = read_file(file("a.ply"));
  const std::string header = text.substr(0, text.find("end_header"));
  EXPECT_THAT(header, HasSubstr("property double f_value\n"));
  EXPECT_THAT(header, HasSubstr("property double x1_1\n"));
  EXPECT_THAT(header, HasSubstr("property double quality\n"));
  EXPECT_THAT(header, HasSubstr("property uchar red\n"));
  EXPECT_THAT(header, HasSubstr("comment x3 is theta\n"));
  EXPECT_THAT(header, Not(HasSubstr("comment x4")));
  EXPECT_EQ(read_mesh(file("a.ply")).points, mesh.points);
  options.color_by = "nothing";
  EXPECT_THAT(message_of<InvalidInput>([&] { write_mesh(file("b.ply"), mesh, options); }), HasSubstr("\"nothing\""));
}

// --- orientation and normals

TEST_F(MeshFilesTest, OrientableSurfacesAreWrittenWithAgreeingTriangles) {
  std::mt19937 random(1);
  SimplicialMesh torus = glued_square(9, 3, false);
  for (std::size_t i = 3; i < torus.simplices.size(); i += 3) {
    if (random() % 2 == 0) std::swap(torus.simplices[i + 1], torus.simplices[i + 2]);
  }
  ASSERT_GT(disagreements(torus), 10);
  write_mesh(file("a.off"), torus);
  const SimplicialMesh back = read_mesh(file("a.off"));
  EXPECT_EQ(disagreements(back), 0);
  EXPECT_EQ(cells_of(back), cells_of(torus));
  EXPECT_EQ(std::vector(back.simplices.begin(), back.simplices.begin() + 3),
            std::vector(torus.simplices.begin(), torus.simplices.begin() + 3));
}

TEST_F(MeshFilesTest, OneSidedAndBranchedSurfacesLoseNoTriangle) {
  const SimplicialMesh klein = glued_square(9, 4, true);
  // Three triangles around one edge, and two tetrahedra's surfaces that touch in a point.
  SimplicialMesh branched = sphere(2, 3);
  branched.points.insert(branched.points.end(), {5, 5, 5, 6, 5, 5, 5, 6, 5, 7, 7, 7});
  branched.simplices.insert(branched.simplices.end(), {0, 4, 5, 0, 5, 6, 0, 6, 4, 4, 5, 6, 1, 2, 7});
  for (const SimplicialMesh& mesh : {klein, branched}) {
    for (const char* name : {"a.off", "a.ply", "a.obj", "a.stl", "a.vtu", "a.noff", "a.mesh", "a.pov"}) {
      ::testing::internal::CaptureStderr();
      write_mesh(file(name), mesh);
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
      if (std::string(name) != "a.pov") {
        EXPECT_EQ(read_mesh(file(name)).num_simplices(), mesh.num_simplices()) << name;
      }
    }
    EXPECT_THAT(read_file(file("a.ply")), Not(HasSubstr("property double nx")));
    EXPECT_THAT(read_file(file("a.obj")), Not(HasSubstr("vn ")));
  }
}

using OpenMeshSurface = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

TEST_F(MeshFilesTest, OpenMeshReadsWhatWeWrite) {
  const SimplicialMesh torus = glued_square(12, 3, false);
  const auto read = [&](const char* name) {
    write_mesh(file(name), torus);
    OpenMeshSurface surface;
    surface.request_vertex_normals();
    OpenMesh::IO::Options options = OpenMesh::IO::Options::VertexNormal;
    EXPECT_TRUE(OpenMesh::IO::read_mesh(surface, file(name).string(), options)) << name;
    EXPECT_EQ(surface.n_vertices(), torus.num_points()) << name;
    EXPECT_EQ(surface.n_faces(), torus.num_simplices()) << name;
    EXPECT_EQ(surface.n_vertices() - surface.n_edges() + surface.n_faces(), 0U) << name;
    return surface;
  };
  for (const char* name : {"a.off", "a.stl"}) read(name);
  for (const char* name : {"a.ply", "a.obj"}) {
    const OpenMeshSurface surface = read(name);
    for (const auto v : surface.vertices()) {
      // The normal of the smooth torus, at the same place.
      const auto p = surface.point(v);
      const double from_axis = std::hypot(p[0], p[1]);
      const OpenMeshSurface::Normal normal(p[0] * (1 - 2 / from_axis), p[1] * (1 - 2 / from_axis), p[2]);
      EXPECT_GT(dot(surface.normal(v), normal), 0.97) << name;
    }
  }
}

TEST_F(MeshFilesTest, PovSceneHoldsTheWholeObject) {
  for (const bool twisted : {false, true}) {
    const SimplicialMesh mesh = glued_square(10, 4, twisted);
    write_mesh(file("a.pov"), mesh);
    const std::string text = read_file(file("a.pov"));
    EXPECT_THAT(text, HasSubstr("vertex_vectors {\n    100,"));
    EXPECT_THAT(text, HasSubstr("face_indices {\n    200,"));
    EXPECT_THAT(text, HasSubstr("normal_vectors {\n    600,"));
    EXPECT_THAT(text, HasSubstr("color_map"));
    EXPECT_THAT(text, HasSubstr("camera"));
    EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
  }
  write_mesh(file("b.pov"), sphere(1, 3));
  EXPECT_THAT(read_file(file("b.pov")), HasSubstr("cylinder"));
}

// --- what must be refused

TEST_F(MeshFilesTest, BrokenMeshesAreNotWritten) {
  const SimplicialMesh good = sphere(2, 4);
  const auto refused = [&](auto break_it) {
    SimplicialMesh bad = good;
    break_it(bad);
    for (const char* name : {"a.off", "a.noff", "a.vtu", "a.pov"}) {
      EXPECT_THROW(write_mesh(file(name), bad), InvalidInput) << name;
    }
  };
  refused([](SimplicialMesh& m) { m.simplices[4] = 4; });
  refused([](SimplicialMesh& m) { m.simplices[4] = m.simplices[3]; });
  refused([](SimplicialMesh& m) { m.simplices.pop_back(); });
  refused([](SimplicialMesh& m) { m.points.pop_back(); });
  refused([](SimplicialMesh& m) { m.points[3] = NAN; });
  refused([](SimplicialMesh& m) { m.points[3] = -INFINITY; });
  refused([](SimplicialMesh& m) { m.ambient_dim = 0; });
  refused([](SimplicialMesh& m) { m.dim = -1; });
  refused([](SimplicialMesh& m) { m.point_data.push_back({"short", 1, {1}}); });
  refused([](SimplicialMesh& m) { m.cell_data.push_back({"none", 0, {}}); });
  PolygonMesh bad = polygons(3);
  bad.offsets = {0, 6, 8, 14, 18};
  EXPECT_THROW(write_mesh(file("a.off"), bad), InvalidInput);
  bad.offsets = {0, 6, 4, 14, 18};
  EXPECT_THROW(write_mesh(file("a.off"), bad), InvalidInput);
  bad.offsets = {0, 6, 10, 14};
  EXPECT_THROW(write_mesh(file("a.off"), bad), InvalidInput);
  bad.offsets = {0, 6, 4000000000U, 14, 18};
  EXPECT_THROW(write_mesh(file("a.off"), bad), InvalidInput);
  bad.offsets = {};
  EXPECT_THROW(write_mesh(file("a.off"), bad), InvalidInput);
  MeshWriteOptions options;
  options.projection = "1,2,9";
  EXPECT_THROW(write_mesh(file("a.off"), good, options), InvalidInput);
  for (const char* name : {"a.txt", "a", "a.json"}) EXPECT_THROW(write_mesh(file(name), good), InvalidInput) << name;
  EXPECT_THROW(read_mesh(file("a.txt")), InvalidInput);
  EXPECT_EQ(files(), 0U);
  EXPECT_THAT(message_of<FileError>([&] { write_mesh(file("missing/a.off"), good); }), HasSubstr("missing/a.off"));
}

TEST_F(MeshFilesTest, BadTextIsRefusedWithItsLine) {
  const auto refusal = [&](const char* name, std::string_view text) {
    return message_of<FileError>([&] { read_text(name, text); });
  };
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"),
              AllOf(HasSubstr("a.off:6:"), HasSubstr("point 7")));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n"),
              AllOf(HasSubstr("a.off:5:"), HasSubstr("finite")));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"),
              AllOf(HasSubstr("a.off:4:"), HasSubstr("\"x\"")));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 1\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n"), HasSubstr("a.off:6:"));
  EXPECT_THAT(refusal("a.off", "OFF\n99999999999999 99999999999 0\n0 0 0\n"), HasSubstr("ends where a coordinate"));
  EXPECT_THAT(refusal("a.off", "OFF\n99999999999999999999999 1 0\n"), HasSubstr("too large"));
  EXPECT_THAT(refusal("a.off", "OFF\n1 1 0\n0 0 0\n999999999999 0 0\n"), HasSubstr("ends where"));
  EXPECT_THAT(refusal("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n2 0 3\n"),
              HasSubstr("several dimensions"));
  EXPECT_THAT(refusal("a.off", "OFF\n1 0 0\n0 0 0\n"), HasSubstr("no cells"));
  EXPECT_THAT(refusal("a.off", ""), HasSubstr("a.off:"));
  EXPECT_THAT(refusal("a.off", "4OFF\n1 0 0\n0 0 0 0\n"), HasSubstr("header"));
  EXPECT_THAT(refusal("a.off", "OFF BINARY\n"), HasSubstr("binary"));
  EXPECT_THAT(refusal("a.noff", "nOFF\n0\n1 1 0\n"), HasSubstr("a.noff:2:"));
  EXPECT_THAT(refusal("a.noff", "nOFF\n4000000000\n1 1 0\n"), HasSubstr("a.noff:2:"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), HasSubstr("a.obj:3:"));
  EXPECT_THAT(refusal("a.obj", "v 0 0\n"), HasSubstr("a.obj:1:"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"), HasSubstr("a.obj:3:"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nl 1 0\n"), HasSubstr("a.obj:2:"));
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nl 1 -2\n"), HasSubstr("a.obj:2:"));
  EXPECT_THAT(refusal("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
              HasSubstr("a.stl:6:"));
  EXPECT_THAT(refusal("a.stl", "solid a\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 0\nendloop\n"),
              HasSubstr("twice"));
  EXPECT_THAT(refusal("a.stl", "rubbish"), HasSubstr("STL"));
  EXPECT_THAT(
      refusal("a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\nTriangles\n1\n1 1 2 0\nEnd\n"),
      HasSubstr("a.mesh:8:"));
  EXPECT_THAT(
      refusal("a.mesh",
              "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n0 1 0 0\n1 0 0 0\nEdges\n1\n1 1 0\nEnd\n"),
      HasSubstr("twice"));
  EXPECT_THAT(refusal("a.mesh", "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 0\n"), HasSubstr("End"));
  EXPECT_THAT(refusal("a.mesh", "MeshVersionFormatted 2\nDimension 7\n"), HasSubstr("a.mesh:2:"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"),
              HasSubstr("property y"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 9\nproperty quad x\nend_header\n0\n"),
              HasSubstr("a.ply:4:"));
  EXPECT_THAT(refusal("a.ply", "ply\nformat ascii 1.0\n"), HasSubstr("header"));
  EXPECT_THAT(refusal("a.ply",
                      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty "
                      "float y\nproperty float z\nend_header\n0123"),
              HasSubstr("cut short"));
  EXPECT_THAT(refusal("a.ply",
                      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0\n"),
              HasSubstr("before faces"));
  EXPECT_THAT(refusal("a.vtu", "<VTKFile type=\"UnstructuredGrid\">"), HasSubstr("AppendedData"));
  EXPECT_THAT(message_of<FileError>([&] { read_mesh(file("none.off")); }), HasSubstr("none.off"));
}

TEST_F(MeshFilesTest, ForeignDialectsAreRead) {
  EXPECT_EQ(read_text("a.off",
                      "# made by hand\nOFF 4 4 6 # counts\n\n0 0 0\n1 0 0 255 0 0\n0 1 0\n0 0 1\n3 0 1 2 0.5 0.5 "
                      "0.5\n3 0 1 3\n3 0 2 3\n3 1 2 3")
                .num_simplices(),
            4U);
  EXPECT_EQ(read_text("a.off", "COFF\r\n3 1 0\r\n0 0 0 1 0 0 1\r\n+1 0 0 1 0 0 1\r\n0 1e-400 0 1 0 0 1\r\n3 0 1 2\r\n")
                .points[3],
            1);
  EXPECT_EQ(read_text("a.obj", "o thing\nv 0 0 0\nv 1 0 0 1\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl a\nf -3/1/1 -2//1 3/1\n")
                .num_simplices(),
            1U);
  EXPECT_EQ(read_text("a.stl",
                      "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n "
                      " endloop\n endfacet\n facet normal 0 0 1\n outer loop\n vertex 1 0 0\n vertex 1 1 0\n vertex -0 "
                      "1 0\n endloop\n endfacet\nendsolid a\n")
                .num_points(),
            4U);
  const SimplicialMesh medit =
      read_text("a.mesh",
                "MeshVersionFormatted 1\n\nDimension\n3\nVertices 4\n0 0 0 1 1 0 0 1\n0 1 0 1\n0 0 1 1\nCorners\n2\n1 "
                "2\nTriangles\n1\n1 2 3 7\nTetrahedra\n1\n1 2 3 4 0\nEnd");
  EXPECT_EQ(medit.dim, 3);
  EXPECT_EQ(medit.num_simplices(), 1U);
  EXPECT_EQ(read_text("a.mesh",
                      "MeshVersionFormatted 1\nDimension 2\nVertices 4\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nQuadrilaterals "
                      "1\n1 2 3 4 0\nEnd")
                .num_simplices(),
            4U);
  const char* ply =
      "ply\nformat ascii 1.0\ncomment here\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty list uchar int extra\nelement face 1\nproperty uchar flag\nproperty list uint8 int32 "
      "vertex_index\nelement other 2\nproperty int a\nend_header\n0 0 0 2 7 7\n1 0 0 0\n0 1 0 0\n9 3 0 1 2\n1\n2\n";
  EXPECT_EQ(read_text("a.ply", ply).simplices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(MeshFilesTest, BigEndianPly) {
  std::string text =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty double "
      "z\nelement face 1\nproperty list uchar ushort vertex_indices\nend_header\n";
  const auto append = [&text](auto value) {
    std::array<char, sizeof(value)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(value));
    text.append(bytes.rbegin(), bytes.rend());
  };
  for (const float x : {0.F, 1.F, 2.F}) {
    append(x);
    append(x * x);
    append(double{x} / 3);
  }
  append(std::uint8_t{3});
  for (const std::uint16_t v : {2, 1, 0}) append(v);
  const SimplicialMesh mesh = read_text("a.ply", text);
  EXPECT_THAT(mesh.points, ::testing::ElementsAre(0, 0, 0, 1, 1, 1. / 3, 2, 4, 2. / 3));
  EXPECT_THAT(mesh.simplices, ::testing::ElementsAre(2, 1, 0));
}

TEST_F(MeshFilesTest, CutAndDamagedFilesNeverCrash) {
  // Whatever happens to the bytes: a mesh whose indices are in range, or a FileError that names the file.
  std::mt19937 random(7);
  const SimplicialMesh mesh = glued_square(4, 4, true);
  for (const char* name : {"a.off", "a.noff", "a.ply", "a.obj", "a.stl", "a.mesh", "a.vtu"}) {
    write_mesh(file(name), mesh);
    const std::string whole = read_file(file(name));
    int refused = 0;
    for (int round = 0; round < 200; ++round) {
      std::string damaged = whole;
      if (round % 2 == 0) damaged.resize(random() % whole.size());
      for (int i = 0; i < round % 5 && !damaged.empty(); ++i) {
        const std::size_t at = random() % std::min<std::size_t>(damaged.size(), round % 3 == 0 ? 300 : damaged.size());
        damaged[at] = round % 4 == 0 ? static_cast<char>('0' + random() % 10) : static_cast<char>(random());
      }
      write_file(file(name), damaged);
      try {
        const SimplicialMesh back = read_mesh(file(name));
        EXPECT_LE(back.num_points(), whole.size());
        for (const std::uint32_t v : back.simplices) ASSERT_LT(v, back.num_points());
        for (const double x : back.points) ASSERT_TRUE(std::isfinite(x));
      } catch (const FileError& error) {
        ++refused;
        ASSERT_THAT(error.what(), HasSubstr(name));
      }
    }
    EXPECT_GT(refused, 50) << name;
  }
}

}  // namespace
}  // namespace whitney
