// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/construction/phase_watch.h>

#include <limits>

#include <coxeter/base/memory_use.h>

namespace whitney {
namespace {

constexpr double kAskEvery = 0.02;  // seconds

}  // namespace

double PhaseWatch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool PhaseWatch::memory_is_short(std::uint64_t bytes) const {
  if (run_.memory_limit == std::numeric_limits<std::uint64_t>::max()) return false;
  const std::uint64_t used = resident_bytes();
  return used > run_.memory_limit || bytes > run_.memory_limit - used;
}

void PhaseWatch::stop(StopReason reason) {
  if (!stopped()) reason_ = reason;
}

bool PhaseWatch::fits(std::uint64_t bytes) {
  if (!memory_is_short(bytes)) return true;
  stop(StopReason::kMemoryLimit);
  return false;
}

bool PhaseWatch::keep_going(const char* phase, std::size_t simplices, std::size_t evaluations,
                            std::uint64_t bytes_to_come) {
  if (stopped()) return false;
  const double now = seconds();
  if (now > run_.time_limit) {
    stop(StopReason::kTimeLimit);
  } else if (memory_asked_ < 0 || now > memory_asked_ + kAskEvery) {
    memory_asked_ = now;
    fits(bytes_to_come);
  }
  if (!stopped() && run_.progress && !run_.progress({phase, simplices, evaluations, now})) stop(StopReason::kCancelled);
  return !stopped();
}

}  // namespace whitney
