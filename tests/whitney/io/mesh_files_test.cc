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
#include "io/mesh_cases.h"

namespace whitney {
namespace {

using namespace mesh_cases;

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

}  // namespace
}  // namespace whitney
