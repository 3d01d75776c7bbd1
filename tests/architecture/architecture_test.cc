// SPDX-License-Identifier: GPL-3.0-or-later
#include "architecture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_tree.h"

namespace whitney::architecture {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Architecture, ThisTreeKeepsTheRules) {
  auto violations = check_architecture(WHITNEY_SOURCE_DIR);
  const auto sizes = check_sizes(WHITNEY_SOURCE_DIR);
  violations.insert(violations.end(), sizes.begin(), sizes.end());
  for (const std::string& line : texts(without_pending(WHITNEY_SOURCE_DIR, violations))) ADD_FAILURE() << line;
}

TEST(Architecture, AGoodTreePasses) {
  EXPECT_THAT(
      check_tree(
          {{"coxeter/base/a.h", "#pragma once\n#include <vector>\n"},
           {"coxeter/a.h", "#include <coxeter/base/a.h>\n"},
           {"coxeter/faces/a.h", "#include <coxeter/a.h>\n"},
           {"coxeter/faces/nibbles.h", "#ifdef __BMI2__\n#include <immintrin.h>\n"},
           {"coxeter/base/memory_use.cc", "std::ifstream file(\"/proc/self/statm\");\n"},
           {"coxeter/base/parallel.cc", "#include <tbb/parallel_for.h>\n"},
           {"perturbation/b.h", "#include <coxeter/faces/a.h>\n"},
           {"perturbation/interval.cc", "#include <CGAL/Interval_nt.h>\n"},
           {"whitney/functions/c.cc", "#include <CGAL/Gmpq.h>\n#include <ginac/ginac.h>\n#include <sstream>\n"},
           {"whitney/tracing/t.cc", "#include <perturbation/interval.h>\n#ifdef __AVX2__\nstd::snprintf(a, b);\n"},
           {"whitney/cells/f.h",
            "// #include <whitney/io/d.h>, \"a.ply\", OpenMesh\n/* nlohmann\n */ int my_ofstream = result.mesh;\n"},
           {"whitney/problem/p.h", "#include <whitney/cells/f.h>\n"},
           {"whitney/io/d.cc", "#include <OpenMesh/x.hh>\n#include <fstream>\n#include \"formats/e.h\"\n"},
           {"whitney/io/formats/e.h", "#include <whitney/cells/f.h>\n#include <nlohmann/json.hpp>\n"},
           {"whitney/io/openmesh.h", "#include <OpenMesh/x.hh>\n"},
           {"whitney/cli/main.cc",
            "#include <whitney/io/d.h>\n#include <iostream>\n#include <whitney/problem/p.h>\n\"file.ply\";\n"},
           {"tests/t.cc", "#include <whitney/cli/main.h>\n"}}),
      IsEmpty());
}

TEST(Architecture, AFileOutsideTheRoomsIsFound) {
  EXPECT_THAT(check_tree({{"whitney/a.h", ""}}), ElementsAre(AllOf(HasSubstr("rooms"), HasSubstr("[room]"))));
  EXPECT_THAT(check_tree({{"coxeter/misc/a.h", ""}}), ElementsAre(HasSubstr("[room]")));
}

/// Room and header for which there is no arrow: each room against what stands next to it or to its right.
TEST(Architecture, IncludesWithoutAnArrowAreFound) {
  const std::pair<const char*, const char*> kForbidden[] = {
      {"coxeter/base", "coxeter/simplex.h"},
      {"coxeter", "coxeter/faces/faces.h"},
      {"coxeter", "coxeter/tables/vertex_table.h"},
      {"coxeter", "perturbation/interval.h"},
      {"coxeter/tables", "coxeter/simplex.h"},
      {"coxeter/tables", "coxeter/faces/faces.h"},
      {"coxeter/faces", "coxeter/tables/vertex_table.h"},
      {"perturbation", "whitney/topology/mesh.h"},
      {"perturbation", "whitney/manifolds/submanifold.h"},
      {"whitney/topology", "coxeter/simplex.h"},
      {"whitney/topology", "whitney/functions/function.h"},
      {"whitney/topology", "whitney/cells/cell_complex.h"},
      {"whitney/functions", "coxeter/triangulation.h"},
      {"whitney/functions", "perturbation/interval.h"},
      {"whitney/functions", "whitney/topology/mesh.h"},
      {"whitney/functions", "whitney/manifolds/submanifold.h"},
      {"whitney/manifolds", "coxeter/simplex.h"},
      {"whitney/manifolds", "whitney/cells/cell_complex.h"},
      {"whitney/manifolds", "whitney/topology/mesh.h"},
      {"whitney/cells", "whitney/functions/function.h"},
      {"whitney/cells", "perturbation/displacement.h"},
      {"whitney/cells", "whitney/tracing/trace.h"},
      {"whitney/tracing", "perturbation/certificate.h"},
      {"whitney/tracing", "whitney/manifolds/submanifold.h"},
      {"whitney/tracing", "whitney/construction/triangulate.h"},
      {"whitney/tracing", "whitney/atlas/quilt.h"},
      {"whitney/construction", "whitney/tracing/trace.h"},
      {"whitney/construction", "whitney/atlas/quilt.h"},
      {"whitney/atlas", "whitney/tracing/trace.h"},
      {"whitney/atlas", "whitney/construction/triangulate.h"},
      {"whitney/atlas", "coxeter/simplex.h"},
      {"whitney/problem", "whitney/io/read_problem.h"},
      {"whitney/problem", "whitney/cli/commands.h"},
      {"whitney/io", "whitney/cli/commands.h"},
      {"whitney/cli", "whitney/tracing/trace.h"},
      {"whitney/cli", "whitney/cells/cell_complex.h"},
      {"whitney/cli", "whitney/io/formats/mesh_view.h"},
      {"whitney/cells", "whitney/io/formats/mesh_view.h"},
  };
  for (const auto& [room, header] : kForbidden) {
    EXPECT_THAT(check_tree({{std::string(room) + "/a.cc", "\n#include <" + std::string(header) + ">\n"}}),
                ElementsAre(AllOf(StartsWith(std::string(room) + "/a.cc:2:"), HasSubstr("[arrow]"))))
        << room << " -> " << header;
  }
}

