// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bodies of the fuzz targets on the kept corpus, on its files cut short, and on files with a byte changed: what the
// fuzzer does (tests/fuzz/run), for a second.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tests/fuzz/expression_body.h>
#include <tests/fuzz/mesh_body.h>
#include <tests/fuzz/partition_body.h>
#include <tests/fuzz/problem_body.h>
#include <tests/fuzz/trace_body.h>

namespace whitney::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::vector<std::uint8_t>> corpus(const std::string& target) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(WHITNEY_SOURCE_DIR) / "tests/fuzz/corpus" / target))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::vector<std::uint8_t>> files;
  for (const fs::path& path : paths) {
    std::ifstream stream(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return files;
}

void try_all(const std::string& target, void (*body)(Bytes), int changes) {
  std::mt19937 random(1);
  const auto files = corpus(target);
  ASSERT_FALSE(files.empty());
  for (const std::vector<std::uint8_t>& file : files) {
    SCOPED_TRACE(target + ": " + std::string(file.begin(), file.end()).substr(0, 200));
    EXPECT_NO_THROW(body(file));
    for (int change = 0; change < changes; ++change) {
      std::vector<std::uint8_t> other = file;
      if (change % 3 == 0) other.resize(random() % (other.size() + 1));
      if (!other.empty()) other[random() % other.size()] = static_cast<std::uint8_t>(random());
      EXPECT_NO_THROW(body(other)) << std::string(other.begin(), other.end());
    }
  }
}

TEST(FuzzBodies, Meshes) { try_all("mesh", mesh_body, 300); }
TEST(FuzzBodies, Problems) { try_all("problem", problem_body, 60); }
TEST(FuzzBodies, Expressions) { try_all("expression", expression_body, 60); }
TEST(FuzzBodies, Partitions) { try_all("partition", partition_body, 20); }
TEST(FuzzBodies, Traces) { try_all("trace", trace_body, 10); }

}  // namespace
}  // namespace whitney::fuzz
