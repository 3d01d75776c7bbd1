// SPDX-License-Identifier: GPL-3.0-or-later
#include "architecture.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace whitney::architecture {
namespace fs = std::filesystem;

namespace {

/// The layers, lowest first. A file belongs to the last one whose prefix fits.
constexpr std::array<const char*, 5> kLayers = {"coxeter/", "perturbation/", "whitney/", "whitney/io/", "whitney/cli/"};
constexpr std::size_t kIo = 3, kCli = 4;

bool starts_with(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

/// The layer of a path relative to the root, or kLayers.size() if it is not ours.
std::size_t layer_of(const std::string& path) {
  std::size_t layer = kLayers.size();
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    if (starts_with(path, kLayers[i])) layer = i;
  }
  return layer;
}

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
  }

  std::vector<Violation> run() {
    for (const auto& [path, source] : sources_) {
      check_includes(path, source);
      if (layer_of(path) < kIo) check_formats(path, source);
    }
    for (const auto& [path, source] : sources_) find_cycles(path);
    std::sort(violations_.begin(), violations_.end());
    return violations_;
  }

 private:
  void report(const std::string& path, std::size_t line, const std::string& what) {
    violations_.push_back(path + ":" + std::to_string(line) + ": " + what);
  }

  void check_includes(const std::string& path, const Source& source) {
    const std::size_t layer = layer_of(path);
    const bool public_header = fs::path(path).extension() == ".h" && layer != kCli;
    for (const Include& include : source.includes) {
      const std::size_t target = layer_of(include.path);
      if (target < kLayers.size() && target > layer) {
        report(path, include.line, "upward include of " + include.path);
      }
      if (starts_with(include.path, "whitney/io/internal/") && layer != kIo) {
        report(path, include.line, "include of " + include.path + ", which is internal to whitney/io");
      }
      for (const char* library : {"CGAL/", "ginac/", "OpenMesh/", "nlohmann/"}) {
        if (public_header && starts_with(include.path, library)) {
          report(path, include.line, "a public header includes " + include.path);
        }
      }
    }
  }

  void check_formats(const std::string& path, const Source& source) {
    static const std::regex kWords(R"(\b(OpenMesh|nlohmann|[io]?fstream|fopen)\b)");
    static const std::regex kExtensions(R"re("[^"]*\.(off|noff|ply|obj|stl|vtu|mesh|pov|json|csv)")re");
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      std::smatch match;
      for (const auto& pattern : {kWords, kExtensions}) {
        if (std::regex_search(source.lines[i], match, pattern)) {
          report(path, i + 1, match[1].str() + ": files and their formats belong in whitney/io");
        }
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
      report(path, 1, "include cycle " + cycle + path);
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

  std::map<std::string, Source> sources_;
  std::map<std::string, State> state_;
  std::vector<std::string> trail_;
  std::vector<Violation> violations_;
};

}  // namespace

std::string without_comments(const std::string& text) {
  std::string code;
  code.reserve(text.size());
  const auto at = [&text](std::size_t i) { return i < text.size() ? text[i] : '\0'; };
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '/' && at(i + 1) == '/') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (c == '/' && at(i + 1) == '*') {
      for (i += 2; i < text.size() && !(text[i] == '*' && at(i + 1) == '/'); ++i) code += text[i] == '\n' ? '\n' : ' ';
      i += 2;
    } else if (c == 'R' && at(i + 1) == '"') {
      const std::size_t open = text.find('(', i);
      if (open == std::string::npos) return code;
      std::string close(1, ')');
      close.append(text, i + 2, open - i - 2).append(1, '"');
      const std::size_t end = std::min(text.find(close, open), text.size() - close.size()) + close.size();
      code.append(text, i, end - i);
      i = end;
    } else if (c == '"' || (c == '\'' && !(i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))) {
      code += text[i++];
      while (i < text.size() && text[i] != c && text[i] != '\n') {
        if (text[i] == '\\' && at(i + 1) != '\n') code += text[i++];
        if (i < text.size()) code += text[i++];
      }
      if (at(i) == c) code += text[i++];
    } else {
      code += text[i++];
    }
  }
  return code;
}

std::vector<Violation> check_architecture(const fs::path& root) { return Checker(root).run(); }

}  // namespace whitney::architecture