TEST(Architecture, IncludesBesideAFileAreFollowed) {
  EXPECT_THAT(check_tree({{"perturbation/a.h", "#include \"../whitney/cells/mesh.h\""}, {"whitney/cells/mesh.h", ""}}),
              ElementsAre(HasSubstr("include of whitney/cells/mesh.h")));
}

TEST(Architecture, CyclesAreFound) {
  EXPECT_THAT(check_tree({{"coxeter/a.h", "#include <coxeter/b.h>"},
                          {"coxeter/b.h", "#include <coxeter/c.h>"},
                          {"coxeter/c.h", "#include \"b.h\""}}),
              ElementsAre(HasSubstr("cycle coxeter/b.h -> coxeter/c.h -> coxeter/b.h")));
  EXPECT_THAT(check_tree({{"coxeter/a.h", "#include <coxeter/a.h>"}}), ElementsAre(HasSubstr("cycle")));
}

TEST(Architecture, FormatsOutsideIoAreFound) {
  for (const char* line : {"using M = OpenMesh::X;", "nlohmann::json j;", "std::ofstream out;", "#include <fstream>",
                           "if (path.ends_with(\".ply\")) {}", "auto f = fopen(p, q);"}) {
    for (const char* room : {"whitney/cells", "whitney/problem"}) {
      EXPECT_THAT(check_tree({{std::string(room) + "/a.cc", std::string("\n") + line}}),
                  ElementsAre(AllOf(StartsWith(std::string(room) + "/a.cc:2:"), HasSubstr("[format]"))))
          << line;
    }
  }
  for (const char* line : {"nlohmann::json j;", "std::ifstream in;", "#include <OpenMesh/x.hh>"}) {
    EXPECT_THAT(check_tree({{"whitney/cli/a.cc", line}}), ElementsAre(HasSubstr("[format]"))) << line;
  }
}

TEST(Architecture, PrintingBelowIoIsFound) {
  for (const char* line : {"#include <iostream>", "std::cout << x;", "std::cerr << x;", "printf(\"x\");",
                           "std::fprintf(f, \"x\");", "std::ostream& operator<<(std::ostream&, int);", "puts(s);"}) {
    for (const char* room : {"coxeter/base", "perturbation", "whitney/topology", "whitney/problem"}) {
      EXPECT_THAT(check_tree({{std::string(room) + "/a.cc", line}}), ElementsAre(HasSubstr("[printing]"))) << line;
    }
  }
}

TEST(Architecture, AlgorithmsInTheProgramAreFound) {
  for (const char* header :
       {"cmath", "numeric", "random", "Eigen/Core", "boost/container/small_vector.hpp", "gmpxx.h"}) {
    EXPECT_THAT(check_tree({{"whitney/cli/a.cc", "#include <" + std::string(header) + ">"}}),
                ElementsAre(HasSubstr("[program]")))
        << header;
  }
}

