// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/read_file.h>

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include <coxeter/base/error.h>

namespace whitney {

std::string read_file(const std::filesystem::path& path) {
  const auto fail = [&path](int error) {
    throw FileError("cannot read " + path.string() + ": " + std::generic_category().message(error));
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(errno);
  std::string bytes;
  std::string part(std::size_t{1} << 20, '\0');
  for (;;) {
    const ssize_t n = ::read(descriptor, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      ::close(descriptor);
      fail(error);
    }
    if (n == 0) break;
    bytes.append(part, 0, static_cast<std::size_t>(n));
  }
  ::close(descriptor);
  return bytes;
}

}  // namespace whitney
