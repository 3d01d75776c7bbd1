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

class RefusedMeshFilesTest : public MeshFilesTest {};

TEST_F(RefusedMeshFilesTest, BrokenMeshesAreNotWritten) {
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

TEST_F(RefusedMeshFilesTest, BadTextIsRefusedWithItsLine) {
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

TEST_F(RefusedMeshFilesTest, ForeignDialectsAreRead) {
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

TEST_F(RefusedMeshFilesTest, BigEndianPly) {
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

TEST_F(RefusedMeshFilesTest, CutAndDamagedFilesNeverCrash) {
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
