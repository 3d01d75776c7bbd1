// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/atomic_file.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/io/read_file.h>

namespace whitney {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

class AtomicFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("whitney_atomic_" + std::to_string(::getpid()));
    fs::remove_all(folder_);
    fs::create_directory(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }

  fs::path folder_;
};

template <class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(AtomicFileTest, AppearsOnCommitOnly) {
  const fs::path path = folder_ / "a.txt";
  AtomicFile file(path);
  file.write("x = ");
  file.write(0.1);
  file.write(' ');
  file.write(std::uint64_t{18446744073709551615U});
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(files(), 1);
  file.commit();
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(read_file(path), "x = 0.1 18446744073709551615");
}

TEST_F(AtomicFileTest, WithoutCommitNothingChanges) {
  const fs::path path = folder_ / "a.txt";
  write_file(path, "old");
  {
    AtomicFile file(path);
    file.write(std::string(3 << 20, 'n'));
  }
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(read_file(path), "old");
}

TEST_F(AtomicFileTest, LongTextsPassTheBuffer) {
  std::string text(5000001, '.');
  for (std::size_t i = 0; i < text.size(); i += 7) text[i] = static_cast<char>('a' + i % 26);
  write_file(folder_ / "long", text);
  EXPECT_EQ(read_file(folder_ / "long"), text);
}

TEST_F(AtomicFileTest, DoublesReadBack) {
  std::string text;
  const double values[] = {1.0 / 3, 0.1 + 0.2, 5e-324, 1.7976931348623157e308, -0.0, 1e22};
  for (const double value : values) {
    AtomicFile file(folder_ / "x");
    file.write(value);
    file.commit();
    EXPECT_EQ(std::strtod(read_file(folder_ / "x").c_str(), nullptr), value);
  }
}

TEST_F(AtomicFileTest, AFileThatDoesNotFitIsRemovedAndTheOldOneStays) {
  // A limit on the size of files stands in for a full disk: the same path through write(2), without a disk to fill.
  const fs::path path = folder_ / "a.txt";
  write_file(path, "old");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 3 << 20;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = message_of([&] { write_file(path, std::string(5 << 20, 'n')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, AllOf(HasSubstr(path.string()), HasSubstr("too large")));
  EXPECT_EQ(files(), 1);
  EXPECT_EQ(read_file(path), "old");
}

TEST_F(AtomicFileTest, AFullDeviceIsAnError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  EXPECT_THAT(message_of([] { write_file("/dev/full", "x"); }),
              AllOf(HasSubstr("/dev/full"), HasSubstr("No space left")));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_EQ(message_of([] { write_file("/dev/null", "x"); }), "no error");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, NamesThatCannotBeWritten) {
  EXPECT_THAT(message_of([&] { AtomicFile(folder_ / "missing" / "a"); }),
              AllOf(HasSubstr("missing/a"), HasSubstr("No such file")));
  EXPECT_THAT(message_of([&] { AtomicFile{folder_}; }), HasSubstr("directory"));
  EXPECT_THAT(message_of([&] { AtomicFile(""); }), HasSubstr("cannot write"));
  write_file(folder_ / "file", "");
  EXPECT_THAT(message_of([&] { AtomicFile(folder_ / "file" / "a"); }), HasSubstr("Not a directory"));
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFileTest, SymbolicLinksAndPermissionsStay) {
  write_file(folder_ / "target", "old");
  fs::permissions(folder_ / "target", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("target", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "target"), "new");
  EXPECT_EQ(fs::status(folder_ / "target").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, SeveralAtOnceInOneFolder) {
  AtomicFile a(folder_ / "a"), b(folder_ / "b");
  a.write("a");
  b.write("b");
  b.commit();
  a.commit();
  EXPECT_EQ(read_file(folder_ / "a"), "a");
  EXPECT_EQ(read_file(folder_ / "b"), "b");
}

TEST(ReadFile, SaysWhy) {
  EXPECT_THAT(message_of([] { read_file("/nowhere/x"); }), AllOf(HasSubstr("/nowhere/x"), HasSubstr("No such file")));
  EXPECT_THAT(message_of([] { read_file("/tmp"); }), HasSubstr("directory"));
}

}  // namespace
}  // namespace whitney
