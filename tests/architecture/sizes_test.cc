// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "architecture.h"
#include "made_tree.h"

namespace whitney::architecture {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

std::string lines(int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += "x();\n";
  return result;
}

std::vector<std::string> check(const std::map<std::string, std::string>& files) {
  return texts(check_sizes(MadeTree(files).root()));
}

TEST(Sizes, LongFilesAreFound) {
  EXPECT_THAT(check({{"coxeter/a.cc", lines(500)}, {"tests/coxeter/a_test.cc", lines(500)}}), IsEmpty());
  EXPECT_THAT(check({{"coxeter/a.cc", lines(501)}, {"tests/coxeter/b_test.cc", lines(502)}}),
              ElementsAre(HasSubstr("coxeter/a.cc:501"), HasSubstr("tests/coxeter/b_test.cc:502")));
}

TEST(Sizes, LongFunctionsAreFound) {
  EXPECT_THAT(check({{"coxeter/a.cc", "void f() {\n" + lines(78) + "}\n"}}), IsEmpty());
  EXPECT_THAT(check({{"coxeter/a.cc", "namespace w {\nvoid f() {\n" + lines(79) + "}\n}\n"}}),
              ElementsAre(AllOf(StartsWith("coxeter/a.cc:2: f has 81 lines"), HasSubstr("[size]"))));
}

TEST(Sizes, AReasonMakesAnExceptionThatMustBeNeeded) {
  const std::string text = "void f() {\n" + lines(79) + "}\n";
  EXPECT_THAT(check({{"coxeter/a.cc", text}, {"tests/architecture/long_ones.txt", "coxeter/a.cc:f | one switch\n"}}),
              IsEmpty());
  EXPECT_THAT(check({{"coxeter/a.cc", ""}, {"tests/architecture/long_ones.txt", "coxeter/a.cc:f | one switch\n"}}),
              ElementsAre(HasSubstr("no longer needed: coxeter/a.cc:f")));
}

TEST(Sizes, AHeaderHasItsTest) {
  EXPECT_THAT(check({{"coxeter/a.h", ""}, {"tests/coxeter/a_test.cc", ""}, {"whitney/cli/b.h", ""}}), IsEmpty());
  EXPECT_THAT(check({{"coxeter/faces/a.h", ""}}), ElementsAre(HasSubstr("tests/coxeter/faces/a_test.cc is not there")));
  const std::string list = "coxeter/a.h | declares an interface\n";
  EXPECT_THAT(check({{"coxeter/a.h", ""}, {"tests/architecture/untested_headers.txt", list}}), IsEmpty());
  EXPECT_THAT(
      check({{"coxeter/a.h", ""}, {"tests/coxeter/a_test.cc", ""}, {"tests/architecture/untested_headers.txt", list}}),
      ElementsAre(HasSubstr("no longer needed: coxeter/a.h")));
}

}  // namespace
}  // namespace whitney::architecture
