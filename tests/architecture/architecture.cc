// SPDX-License-Identifier: GPL-3.0-or-later
#include "architecture.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "source_text.h"

namespace whitney::architecture {
namespace fs = std::filesystem;

namespace {

/// The arrows: a room, and the rooms that its files may include beside their own. coxeter/base is open to all.
const std::map<std::string, std::set<std::string>>& arrows() {
  static const std::set<std::string> kCoxeter = {"coxeter", "coxeter/faces", "coxeter/tables"};
  const auto with = [](std::set<std::string> rooms, const std::set<std::string>& more) {
    rooms.insert(more.begin(), more.end());
    return rooms;
  };
  static const std::set<std::string> kBelowProblem =
      with(kCoxeter, {"perturbation", "whitney/topology", "whitney/functions", "whitney/manifolds", "whitney/cells",
                      "whitney/tracing", "whitney/construction", "whitney/atlas"});
  static const std::map<std::string, std::set<std::string>> kArrows = {
      {"coxeter/base", {}},
      {"coxeter", {}},
      {"coxeter/faces", {"coxeter"}},
      {"coxeter/tables", {}},
      {"perturbation", kCoxeter},
      {"whitney/topology", {}},
      {"whitney/functions", {}},
      {"whitney/manifolds", {"whitney/functions", "perturbation"}},
      {"whitney/cells", with(kCoxeter, {"whitney/topology"})},
      {"whitney/tracing", with(kCoxeter, {"whitney/functions", "whitney/cells", "whitney/topology"})},
      {"whitney/construction",
       with(kCoxeter, {"whitney/manifolds", "whitney/cells", "whitney/topology", "whitney/functions", "perturbation"})},
      {"whitney/atlas", {"whitney/functions", "whitney/cells", "whitney/topology"}},
      {"whitney/problem", kBelowProblem},
      {"whitney/io", with(kBelowProblem, {"whitney/problem", "whitney/io/formats"})},
      {"whitney/io/formats", with(kBelowProblem, {"whitney/problem", "whitney/io"})},
      {"whitney/cli", {"whitney/io", "whitney/problem"}},
  };
  return kArrows;
}

/// Single headers that are open to a room which does not reach the rest of theirs.
const std::set<std::pair<std::string, std::string>> kSingleHeaders = {
    {"whitney/tracing", "perturbation/interval.h"},
};

/// What whitney/cli may include beside problem/ and io/: values without an algorithm, or the call that a command is.
const std::set<std::string> kPlainHeaders = {"perturbation/parameters.h"};

constexpr const char* kCli = "whitney/cli";
constexpr const char* kParallel = "coxeter/base/parallel.";
constexpr const char* kInterval = "perturbation/interval.";
/// Public although it depends on flags: all of it is in a namespace named after the instructions.
constexpr const char* kNamedAfterFlags = "coxeter/faces/nibbles.h";
/// Reads what the system tells of memory: no file of ours, no format.
constexpr const char* kSystemFiles = "coxeter/base/memory_use.cc";
constexpr const char* kInternalHeaders = "cmake/internal_headers.txt";
constexpr const char* kOpenMeshAdaptor = "whitney/io/openmesh.h";

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

/// The folder of a path relative to the root.
std::string room_of(const std::string& path) { return fs::path(path).parent_path().generic_string(); }

bool is_ours(const std::string& path) {
  return starts_with(path, "coxeter/") || starts_with(path, "perturbation/") || starts_with(path, "whitney/");
}

bool is_in_io(const std::string& room) { return room == "whitney/io" || room == "whitney/io/formats"; }

struct Include {
  std::size_t line;
  std::string path;  ///< relative to the root where the file is ours, else as written
};

struct Source {
  std::vector<std::string> lines;  ///< without comments
  std::vector<Include> includes;
};

Source read_source(const fs::path& root, const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  static const std::regex kIncludePattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  Source source;
  std::istringstream code(without_comments(text));
  for (std::string line; std::getline(code, line);) {
    source.lines.push_back(line);
    std::smatch match;
    if (!std::regex_search(line, match, kIncludePattern)) continue;
    std::string target = match[2];
    const fs::path beside = path.parent_path() / target;
    if (match[1] == "\"" && fs::exists(beside)) target = fs::relative(beside, root).generic_string();
    source.includes.push_back({source.lines.size(), fs::path(target).lexically_normal().generic_string()});
  }
  return source;
}

class Checker {
 public:
  explicit Checker(const fs::path& root) {
    bool found = false;
    for (const char* folder : {"coxeter", "perturbation", "whitney"}) {
      if (!fs::is_directory(root / folder)) continue;
      found = true;
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || (extension != ".h" && extension != ".cc")) continue;
        sources_.emplace(fs::relative(entry.path(), root).generic_string(), read_source(root, entry.path()));
      }
    }
    if (!found) throw std::runtime_error(root.string() + " has none of the folders coxeter, perturbation, whitney");
    for (const Exception& header : read_exceptions(root / kInternalHeaders)) {
      internal_.insert(header.name);
      if (sources_.count(header.name) == 0) {
        report("list", kInternalHeaders, header.line, "no longer there: " + header.name);
      }
    }
  }

