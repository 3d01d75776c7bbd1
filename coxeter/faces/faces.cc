// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/faces/faces.h>

#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::coxeter::detail {
namespace {

int checked_face_dim(const Simplex& simplex, int face_dim) {
  if (face_dim < 0 || face_dim > simplex.dim())
    throw InvalidInput("face_dim must be in 0 .. " + std::to_string(simplex.dim()) + ", is " +
                       std::to_string(face_dim));
  return face_dim;
}

}  // namespace

FaceEnumeration::FaceEnumeration(const Simplex& simplex, int face_dim)
    : face_dim_(checked_face_dim(simplex, face_dim)),
      num_cuts_(simplex.dim()),
      num_elements_(simplex.partition().elements().size()),
      elements_(simplex.partition().elements().data()),
      ends_(simplex.partition().ends().data()),
      width_(num_elements_ <= kNarrow ? kNarrow
             : num_elements_ <= kWide ? kWide
                                      : 0),
      face_(SimplexWriter::resized(simplex, face_dim + 1, num_elements_ + width_)),
      out_(face_),
      row_stride_(num_cuts_ + 2) {
  out_.ends[face_dim] = static_cast<std::uint16_t>(num_elements_);
}

void FaceEnumeration::build_tails() {
  const auto n = static_cast<std::uint32_t>(num_elements_);
  tail_begin_.resize_for_overwrite(static_cast<std::size_t>(num_cuts_) + 1);
  std::uint32_t total = 0;
  for (int cut = num_cuts_; cut >= face_dim_; --cut) {
    tail_begin_[static_cast<std::size_t>(cut)] = total;
    total += n - ends_[cut - 1];
  }
  tails_.resize_for_overwrite(total);
  for (int cut = num_cuts_; cut >= face_dim_; --cut) {
    std::uint16_t* const tail = tails_.data() + tail_begin_[static_cast<std::size_t>(cut)];
    const std::size_t begin = part_begin(cut), end = ends_[cut];
    if (cut == num_cuts_) {
      std::copy(elements_ + begin, elements_ + end, tail);
    } else {
      std::copy_n(tails_.data() + tail_begin_[static_cast<std::size_t>(cut) + 1], num_elements_ - end, tail);
      for (std::size_t i = begin; i < end; ++i) insert(tail, num_elements_ - end + (i - begin), elements_[i]);
    }
  }
}

template <std::size_t kWidth>
void FaceEnumeration::build_rows() {
  // Behind their values the rows hold the largest number, so that inserting y into a row is one formula for all
  // entries: max(left neighbour, min(entry, y)).
  auto extend = [&](const std::uint16_t* from, int part, std::uint16_t* to) {
    std::size_t i = part_begin(part);
    std::uint16_t y = elements_[i];
    to[0] = std::min(from[0], y);
    for (std::size_t j = 1; j < kWidth; ++j) to[j] = std::max(from[j - 1], std::min(from[j], y));
    while (++i < ends_[part]) {
      y = elements_[i];
      for (std::size_t j = kWidth; --j > 0;) to[j] = std::max(to[j - 1], std::min(to[j], y));
      to[0] = std::min(to[0], y);
    }
  };
  const int num_parts = num_cuts_ + 1;
  if (rows_.empty()) {
    // One row more, the empty one, at the end.
    const auto size = static_cast<std::size_t>(num_parts * row_stride_ + 1) * kWidth;
    rows_.resize_for_overwrite(size);
    empty_row_ = rows_.data() + size - kWidth;
    std::fill_n(empty_row_, kWidth, std::numeric_limits<std::uint16_t>::max());
    // Only the last part changes with the turns, so all other blocks are built once; the short ones first, so that a
    // row has long been written when it is read.
    for (int length = 1; length <= num_cuts_ - face_dim_ + 1; ++length)
      for (int first = 0; first + length <= num_cuts_; ++first)
        extend(length == 1 ? empty_row_ : row(first, first + length - 1), first + length - 1,
               row(first, first + length));
  }
  for (int first = num_cuts_; first >= face_dim_; --first)
    extend(first == num_cuts_ ? empty_row_ : row(first + 1, num_parts), first, row(first, num_parts));
}

template void FaceEnumeration::build_rows<FaceEnumeration::kNarrow>();
template void FaceEnumeration::build_rows<FaceEnumeration::kWide>();

void FaceEnumeration::turn() {
  ++turn_;
  const std::size_t first = ends_[0];  // size of the part that moves from the front to the last part
  for (std::size_t i = 0; i < first; ++i) ++out_.base[elements_[i]];
  scratch_.assign(elements_, elements_ + first);
  if (turned_.empty()) turned_.resize_for_overwrite(num_elements_ + static_cast<std::size_t>(num_cuts_));
  std::uint16_t* const e = turned_.data();
  std::uint16_t* const ends = e + num_elements_;
  std::copy(elements_ + first, elements_ + num_elements_, e);
  --num_cuts_;
  for (int j = 0; j < num_cuts_; ++j) ends[j] = static_cast<std::uint16_t>(ends_[j + 1] - first);
  ends[num_cuts_] = static_cast<std::uint16_t>(num_elements_);
  const std::size_t last_begin = num_cuts_ == 0 ? 0 : ends[num_cuts_ - 1];
  for (std::size_t i = 0; i < first; ++i) insert(e + last_begin, num_elements_ - first - last_begin + i, scratch_[i]);
  elements_ = e;
  ends_ = ends;
  std::copy_n(e, num_elements_, out_.elements);
}

}  // namespace whitney::coxeter::detail
