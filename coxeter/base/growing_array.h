// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

namespace whitney::coxeter {

namespace detail {

/// realloc for blocks whose size the caller knows. Large blocks come from the system page by page and grow by remapping
/// where the system can. bytes = 0 frees. Throws std::bad_alloc.
void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes);

}  // namespace detail

/// A contiguous array of trivially copyable values that grows in place of being copied.
///
/// Why not std::vector: growing a large block neither copies nor holds two copies at once, and pages never touched cost
/// nothing. Peak memory is what is stored.
template <class T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  GrowingArray() = default;
  GrowingArray(GrowingArray&& other) noexcept { swap(other); }
  GrowingArray& operator=(GrowingArray&& other) noexcept {
    GrowingArray(std::move(other)).swap(*this);
    return *this;
  }
  GrowingArray(const GrowingArray& other) { append(other.data_, other.size_); }
  GrowingArray& operator=(const GrowingArray& other) {
    GrowingArray(other).swap(*this);
    return *this;
  }
  ~GrowingArray() { detail::resize_block(data_, capacity_ * sizeof(T), 0); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  operator std::span<const T>() const { return {data_, size_}; }

  /// Appends `count` values that are not initialised and returns the first.
  T* extend(std::size_t count) {
    if (size_ + count > capacity_) reserve(grown(size_ + count));
    T* first = data_ + size_;
    size_ += count;
    return first;
  }
  void push_back(T value) { *extend(1) = value; }
  void append(const T* values, std::size_t count) {
    if (count != 0) std::memcpy(extend(count), values, count * sizeof(T));
  }
  void resize(std::size_t size, T value) {
    const std::size_t old = size_;
    if (size > old) {
      extend(size - old);
      for (std::size_t i = old; i < size; ++i) data_[i] = value;
    }
    size_ = size;
  }
  /// Gives the end back: size <= size().
  void truncate(std::size_t size) { size_ = size; }
  void clear() { size_ = 0; }
  void release() { GrowingArray().swap(*this); }

  void reserve(std::size_t capacity) {
    if (capacity <= capacity_) return;
    data_ = static_cast<T*>(detail::resize_block(data_, capacity_ * sizeof(T), capacity * sizeof(T)));
    capacity_ = capacity;
  }

  void swap(GrowingArray& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

 private:
  std::size_t grown(std::size_t at_least) const {
    const std::size_t doubled = capacity_ < 16 ? 16 : 2 * capacity_;
    return doubled < at_least ? at_least : doubled;
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace whitney::coxeter
