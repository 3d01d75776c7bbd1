// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <unistd.h>
#include <vector>

#include "architecture.h"

namespace whitney::architecture {

/// A tree of files in a folder of its own, which goes when this does.
class MadeTree {
 public:
  explicit MadeTree(const std::map<std::string, std::string>& files)
      : root_(std::filesystem::temp_directory_path() / ("whitney_tree_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(root_);
    for (const auto& [path, text] : files) {
      std::filesystem::create_directories((root_ / path).parent_path());
      std::ofstream(root_ / path) << text;
    }
  }
  MadeTree(const MadeTree&) = delete;
  MadeTree& operator=(const MadeTree&) = delete;
  ~MadeTree() { std::filesystem::remove_all(root_); }

  const std::filesystem::path& root() const { return root_; }

 private:
  std::filesystem::path root_;
};

inline std::vector<std::string> texts(const std::vector<Violation>& violations) {
  std::vector<std::string> lines;
  for (const Violation& violation : violations) lines.push_back(text(violation));
  return lines;
}

/// What the rules of the architecture say of a tree made of these files.
inline std::vector<std::string> check_tree(const std::map<std::string, std::string>& files) {
  return texts(check_architecture(MadeTree(files).root()));
}

}  // namespace whitney::architecture
