// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/faces/cofaces.h>

#include <algorithm>
#include <limits>
#include <string>

#include <coxeter/base/error.h>

namespace whitney::coxeter::detail {
namespace {

int checked_coface_dim(const Simplex& simplex, int coface_dim) {
  if (coface_dim < simplex.dim() || coface_dim > simplex.ambient_dim())
    throw InvalidInput("coface_dim must be in " + std::to_string(simplex.dim()) + " .. " +
                       std::to_string(simplex.ambient_dim()) + ", is " + std::to_string(coface_dim));
  return coface_dim;
}

/// The pieces in order, the elements of each in order: the first of the arrangements with these lengths.
void sort_labels(std::uint16_t* labels, const std::uint16_t* lengths, std::size_t pieces) {
  for (std::size_t t = 0; t < pieces; ++t) labels = std::fill_n(labels, lengths[t], static_cast<std::uint16_t>(t));
}

/// The lexicographically least sequence of positive lengths with this total.
void reset_lengths(std::uint16_t* lengths, std::size_t pieces, std::size_t total) {
  std::fill_n(lengths, pieces - 1, std::uint16_t{1});
  lengths[pieces - 1] = static_cast<std::uint16_t>(total - (pieces - 1));
}

/// The lexicographically next one; after the last, the first again, and the result is false.
bool next_lengths(std::uint16_t* lengths, std::size_t pieces, std::size_t total) {
  std::size_t tail = lengths[pieces - 1];  // sum of the lengths from i + 1 on
  for (std::size_t i = pieces - 1; i-- > 0; tail += lengths[i]) {
    if (tail == pieces - 1 - i) continue;
    ++lengths[i];
    reset_lengths(lengths + i + 1, pieces - 1 - i, tail - 1);
    return true;
  }
  reset_lengths(lengths, pieces, total);
  return false;
}

}  // namespace

CofaceEnumeration::CofaceEnumeration(const Simplex& simplex, int coface_dim)
    : simplex_(simplex),
      num_pieces_(static_cast<std::size_t>(checked_coface_dim(simplex, coface_dim)) + 1),
      coface_(SimplexWriter::resized(simplex, coface_dim + 1)),
      out_(coface_) {
  const auto ends = simplex.partition().ends();
  std::size_t begin = 0, total = 0;
  for (std::size_t q = 0; q < ends.size(); ++q) {
    const std::size_t size = ends[q] - begin;
    if (size > 1 || q + 1 == ends.size()) {
      parts_.push_back({q, begin, size, 1});
      total += size;
    }
    begin += size;
  }
  storage_.resize_for_overwrite(2 * total + 2 * parts_.back().size);
  mask_ = storage_.data() + 2 * total;
  last_ = mask_ + parts_.back().size;
  distribute(0, num_pieces_ - ends.size());
}

/// Cuts the parts from first_part on `extra` times, the last ones first.
void CofaceEnumeration::distribute(std::size_t first_part, std::size_t extra) {
  for (std::size_t i = parts_.size(); i-- > first_part;) {
    const std::size_t cuts = std::min(extra, parts_[i].size - 1);
    parts_[i].pieces = 1 + cuts;
    extra -= cuts;
  }
}

bool CofaceEnumeration::next_composition() {
  std::size_t extra = 0;  // cuts of the parts after i
  for (std::size_t i = parts_.size(); i-- > 0; extra += parts_[i].pieces - 1) {
    if (extra == 0 || parts_[i].pieces == parts_[i].size) continue;
    ++parts_[i].pieces;
    distribute(i + 1, extra - 1);
    return true;
  }
  return false;
}

void CofaceEnumeration::start_composition() {
  unwrap();
  wrapped_ = wrapped_pieces_ = 0;
  std::fill_n(mask_, parts_.back().size - 1, std::uint16_t{0});
  apply_wrap(true);
}

/// The next choice of what wraps: by the number of pieces, then the number of elements, then the elements.
bool CofaceEnumeration::next_wrap() {
  const Part& last = parts_.back();
  const std::size_t others = last.size - 1;
  if (std::next_permutation(mask_, mask_ + others)) {
    unwrap();
    apply_wrap(false);
    return true;
  }
  const std::size_t most = wrapped_pieces_ == 0 ? 0 : last.size - (last.pieces - wrapped_pieces_);
  const bool more_elements = wrapped_ < most;
  if (!more_elements && wrapped_pieces_ + 1 == last.pieces) return false;
  unwrap();
  if (more_elements)
    ++wrapped_;
  else
    wrapped_ = ++wrapped_pieces_;
  std::fill_n(mask_, others, std::uint16_t{0});
  std::fill_n(mask_ + (others - wrapped_), wrapped_, std::uint16_t{1});
  apply_wrap(true);
  return true;
}

/// Puts all digits into their first states; others_move says whether the parts but the last changed their places, too.
void CofaceEnumeration::apply_wrap(bool others_move) {
  const Part& last = parts_.back();
  const std::uint16_t* const from = simplex_.partition().elements().data() + last.begin;
  std::uint16_t *wraps = last_, *stays = last_ + wrapped_;
  for (std::size_t i = 0; i + 1 < last.size; ++i) *(mask_[i] ? wraps : stays)++ = from[i];
  *stays = from[last.size - 1];  // element d is the largest
  if (others_move) place_others();
  place_last();
  for (std::size_t i = 0; i < wrapped_; ++i) {
    auto& coordinate = out_.base[last_[i]];
    if (coordinate == std::numeric_limits<std::int32_t>::min())
      throw LatticeOverflow("the base vertex of a coface leaves the range of int32");
    --coordinate;
  }
}

/// Moves the base vertex back to that of the simplex.
void CofaceEnumeration::unwrap() {
  for (std::size_t i = 0; i < wrapped_; ++i) ++out_.base[last_[i]];
}

void CofaceEnumeration::place_others() {
  digits_.clear();
  const std::uint16_t* const elements = simplex_.partition().elements().data();
  const std::uint16_t* const ends = simplex_.partition().ends().data();
  std::copy_n(elements, parts_.back().begin, out_.elements + wrapped_);
  std::uint16_t* out = out_.ends + wrapped_pieces_;
  std::size_t part = 0;
  auto copy_ends = [&](std::size_t until) {
    for (; part < until; ++part) *out++ = static_cast<std::uint16_t>(ends[part] + wrapped_);
  };
  std::uint16_t* storage = storage_.data();
  for (std::size_t i = 0; i + 1 < parts_.size(); ++i) {
    const Part& p = parts_[i];
    if (p.pieces > 1) {
      copy_ends(p.index);
      add_digit(elements + p.begin, p.size, false, p.pieces, out_.elements + p.begin + wrapped_, out, storage);
      out += p.pieces;
      ++part;
    }
    storage += 2 * p.size;
  }
  copy_ends(parts_.back().index);
  num_other_digits_ = digits_.size();
}

void CofaceEnumeration::place_last() {
  const Part& last = parts_.back();
  const std::size_t stay = last.size - wrapped_, stay_pieces = last.pieces - wrapped_pieces_;
  std::uint16_t* const storage = mask_ - 2 * last.size;
  std::uint16_t* const out = out_.elements + last.begin + wrapped_;
  for (std::size_t i = 0; i < wrapped_; ++i) out_.elements[i] = last_[i];
  for (std::size_t i = 0; i < stay; ++i) out[i] = last_[wrapped_ + i];
  if (wrapped_pieces_ == 1) out_.ends[0] = static_cast<std::uint16_t>(wrapped_);
  out_.ends[num_pieces_ - 1] = static_cast<std::uint16_t>(last.begin + last.size);
  digits_.truncate(num_other_digits_);
  if (wrapped_pieces_ > 1) add_digit(last_, wrapped_, false, wrapped_pieces_, out_.elements, out_.ends, storage);
  if (stay_pieces > 1)
    add_digit(last_ + wrapped_, stay, true, stay_pieces, out, out_.ends + (num_pieces_ - stay_pieces),
              storage + 2 * wrapped_);
}

/// Adds a digit in its first state: the elements in order, which the caller has written, in the first choice of
/// lengths.
void CofaceEnumeration::add_digit(const std::uint16_t* from, std::size_t size, bool pinned, std::size_t pieces,
                                  std::uint16_t* out, std::uint16_t* ends, std::uint16_t* storage) {
  const Digit digit{from, size, pinned ? size - 1 : size, pieces, out, ends, storage, storage + size};
  digits_.push_back(digit);
  auto position = static_cast<std::uint16_t>(out - out_.elements);
  if (pieces < size) {
    reset_lengths(digit.lengths, pieces, size);
    sort_labels(digit.labels, digit.lengths, pieces);
    for (std::size_t t = 0; t < pieces; ++t)
      ends[t] = position = static_cast<std::uint16_t>(position + digit.lengths[t]);
  } else {
    for (std::size_t t = 0; t < pieces; ++t) ends[t] = ++position;
  }
}

bool CofaceEnumeration::advance_uneven(Digit& digit) {
  bool advanced = std::next_permutation(digit.labels, digit.labels + digit.free);
  if (!advanced) {
    advanced = next_lengths(digit.lengths, digit.pieces, digit.size);
    sort_labels(digit.labels, digit.lengths, digit.pieces);
  }
  // A counting sort: it turns the begins of the pieces into their ends.
  std::uint16_t* const ends = digit.ends;
  auto position = static_cast<std::uint16_t>(ends[digit.pieces - 1] - digit.size);
  std::uint16_t* const elements = digit.out - position;
  for (std::size_t t = 0; t < digit.pieces; ++t) {
    ends[t] = position;
    position = static_cast<std::uint16_t>(position + digit.lengths[t]);
  }
  for (std::size_t i = 0; i < digit.size; ++i) elements[ends[digit.labels[i]]++] = digit.from[i];
  return advanced;
}

}  // namespace whitney::coxeter::detail
