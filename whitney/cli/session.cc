// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/cli/session.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <unistd.h>

#include <coxeter/base/memory_use.h>

namespace whitney::cli {
namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

void on_signal(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_seen = 0;
  on_signal([](int) { interrupt_seen = 1; }, static_cast<int>(SA_RESTART | SA_RESETHAND));
}

InterruptGuard::~InterruptGuard() { on_signal(SIG_DFL, 0); }

bool InterruptGuard::interrupted() const { return interrupt_seen != 0; }

ProgressLine::ProgressLine(bool quiet) : live_(!quiet && isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& progress) {
  if (!live_ || (progress.seconds <= shown_ + 0.5 && progress.seconds >= shown_)) return;
  shown_ = progress.seconds;
  std::fprintf(stderr, "\r%s: %zu simplices, %.0f s ", progress.phase, progress.simplices, progress.seconds);
}

void ProgressLine::end() {
  if (live_ && shown_ > 0) std::fprintf(stderr, "\n");
  shown_ = 0;
}

RunControl run_control(const LimitArguments& limits, const InterruptGuard& guard, ProgressLine& line) {
  RunControl run;
  run.max_simplices = limits.max_simplices;
  run.time_limit = limits.time_limit;
  const std::uint64_t free = available_bytes(), all = RunControl{}.memory_limit;
  run.memory_limit = limits.memory_limit             ? *limits.memory_limit
                     : free < all - resident_bytes() ? free + resident_bytes()
                                                     : all;
  run.progress = [&guard, &line](const Progress& progress) {
    line.show(progress);
    return !guard.interrupted();
  };
  return run;
}

MeshKind mesh_kind(const std::string& word) {
  return word == "pulled" ? MeshKind::kPulled : word == "cells" ? MeshKind::kCells : MeshKind::kBarycentric;
}

TopologyLevel topology_level(const std::string& word) {
  return word == "none" ? TopologyLevel::kNone : word == "euler" ? TopologyLevel::kEuler : TopologyLevel::kFull;
}

std::vector<std::string> without_failed(const std::vector<std::string>& files, const std::vector<std::string>& failed) {
  std::vector<std::string> good;
  for (const std::string& file : files)
    if (!file.empty() && std::none_of(failed.begin(), failed.end(), [&](const std::string& line) {
          return line.find(file + ":") != std::string::npos;
        }))
      good.push_back(file);
  return good;
}

void finish_files(const std::vector<std::string>& written, const std::vector<std::string>& failed, bool quiet) {
  if (!quiet)
    for (const std::string& file : written) std::cout << "written: " << file << "\n";
  std::cout.flush();
  if (failed.empty()) return;
  std::string text;
  for (const std::string& line : failed) text += (text.empty() ? "" : "\n") + line;
  throw FileError(text);
}

}  // namespace whitney::cli
