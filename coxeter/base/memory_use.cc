// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/memory_use.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace whitney {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The number that a file begins with; nothing for "max" and files that are not there.
std::optional<std::uint64_t> number_in(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t value = 0;
  if (file >> value) return value;
  return std::nullopt;
}

/// What a memory group leaves, its own limit and those of all groups around it.
std::uint64_t left_by_group(std::string folder, const std::string& root, const char* limit, const char* used) {
  std::uint64_t left = kNoLimit;
  for (;;) {
    const auto most = number_in(folder + "/" + limit), now = number_in(folder + "/" + used);
    if (most && now) left = std::min(left, *most > *now ? *most - *now : 0);
    if (folder.size() <= root.size()) return left;
    folder = folder.substr(0, std::max(root.size(), folder.rfind('/')));
  }
}

std::uint64_t left_by_groups() {
  std::uint64_t left = kNoLimit;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    std::string path = line.substr(second + 1);
    if (path == "/") path.clear();
    if (controllers.empty())
      left = std::min(left, left_by_group("/sys/fs/cgroup" + path, "/sys/fs/cgroup", "memory.max", "memory.current"));
    if (("," + controllers + ",").find(",memory,") != std::string::npos)
      left = std::min(left, left_by_group("/sys/fs/cgroup/memory" + path, "/sys/fs/cgroup/memory",
                                          "memory.limit_in_bytes", "memory.usage_in_bytes"));
  }
  return left;
}

}  // namespace

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0, resident = 0;
  if (file >> pages >> resident) return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::uint64_t available_bytes() {
  std::uint64_t available = kNoLimit;
  std::ifstream file("/proc/meminfo");
  for (std::string name, unit; file >> name;) {
    std::uint64_t kilobytes = 0;
    if (name == "MemAvailable:" && file >> kilobytes) {
      available = kilobytes * 1024;
      break;
    }
    std::getline(file, unit);
  }
  return std::min(available, left_by_groups());
}

}  // namespace whitney
