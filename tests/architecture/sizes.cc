// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "architecture.h"
#include "source_text.h"

namespace whitney::architecture {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kFileLines = 500, kFunctionLines = 80;
constexpr const char* kLongOnes = "tests/architecture/long_ones.txt";
constexpr const char* kUntested = "tests/architecture/untested_headers.txt";

std::vector<fs::path> sources_under(const fs::path& root, const std::vector<const char*>& folders) {
  std::vector<fs::path> paths;
  for (const char* folder : folders) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cc")) paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

/// Exceptions by name, and which of them were asked for.
class Exceptions {
 public:
  Exceptions(const fs::path& root, std::string list) : list_(std::move(list)) {
    for (const Exception& exception : read_exceptions(root / list_)) lines_[exception.name] = exception.line;
  }

  bool allow(const std::string& name) {
    used_.insert(name);
    return lines_.count(name) > 0;
  }

  void report_unused(std::vector<Violation>& violations) const {
    for (const auto& [name, line] : lines_) {
      if (used_.count(name) == 0) violations.push_back({"list", list_, line, "no longer needed: " + name});
    }
  }

 private:
  std::string list_;
  std::map<std::string, std::size_t> lines_;
  std::set<std::string> used_;
};

}  // namespace

std::vector<Violation> check_sizes(const fs::path& root) {
  std::vector<Violation> violations;
  Exceptions long_ones(root, kLongOnes), untested(root, kUntested);
  for (const fs::path& file : sources_under(root, {"coxeter", "perturbation", "whitney", "tests", "bench"})) {
    const std::string path = fs::relative(file, root).generic_string();
    std::ifstream stream(file, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    if (file.extension() == ".cc" && lines > kFileLines && !long_ones.allow(path)) {
      violations.push_back({"size", path, lines, std::to_string(lines) + " lines"});
    }
    if (path.starts_with("tests/") || path.starts_with("bench/")) continue;
    for (const Function& function : functions_of(text)) {
      if (function.lines > kFunctionLines && !long_ones.allow(path + ":" + function.name)) {
        violations.push_back(
            {"size", path, function.line, function.name + " has " + std::to_string(function.lines) + " lines"});
      }
    }
    if (file.extension() != ".h" || path.starts_with("whitney/cli/")) continue;
    const fs::path test = root / "tests" / (path.substr(0, path.size() - 2) + "_test.cc");
    if (!fs::exists(test) && !untested.allow(path)) {
      violations.push_back({"test", path, 1, fs::relative(test, root).generic_string() + " is not there"});
    }
  }
  long_ones.report_unused(violations);
  untested.report_unused(violations);
  std::sort(violations.begin(), violations.end());
  return violations;
}

}  // namespace whitney::architecture
