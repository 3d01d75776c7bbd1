// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <coxeter/base/error.h>
#include <coxeter/base/run_control.h>
#include <whitney/cli/commands.h>
#include <whitney/problem/report.h>

// What the subcommands have in common.

namespace whitney::cli {

/// While one is alive, SIGINT and SIGTERM do not end the program but are remembered; a second one ends it.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  bool interrupted() const;
};

/// Prints how far a run has come, in one line that it writes over again.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  void show(const Progress& progress);
  void end();

 private:
  bool live_;
  double shown_ = 0;
};

/// The limits of the arguments; stops when the guard was interrupted. Both must outlive the run.
RunControl run_control(const LimitArguments& limits, const InterruptGuard& guard, ProgressLine& line);

MeshKind mesh_kind(const std::string& word);
TopologyLevel topology_level(const std::string& word);

/// Prints "written: FILE" for each that was, then throws FileError with what failed, if anything did.
void finish_files(const std::vector<std::string>& written, const std::vector<std::string>& failed, bool quiet);

/// `files` without empty names and without those that a line of `failed` is about.
std::vector<std::string> without_failed(const std::vector<std::string>& files, const std::vector<std::string>& failed);

/// Calls `work`; its InvalidInput gets the file in front.
template <class Work>
auto with_file(const std::string& file, Work work) {
  try {
    return work();
  } catch (const InvalidInput& error) {
    throw InvalidInput(file + ": " + error.what());
  }
}

}  // namespace whitney::cli
