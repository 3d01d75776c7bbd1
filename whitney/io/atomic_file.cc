// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/io/atomic_file.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <coxeter/base/error.h>

namespace whitney {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
constexpr int kTemporaryNames = 1000;

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), final_(path_) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(final_, error); ++links) {
    const fs::path target = fs::read_symlink(final_, error);
    if (error) break;
    final_ = target.is_absolute() ? target : final_.parent_path() / target;
  }
  const fs::file_status status = fs::status(final_, error);
  if (fs::is_directory(status)) fail(EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    descriptor_ = ::open(final_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
  } else {
    if (final_.filename().empty()) fail(ENOENT);
    const std::string stem = ".whitney-" + std::to_string(::getpid()) + "-";
    for (int i = 0; descriptor_ < 0; ++i) {
      temporary_ = final_.parent_path() / (stem + std::to_string(i) + ".tmp");
      descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0) break;
      if (errno != EEXIST || i == kTemporaryNames) fail(errno);
    }
    // A file that is replaced keeps its permissions.
    if (fs::is_regular_file(status)) ::fchmod(descriptor_, static_cast<mode_t>(status.permissions()) & 07777);
  }
  buffer_.reserve(kBufferBytes);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::fail(int error) const {
  throw FileError("cannot write " + path_.string() + ": " + std::generic_category().message(error));
}

void AtomicFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void AtomicFile::write(std::string_view text) {
  while (!text.empty()) {
    if (buffer_.size() == kBufferBytes) flush();
    const std::string_view part = text.substr(0, kBufferBytes - buffer_.size());
    buffer_.append(part);
    text.remove_prefix(part.size());
  }
}

void AtomicFile::write(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  write(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

void AtomicFile::write(std::uint64_t value) {
  std::array<char, 24> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  write(std::string_view(text.data(), static_cast<std::size_t>(end - text.data())));
}

void AtomicFile::commit() {
  flush();
  const int descriptor = descriptor_;
  descriptor_ = -1;
  if (::close(descriptor) != 0) fail(errno);  // network file systems report a full disk only here
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), final_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void write_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace whitney
