// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace whitney {

/// A file that appears under its final name only when it is complete.
///
/// Everything goes to a temporary file in the same folder, which `commit` renames. Without `commit` (an exception, a
/// full disk) the temporary is removed and a file of that name that was there before stays as it was. A symbolic link
/// is followed; a device or a pipe (/dev/stdout) is written in place, since nothing can be renamed over it. All members
/// that write throw FileError naming the file and the system's reason.
class AtomicFile {
 public:
  /// Opens the temporary. Throws FileError (missing folder, no permission, the name of a folder).
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends text.
  void write(std::string_view text);
  /// Appends a number as text, in the shortest form that reads back as the same double.
  void write(double value);
  void write(std::uint64_t value);
  void write(char c) { write(std::string_view(&c, 1)); }

  /// Appends the bytes of numbers as they lie in memory.
  template <class T>
  void write_raw(std::span<const T> values) {
    write(std::string_view(reinterpret_cast<const char*>(values.data()), values.size_bytes()));
  }

  /// Writes what is buffered, closes and renames. Nothing may be written afterwards.
  void commit();

  const std::filesystem::path& path() const { return path_; }

 private:
  void flush();
  [[noreturn]] void fail(int error) const;

  std::filesystem::path path_;       ///< as the caller named it
  std::filesystem::path final_;      ///< behind symbolic links
  std::filesystem::path temporary_;  ///< empty once there is none to remove
  int descriptor_ = -1;
  std::string buffer_;
};

/// Writes a whole file at once: AtomicFile for short texts. Throws FileError.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace whitney
