// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <type_traits>
#include <utility>

namespace whitney::coxeter {

/// An array of plain values, its size chosen at run time; up to N of them are stored in place, more on the heap.
template <class T, std::size_t N>
class InlineArray {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_default_constructible_v<T>);

 public:
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  InlineArray() = default;
  /// `size` values that are left unset.
  explicit InlineArray(std::size_t size) { resize_for_overwrite(size); }
  InlineArray(std::size_t size, const T& value) : InlineArray(size) { std::fill_n(data(), size, value); }
  InlineArray(const T* first, const T* last) { assign(first, last); }
  InlineArray(std::initializer_list<T> values) { assign(values.begin(), values.end()); }
  InlineArray(const InlineArray& other) { *this = other; }
  InlineArray(InlineArray&& other) noexcept { *this = std::move(other); }
  InlineArray& operator=(const InlineArray& other) {
    if (this == &other) return *this;
    if (kCopiesWhole && !owns_memory() && !other.owns_memory()) {
      copy_in_place(other);
    } else {
      assign(other.begin(), other.end());
    }
    return *this;
  }
  InlineArray& operator=(InlineArray&& other) noexcept {
    if (this == &other) return *this;
    place_.size = other.place_.size;
    capacity_ = other.capacity_;
    heap_ = std::move(other.heap_);
    if (!heap_) {
      if constexpr (kCopiesWhole)
        std::memcpy(place_.values, other.place_.values, sizeof place_.values);
      else
        copy(other.place_.values, other.place_.values + place_.size, place_.values);
    }
    other.place_.size = 0;
    other.capacity_ = N;
    return *this;
  }

  std::size_t size() const { return place_.size; }
  bool empty() const { return place_.size == 0; }
  /// Whether the values are, or were when there were more of them, on the heap.
  bool owns_memory() const { return heap_ != nullptr; }
  T* data() { return heap_ ? heap_.get() : place_.values; }
  const T* data() const { return heap_ ? heap_.get() : place_.values; }
  T* begin() { return data(); }
  T* end() { return data() + place_.size; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + place_.size; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T& back() { return data()[place_.size - 1]; }
  const T& back() const { return data()[place_.size - 1]; }

  /// Changes the size; all values are unset afterwards.
  void resize_for_overwrite(std::size_t size) {
    if (size > capacity_) {
      heap_ = std::make_unique_for_overwrite<T[]>(size);
      capacity_ = size;
    }
    place_.size = size;
  }
  /// The range must not lie in this array.
  [[gnu::noinline]] void assign(const T* first, const T* last) {
    resize_for_overwrite(static_cast<std::size_t>(last - first));
    copy(first, last, data());
  }
  /// Assignment where neither array owns memory: a few instructions without a branch.
  void copy_in_place(const InlineArray& other) { place_ = other.place_; }
  void clear() { place_.size = 0; }
  /// Keeps the first `size` values; size must not exceed size().
  void truncate(std::size_t size) { place_.size = size; }
  void push_back(const T& value) {
    if (place_.size == capacity_) grow();
    data()[place_.size++] = value;
  }

  friend bool operator==(const InlineArray& a, const InlineArray& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  // A copy of fixed size is a few instructions, whatever it holds.
  static constexpr bool kCopiesWhole = N * sizeof(T) <= 128;

  static void copy(const T* first, const T* last, T* to) {
    if (first != last) std::memcpy(to, first, static_cast<std::size_t>(last - first) * sizeof(T));
  }

  void grow() {
    auto larger = std::make_unique_for_overwrite<T[]>(2 * capacity_);
    copy(data(), data() + place_.size, larger.get());
    heap_ = std::move(larger);
    capacity_ *= 2;
  }

  struct Place {
    T values[N];
    std::size_t size = 0;
  };

  Place place_;  // first: as well aligned as the array
  std::size_t capacity_ = N;
  std::unique_ptr<T[]> heap_;  // empty while the values are in place
};

}  // namespace whitney::coxeter
