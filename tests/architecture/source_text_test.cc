// SPDX-License-Identifier: GPL-3.0-or-later
#include "source_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace whitney::architecture {
namespace {

using ::testing::ElementsAre;

TEST(WithoutComments, KeepsStringsAndLines) {
  EXPECT_EQ(without_comments("a // b\nc"), "a \nc");
  EXPECT_EQ(without_comments("a /* b\nc */ d"), "a   \n   d");
  EXPECT_EQ(without_comments("\"// no\" // yes"), "\"// no\" ");
  EXPECT_EQ(without_comments("'\"' // yes"), "'\"' ");
  EXPECT_EQ(without_comments("\"\\\"\" // yes"), "\"\\\"\" ");
  EXPECT_EQ(without_comments("1'000'000 // yes"), "1'000'000 ");
  EXPECT_EQ(without_comments("R\"x(// \" no)x\" // yes"), "R\"x(// \" no)x\" ");
}

std::vector<std::string> functions(const std::string& text) {
  std::vector<std::string> result;
  for (const Function& f : functions_of(text)) {
    result.push_back(f.name + " " + std::to_string(f.line) + " " + std::to_string(f.lines));
  }
  return result;
}

TEST(FunctionsOf, FindsFunctionsByTheirBraces) {
  EXPECT_THAT(
      functions("int f() { return 1; }\nint g(int);\n\nint\nh(int x) {\n  if (x) { return 2; }\n  return 3;\n}\n"),
      ElementsAre("f 1 1", "h 4 5"));
}

TEST(FunctionsOf, LooksIntoNamespacesAndClasses) {
  EXPECT_THAT(functions("namespace a::b {\nnamespace {\nclass C : public D {\n public:\n  void f() const {\n  }\n"
                        "  int x_ = 0;\n};\nstruct alignas(64) E {\n  E() : x{1} {}\n};\nenum class F { kA, kB };\n"
                        "template <typename T>\nvoid g(T t) requires(t > 0) {\n}\n}\n}\n"),
              ElementsAre("f 5 2", "E 10 1", "g 13 3"));
}

TEST(FunctionsOf, TablesAndTextsAreNoFunctions) {
  EXPECT_THAT(functions("const std::map<int, int> kA = {{1, 2}, {3, 4}};\nconstexpr int kB[] = {1, 2};\nint x{3};\n"
                        "const char* s = \"void f() {\";\n#define BLOCK(x) { \\\n  x\nchar c = '{';\n"
                        "auto r = R\"(void g() {)\";\nstruct S { int a; } kS;\nvoid f() {}\n"),
              ElementsAre("f 10 1"));
}

TEST(FunctionsOf, LocalLambdasAndClassesBelongToTheirFunction) {
  EXPECT_THAT(
      functions(
          "void f() {\n  const auto g = [](int x) {\n    return x;\n  };\n  struct L { int h() { return 1; } };\n}\n"),
      ElementsAre("f 1 6"));
}

}  // namespace
}  // namespace whitney::architecture
