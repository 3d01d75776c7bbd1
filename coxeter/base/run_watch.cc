// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/run_watch.h>

#include <limits>

#include <coxeter/base/memory_use.h>

namespace whitney {
namespace {

constexpr std::uint64_t kNoMemoryLimit = std::numeric_limits<std::uint64_t>::max();
/// To ask the system for the memory in use takes some 10 us.
constexpr double kSecondsBetweenMemory = 0.01;

}  // namespace

RunWatch::RunWatch(const RunControl& run, const char* phase)
    : run_(run),
      phase_(phase),
      is_watching_(run.time_limit < std::numeric_limits<double>::infinity() || run.memory_limit != kNoMemoryLimit ||
                   run.progress) {}

double RunWatch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool RunWatch::fits(std::uint64_t bytes) {
  if (reason_ != StopReason::kNone) return false;
  if (run_.memory_limit == kNoMemoryLimit) return true;
  const std::uint64_t used = resident_bytes();
  if (used <= run_.memory_limit && bytes <= run_.memory_limit - used) return true;
  reason_ = StopReason::kMemoryLimit;
  return false;
}

bool RunWatch::look(std::size_t simplices, std::size_t evaluations) {
  const double now = seconds();
  if (now > run_.time_limit) {
    reason_ = StopReason::kTimeLimit;
  } else if (run_.progress && !run_.progress({phase_, simplices, evaluations, now})) {
    reason_ = StopReason::kCancelled;
  } else if (now - memory_asked_ >= kSecondsBetweenMemory) {
    memory_asked_ = now;
    fits(0);
  }
  return reason_ != StopReason::kNone;
}

}  // namespace whitney