  std::vector<Violation> run() {
    for (const auto& [path, source] : sources_) {
      const std::string room = room_of(path);
      if (arrows().count(room) == 0) report("room", path, 1, room + " is not one of the rooms");
      check_arrows(path, source);
      if (room == kCli) check_program(path, source);
      if (is_public(path)) check_public(path, source);
      check_libraries(path, source);
      check_formats(path, source);
      if (!is_in_io(room) && room != kCli) {
        check_words("printing", path, source, {kPrinting}, "nothing below whitney/io prints");
      }
      find_cycles(path);
    }
    std::sort(violations_.begin(), violations_.end());
    violations_.erase(std::unique(violations_.begin(), violations_.end()), violations_.end());
    return violations_;
  }

 private:
  void report(const std::string& rule, const std::string& path, std::size_t line, const std::string& what) {
    violations_.push_back({rule, path, line, what});
  }

  bool is_public(const std::string& path) const {
    const std::string room = room_of(path);
    return fs::path(path).extension() == ".h" && room != kCli && room != "whitney/io/formats" &&
           internal_.count(path) == 0;
  }

  void check_arrows(const std::string& path, const Source& source) {
    const std::string room = room_of(path);
    const auto reach = arrows().find(room);
    if (reach == arrows().end()) return;
    for (const Include& include : source.includes) {
      if (!is_ours(include.path)) continue;
      const std::string target = room_of(include.path);
      const bool plain = room == kCli && kPlainHeaders.count(include.path) > 0;
      if (target == room || target == "coxeter/base" || plain || reach->second.count(target) > 0 ||
          kSingleHeaders.count({room, include.path}) > 0) {
        continue;
      }
      report("arrow", path, include.line, "no arrow from " + room + " to " + target + ": include of " + include.path);
    }
  }

  void check_program(const std::string& path, const Source& source) {
    static const std::regex kTools(
        R"(^(cmath|complex|numeric|random|valarray|queue|stack|thread|mutex|future)$|^(Eigen|boost|CGAL|ginac|tbb)/|^gmp)");
    for (const Include& include : source.includes) {
      if (std::regex_search(include.path, kTools)) {
        report("program", path, include.line, include.path + ": whitney/cli has no algorithm; call whitney/problem");
      }
    }
  }

  void check_public(const std::string& path, const Source& source) {
    static const std::regex kLibraries(
        R"(^(CGAL|ginac|OpenMesh|nlohmann|tbb|oneapi|Eigen|unsupported|boost/multiprecision)/|^(boost/multiprecision|gmp))");
    static const std::regex kFlags(
        R"(\b(__AVX\w*|__SSE\w*|__SSSE\w*|__BMI\w*|__FMA__|__F16C__|__POPCNT__|__LZCNT__|__ARM_\w*|__aarch64__|EIGEN_\w+|immintrin|\w+mmintrin|arm_neon)\b)");
    for (const Include& include : source.includes) {
      if (path == kOpenMeshAdaptor && starts_with(include.path, "OpenMesh/")) continue;
      if (std::regex_search(include.path, kLibraries)) {
        report("public", path, include.line, "a public header includes " + include.path);
      }
      if (is_ours(include.path) && !is_public(include.path)) {
        report("public", path, include.line, "a public header includes " + include.path + ", which is not public");
      }
    }
    if (path == kNamedAfterFlags) return;
    check_words("flags", path, source, {kFlags}, "a public header depends on the flags it is compiled with");
  }

