// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/base/growing_array.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace whitney::coxeter::detail {

#ifdef __linux__

namespace {
// The C library would do the same, but raises its own threshold to 32 MiB as soon as a large block has been freed.
constexpr std::size_t kLarge = std::size_t{1} << 18;
}  // namespace

void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes) {
  const bool was_large = old_bytes >= kLarge, is_large = bytes >= kLarge;
  if (bytes == 0) {
    if (was_large)
      munmap(block, old_bytes);
    else
      std::free(block);
    return nullptr;
  }
  if (!was_large && !is_large) {
    void* moved = std::realloc(block, bytes);
    if (moved == nullptr) throw std::bad_alloc();
    return moved;
  }
  if (was_large && is_large) {
    void* moved = mremap(block, old_bytes, bytes, MREMAP_MAYMOVE);
    if (moved == MAP_FAILED) throw std::bad_alloc();
    return moved;
  }
  void* moved =
      is_large ? mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) : std::malloc(bytes);
  if (moved == nullptr || moved == MAP_FAILED) throw std::bad_alloc();
  if (block != nullptr) std::memcpy(moved, block, std::min(old_bytes, bytes));
  resize_block(block, old_bytes, 0);
  return moved;
}

#else

void* resize_block(void* block, std::size_t, std::size_t bytes) {
  if (bytes == 0) {
    std::free(block);
    return nullptr;
  }
  void* moved = std::realloc(block, bytes);
  if (moved == nullptr) throw std::bad_alloc();
  return moved;
}

#endif

}  // namespace whitney::coxeter::detail
