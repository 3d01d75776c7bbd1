// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/budget.h>

#include <algorithm>
#include <utility>

#include <coxeter/base/memory_use.h>

namespace whitney {

Budget::Budget(RunControl run) : run_(std::move(run)), begin_(std::chrono::steady_clock::now()), lap_(begin_) {}

double Budget::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

void Budget::lap(std::map<std::string, double>& seconds, const std::string& phase) {
  const auto now = std::chrono::steady_clock::now();
  seconds[phase] += std::chrono::duration<double>(now - lap_).count();
  lap_ = now;
}

bool Budget::spent(const char* phase) {
  if (stopped()) return true;
  const double now = seconds();
  if (now >= run_.time_limit)
    stop_reason_ = StopReason::kTimeLimit;
  else if (run_.progress && !run_.progress({phase, 0, 0, now}))
    stop_reason_ = StopReason::kCancelled;
  return stopped();
}

void Budget::leave_out(const std::string& what, StopReason reason, std::uint64_t bytes) {
  left_out_.push_back({what, reason, bytes});
  if (!stopped()) stop_reason_ = reason;
}

bool Budget::fits(const std::string& what, std::uint64_t bytes) {
  const std::uint64_t used = resident_bytes();
  if (used <= run_.memory_limit && bytes <= run_.memory_limit - used) return true;
  leave_out(what, StopReason::kMemoryLimit, bytes);
  return false;
}

bool Budget::allows(const std::string& what, std::uint64_t bytes) {
  if (!fits(what, bytes)) return false;
  const bool go_on = stop_reason_ == StopReason::kMaxSimplices || stop_reason_ == StopReason::kMemoryLimit;
  const StopReason before = std::exchange(stop_reason_, go_on ? StopReason::kNone : stop_reason_);
  const bool late = spent(what.c_str());
  if (late) left_out_.push_back({what, stop_reason_, 0});
  if (go_on) stop_reason_ = before;
  return !late;
}

bool Budget::halve() {
  run_.max_simplices = std::min(run_.max_simplices, simplices_) / 2;
  stop_reason_ = StopReason::kMemoryLimit;
  return run_.max_simplices > 0;
}

RunControl Budget::rest(std::size_t found_before, double bytes_per_simplex) {
  RunControl rest = run_;
  rest.max_simplices = run_.max_simplices - std::min(run_.max_simplices, found_before);
  const double used = seconds();
  rest.time_limit = run_.time_limit - used;
  memory_asked_ = -1;
  rest.progress = [this, found_before, bytes_per_simplex, used](const Progress& progress) {
    simplices_ = found_before + progress.simplices;
    constexpr double kAskEvery = 0.02;
    if (run_.memory_limit != RunControl{}.memory_limit &&
        (memory_asked_ < 0 || progress.seconds > memory_asked_ + kAskEvery)) {
      memory_asked_ = progress.seconds;
      const double later = bytes_per_simplex * static_cast<double>(progress.simplices);
      if (static_cast<double>(resident_bytes()) + later > static_cast<double>(run_.memory_limit)) {
        memory_is_up_ = true;
        return false;
      }
    }
    if (!run_.progress) return true;
    Progress all = progress;
    all.simplices += found_before;
    all.seconds += used;
    return run_.progress(all);
  };
  return rest;
}

StopReason Budget::ended(StopReason reason) {
  if (reason == StopReason::kCancelled && memory_is_up_) reason = StopReason::kMemoryLimit;
  if (!stopped() && reason != StopReason::kNone) stop_reason_ = reason;
  return reason;
}

}  // namespace whitney
