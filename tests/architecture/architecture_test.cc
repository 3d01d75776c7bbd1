// SPDX-License-Identifier: GPL-3.0-or-later
#include "architecture.h"

#include <fstream>
#include <map>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace whitney::architecture {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Architecture, ThisTreeKeepsTheRules) { EXPECT_THAT(check_architecture(WHITNEY_SOURCE_DIR), IsEmpty()); }

/// What the checker says of a tree made of these files.
std::vector<Violation> check_tree(const std::map<std::string, std::string>& files) {
  const fs::path root = fs::temp_directory_path() / ("whitney_tree_" + std::to_string(::getpid()));
  fs::remove_all(root);
  for (const auto& [path, text] : files) {
    fs::create_directories((root / path).parent_path());
    std::ofstream(root / path) << text;
  }
  const auto violations = check_architecture(root);
  fs::remove_all(root);
  return violations;
}

TEST(Architecture, AGoodTreePasses) {
  EXPECT_THAT(
      check_tree(
          {{"coxeter/a.h", "#pragma once\n#include <vector>\n"},
           {"perturbation/b.h", "#include <coxeter/a.h>\n"},
           {"whitney/c.cc", "#include <CGAL/Gmpq.h>\n#include <ginac/ginac.h>\n#include <perturbation/b.h>\n"},
           {"whitney/io/d.cc", "#include <OpenMesh/x.hh>\n#include <fstream>\n#include \"internal/e.h\"\n"},
           {"whitney/io/internal/e.h", "#include <whitney/f.h>\n"},
           {"whitney/f.h",
            "// #include <whitney/io/d.h>, \"a.ply\", OpenMesh\n/* nlohmann\n */ int my_ofstream = result.mesh;\n"},
           {"whitney/cli/main.cc", "#include <whitney/io/d.h>\n#include <nlohmann/json.hpp>\n"},
           {"tests/t.cc", "#include <whitney/cli/main.h>\n"}}),
      IsEmpty());
}

TEST(Architecture, UpwardIncludesAreFound) {
  EXPECT_THAT(check_tree({{"coxeter/a.h", "\n#include <perturbation/b.h>\n"}}),
              ElementsAre(AllOf(StartsWith("coxeter/a.h:2:"), HasSubstr("upward"))));
  EXPECT_THAT(check_tree({{"coxeter/a.cc", "# include \"whitney/mesh.h\"\n"}}), ElementsAre(HasSubstr("upward")));
  EXPECT_THAT(check_tree({{"perturbation/a.h", "#include <whitney/topology/mesh.h>"}}),
              ElementsAre(HasSubstr("upward")));
  EXPECT_THAT(check_tree({{"perturbation/a.h", "#include \"../whitney/mesh.h\""}, {"whitney/mesh.h", ""}}),
              ElementsAre(HasSubstr("upward include of whitney/mesh.h")));
  EXPECT_THAT(check_tree({{"whitney/trace.h", "#include <whitney/io/write_mesh.h>"}}),
              ElementsAre(HasSubstr("upward")));
  EXPECT_THAT(check_tree({{"whitney/io/a.cc", "#include <whitney/cli/b.h>"}}), ElementsAre(HasSubstr("upward")));
  EXPECT_THAT(check_tree({{"whitney/cli/a.cc", "#include <whitney/io/internal/b.h>"}}),
              ElementsAre(HasSubstr("internal")));
}

TEST(Architecture, CyclesAreFound) {
  EXPECT_THAT(check_tree({{"coxeter/a.h", "#include <coxeter/b.h>"},
                          {"coxeter/b.h", "#include <coxeter/c.h>"},
                          {"coxeter/c.h", "#include \"b.h\""}}),
              ElementsAre(HasSubstr("cycle coxeter/b.h -> coxeter/c.h -> coxeter/b.h")));
  EXPECT_THAT(check_tree({{"whitney/a.h", "#include <whitney/a.h>"}}), ElementsAre(HasSubstr("cycle")));
}

TEST(Architecture, FormatsOutsideIoAreFound) {
  for (const char* line : {"using M = OpenMesh::X;", "nlohmann::json j;", "std::ofstream out;", "#include <fstream>",
                           "if (path.ends_with(\".ply\")) {}", "auto f = fopen(p, q);"}) {
    EXPECT_THAT(check_tree({{"whitney/a.cc", std::string("\n") + line}}),
                ElementsAre(AllOf(StartsWith("whitney/a.cc:2:"), HasSubstr("whitney/io"))))
        << line;
  }
}

TEST(Architecture, LibrariesInPublicHeadersAreFound) {
  for (const char* header : {"CGAL/Gmpq.h", "ginac/ginac.h"}) {
    EXPECT_THAT(check_tree({{"whitney/a.h", "#include <" + std::string(header) + ">"}}),
                ElementsAre(HasSubstr("public header")));
  }
  EXPECT_THAT(check_tree({{"whitney/io/a.h", "#include <OpenMesh/x.hh>"}}), ElementsAre(HasSubstr("public header")));
}

TEST(Architecture, AFolderThatIsNotTheProjectIsAnError) { EXPECT_ANY_THROW(check_tree({{"src/a.h", ""}})); }

TEST(WithoutComments, KeepsStringsAndLines) {
  EXPECT_EQ(without_comments("a // b\nc"), "a \nc");
  EXPECT_EQ(without_comments("a /* b\nc */ d"), "a   \n   d");
  EXPECT_EQ(without_comments("\"// no\" // yes"), "\"// no\" ");
  EXPECT_EQ(without_comments("'\"' // yes"), "'\"' ");
  EXPECT_EQ(without_comments("\"\\\"\" // yes"), "\"\\\"\" ");
  EXPECT_EQ(without_comments("1'000'000 // yes"), "1'000'000 ");
  EXPECT_EQ(without_comments("R\"x(// \" no)x\" // yes"), "R\"x(// \" no)x\" ");
}

}  // namespace
}  // namespace whitney::architecture