  void check_libraries(const std::string& path, const Source& source) {
    static const std::regex kTbb(R"(\b(tbb::|oneapi/|tbb/|TBB_\w+))");
    static const std::regex kIntervals(
        R"(\b(CGAL/Interval_\w+|Interval_nt\w*|Protect_FPU_rounding|FPU_\w+|boost/numeric/interval|numeric::interval|mpfi\w*|fesetround)\b)");
    if (!starts_with(path, kParallel)) {
      check_words("threads", path, source, {kTbb}, "threads come through coxeter/base/parallel.h");
    }
    if (!starts_with(path, kInterval)) {
      check_words("interval", path, source, {kIntervals}, "intervals come through perturbation/interval.h");
    }
  }

  void check_formats(const std::string& path, const Source& source) {
    static const std::regex kWords(R"(\b(OpenMesh|nlohmann|[io]?fstream|fopen)\b)");
    static const std::regex kExtensions(R"re("[^"]*\.(off|noff|ply|obj|stl|vtu|mesh|pov|json|csv)")re");
    const std::string room = room_of(path);
    if (is_in_io(room) || path == kSystemFiles) return;
    check_words("format", path, source, {kWords}, "files and their formats belong in whitney/io");
    if (room != kCli)
      check_words("format", path, source, {kExtensions}, "files and their formats belong in whitney/io");
  }

  void check_words(const std::string& rule, const std::string& path, const Source& source,
                   const std::vector<std::regex>& patterns, const std::string& why) {
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      std::smatch match;
      for (const std::regex& pattern : patterns) {
        if (std::regex_search(source.lines[i], match, pattern)) report(rule, path, i + 1, match[1].str() + ": " + why);
      }
    }
  }

  /// Depth first; a file that is met again on the way to itself closes a cycle, reported once.
  void find_cycles(const std::string& path) {
    State& state = state_[path];
    if (state == State::kDone) return;
    if (state == State::kOpen) {
      std::string cycle;
      for (auto i = std::find(trail_.begin(), trail_.end(), path); i != trail_.end(); ++i) cycle += *i + " -> ";
      report("cycle", path, 1, "include cycle " + cycle + path);
      return;
    }
    state = State::kOpen;
    trail_.push_back(path);
    for (const Include& include : sources_.at(path).includes) {
      if (sources_.count(include.path) > 0) find_cycles(include.path);
    }
    trail_.pop_back();
    state_[path] = State::kDone;
  }

  enum class State { kNew, kOpen, kDone };

  inline static const std::regex kPrinting{
      R"(\b(iostream|ostream|istream|syncstream|cout|cerr|clog|cin|printf|fprintf|vprintf|puts|fputs|putchar|fputc|fwrite|perror|stdout|stderr)\b)"};

  std::map<std::string, Source> sources_;
  std::set<std::string> internal_;
  std::map<std::string, State> state_;
  std::vector<std::string> trail_;
  std::vector<Violation> violations_;
};

}  // namespace

std::string text(const Violation& violation) {
  return violation.path + ":" + std::to_string(violation.line) + ": " + violation.what + " [" + violation.rule + "]";
}

std::vector<Violation> check_architecture(const fs::path& root) { return Checker(root).run(); }

std::vector<Exception> read_exceptions(const fs::path& path) {
  std::vector<Exception> exceptions;
  std::ifstream stream(path);
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t bar = line.find(" | ");
    if (bar == std::string::npos || bar + 3 >= line.size()) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": no reason given");
    }
    exceptions.push_back({line.substr(0, bar), line.substr(bar + 3), number});
  }
  return exceptions;
}

std::vector<Violation> without_pending(const fs::path& root, std::vector<Violation> violations) {
  const std::string list = "tests/architecture/pending.txt";
  std::vector<Violation> stale;
  for (const Exception& pending : read_exceptions(root / list)) {
    const std::size_t removed =
        std::erase_if(violations, [&pending](const Violation& v) { return v.rule + " " + v.path == pending.name; });
    if (removed == 0) stale.push_back({"list", list, pending.line, "no longer needed: " + pending.name});
  }
  violations.insert(violations.end(), stale.begin(), stale.end());
  return violations;
}

}  // namespace whitney::architecture