TEST(Architecture, LibrariesInPublicHeadersAreFound) {
  for (const char* header : {"CGAL/Gmpq.h", "ginac/ginac.h", "gmpxx.h", "gmp.h", "boost/multiprecision/cpp_int.hpp",
                             "Eigen/Core", "Eigen/Dense"}) {
    for (const char* path : {"coxeter/a.h", "perturbation/a.h", "whitney/cells/a.h", "whitney/io/a.h"}) {
      EXPECT_THAT(check_tree({{path, "#include <" + std::string(header) + ">"}}), ElementsAre(HasSubstr("[public]")))
          << header;
    }
  }
  for (const char* header : {"OpenMesh/x.hh", "nlohmann/json.hpp"}) {
    EXPECT_THAT(check_tree({{"whitney/io/a.h", "#include <" + std::string(header) + ">"}}),
                ElementsAre(HasSubstr("[public]")));
  }
  EXPECT_THAT(check_tree({{"coxeter/base/parallel.h", "#include <tbb/task_arena.h>"}}),
              ElementsAre(HasSubstr("[public]")));
  EXPECT_THAT(check_tree({{"whitney/io/openmesh.h", "#include <nlohmann/json.hpp>"}}),
              ElementsAre(HasSubstr("[public]")));
}

TEST(Architecture, PublicHeadersAreClosedUnderInclusion) {
  const std::string list = "# internal\nwhitney/cells/raw.h | shapes of arrays\n";
  EXPECT_THAT(check_tree({{"cmake/internal_headers.txt", list},
                          {"whitney/cells/raw.h", "#include <Eigen/Core>\n#ifdef __AVX2__\n"},
                          {"whitney/cells/a.cc", "#include <whitney/cells/raw.h>"}}),
              IsEmpty());
  EXPECT_THAT(check_tree({{"cmake/internal_headers.txt", list},
                          {"whitney/cells/raw.h", ""},
                          {"whitney/cells/a.h", "#include <whitney/cells/raw.h>"}}),
              ElementsAre(HasSubstr("whitney/cells/raw.h, which is not public [public]")));
  EXPECT_THAT(check_tree({{"cmake/internal_headers.txt", list}, {"whitney/cells/a.h", ""}}),
              ElementsAre(AllOf(StartsWith("cmake/internal_headers.txt:2:"), HasSubstr("[list]"))));
  EXPECT_THAT(check_tree({{"whitney/io/a.h", "#include <whitney/io/formats/b.h>"}}),
              ElementsAre(HasSubstr("not public [public]")));
}

TEST(Architecture, PublicHeadersThatDependOnFlagsAreFound) {
  for (const char* line : {"#ifdef __AVX2__", "#if defined(__BMI2__)", "#include <immintrin.h>", "#ifdef __SSE2__",
                           "#if EIGEN_MAX_ALIGN_BYTES == 32", "#ifdef __ARM_NEON"}) {
    EXPECT_THAT(check_tree({{"coxeter/faces/a.h", line}}), ElementsAre(HasSubstr("[flags]"))) << line;
    EXPECT_THAT(check_tree({{"coxeter/faces/a.cc", line}}), IsEmpty()) << line;
  }
}

TEST(Architecture, ThreadsAndIntervalsHaveOneDoor) {
  EXPECT_THAT(check_tree({{"whitney/tracing/a.cc", "#include <tbb/parallel_for.h>"}}),
              ElementsAre(HasSubstr("[threads]")));
  EXPECT_THAT(check_tree({{"coxeter/base/text.cc", "tbb::task_arena arena;"}}), ElementsAre(HasSubstr("[threads]")));
  for (const char* line : {"#include <CGAL/Interval_nt.h>", "CGAL::Interval_nt<false> x;", "mpfi_t x;",
                           "std::fesetround(FE_UPWARD);", "#include <boost/numeric/interval.hpp>"}) {
    EXPECT_THAT(check_tree({{"perturbation/certificate_proof.cc", line}}), ElementsAre(HasSubstr("[interval]")))
        << line;
    EXPECT_THAT(check_tree({{"whitney/tracing/isotopy.cc", line}}), ElementsAre(HasSubstr("[interval]"))) << line;
  }
}

TEST(Architecture, AFolderThatIsNotTheProjectIsAnError) { EXPECT_ANY_THROW(check_tree({{"src/a.h", ""}})); }

TEST(Pending, ExceptionsApplyAndMustBeNeeded) {
  const MadeTree tree(
      {{"whitney/cells/a.cc", "#include <iostream>\n"},
       {"whitney/cells/b.cc", "#include <iostream>\n"},
       {"tests/architecture/pending.txt",
        "# what is still to do\nprinting whitney/cells/a.cc | tracing\narrow whitney/cells/a.cc | gone\n"}});
  EXPECT_THAT(texts(without_pending(tree.root(), check_architecture(tree.root()))),
              ElementsAre(HasSubstr("whitney/cells/b.cc"),
                          "tests/architecture/pending.txt:3: no longer needed: arrow whitney/cells/a.cc [list]"));
}

TEST(Pending, AnExceptionGivesAReason) {
  const MadeTree tree({{"coxeter/a.h", ""}, {"tests/architecture/pending.txt", "arrow coxeter/a.h\n"}});
  EXPECT_ANY_THROW(without_pending(tree.root(), {}));
}

}  // namespace
}  // namespace whitney::architecture
