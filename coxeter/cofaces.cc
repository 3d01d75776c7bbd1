// SPDX-License-Identifier: GPL-3.0-or-later
#include <coxeter/cofaces.h>
#include <coxeter/error.h>

#include <algorithm>
#include <limits>
#include <string>

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
      num_parts_(simplex.dim() + 1),
      num_pieces_(static_cast<std::size_t>(checked_coface_dim(simplex, coface_dim)) + 1),
      coface_(SimplexWriter::resized(simplex, coface_dim + 1)),
      coface_out_(coface_) {
  const auto ends = simplex.partition().ends();
  std::size_t begin = 0, total = 0;
  for (int q = 0; q < num_parts_; ++q) {
    const std::size_t size = ends[static_cast<std::size_t>(q)] - begin;
    if (size > 1) {
      digits_.push_back({q, begin, size, 1, 0, 0, nullptr, nullptr});
      total += size;
    }
    begin += size;
  }
  storage_.resize_for_overwrite(2 * total);
  std::uint16_t* free = storage_.data();
  for (Digit& digit : digits_) {
    digit.labels = free;
    digit.lengths = free + digit.size;
    free += 2 * digit.size;
  }
  distribute(0, num_pieces_ - static_cast<std::size_t>(num_parts_));
}

/// Cuts the digits from first_digit on `extra` times, the last ones first.
void CofaceEnumeration::distribute(std::size_t first_digit, std::size_t extra) {
  for (std::size_t i = digits_.size(); i-- > first_digit;) {
    const std::size_t cuts = std::min(extra, digits_[i].size - 1);
    digits_[i].pieces = 1 + cuts;
    extra -= cuts;
  }
}

bool CofaceEnumeration::next_composition() {
  std::size_t extra = 0;  // cuts of the digits after i
  for (std::size_t i = digits_.size(); i-- > 0; extra += digits_[i].pieces - 1) {
    if (extra == 0 || digits_[i].pieces == digits_[i].size) continue;
    ++digits_[i].pieces;
    distribute(i + 1, extra - 1);
    return true;
  }
  return false;
}

void CofaceEnumeration::start_composition() {
  active_.clear();
  for (std::size_t i = 0; i < digits_.size(); ++i) {
    const Digit& digit = digits_[i];
    if (digit.pieces == 1) continue;
    active_.push_back(static_cast<std::uint16_t>(i));
    reset_lengths(digit.lengths, digit.pieces, digit.size);
    sort_labels(digit.labels, digit.lengths, digit.pieces);
  }
  unwrap();
  place_middle(0, 0);
  if (!active_.empty() && is_last(digits_[active_.back()])) {
    write_last(digits_[active_.back()]);
  } else {
    const auto elements = simplex_.partition().elements();
    const std::size_t begin = elements.size() - simplex_.partition().part(num_parts_ - 1).size();
    std::copy(elements.begin() + static_cast<std::ptrdiff_t>(begin), elements.end(), coface_out_.elements + begin);
    coface_out_.ends[num_pieces_ - 1] = static_cast<std::uint16_t>(elements.size());
  }
}

/// Writes all parts but the last, behind the pieces that have wrapped to the front.
void CofaceEnumeration::place_middle(std::size_t wrapped_elements, std::size_t wrapped_pieces) {
  wrapped_elements_ = wrapped_elements;
  wrapped_pieces_ = wrapped_pieces;
  const std::uint16_t* const ends = simplex_.partition().ends().data();
  const std::size_t last = static_cast<std::size_t>(num_parts_) - 1;
  if (last == 0) return;
  std::copy_n(simplex_.partition().elements().data(), ends[last - 1], coface_out_.elements + wrapped_elements);
  std::uint16_t* out = coface_out_.ends + wrapped_pieces;
  std::size_t part = 0;
  auto copy_ends = [&](std::size_t until) {
    for (; part < until; ++part) *out++ = static_cast<std::uint16_t>(ends[part] + wrapped_elements);
  };
  for (const auto i : active_) {
    Digit& digit = digits_[i];
    if (is_last(digit)) break;
    copy_ends(static_cast<std::size_t>(digit.part));
    digit.position = digit.begin + wrapped_elements;
    digit.index = static_cast<std::size_t>(out - coface_out_.ends);
    write(digit);
    out += digit.pieces;
    ++part;
  }
  copy_ends(last);
}

void CofaceEnumeration::write(const Digit& digit) {
  const std::uint16_t* const from = simplex_.partition().elements().data() + digit.begin;
  std::uint16_t* const ends = coface_out_.ends + digit.index;
  // A counting sort that turns the begins of the pieces into their ends.
  std::size_t position = digit.position;
  for (std::size_t t = 0; t < digit.pieces; position += digit.lengths[t], ++t)
    ends[t] = static_cast<std::uint16_t>(position);
  for (std::size_t i = 0; i < digit.size; ++i) coface_out_.elements[ends[digit.labels[i]]++] = from[i];
}

void CofaceEnumeration::write_last(const Digit& digit) {
  unwrap();
  const std::size_t front =
      digit.labels[digit.size - 1] + std::size_t{1};  // pieces that stay: element d is the largest
  const std::size_t wrapped_pieces = digit.pieces - front;
  std::size_t wrapped_elements = 0;
  for (std::size_t t = front; t < digit.pieces; ++t) wrapped_elements += digit.lengths[t];
  if (wrapped_elements != wrapped_elements_ || wrapped_pieces != wrapped_pieces_)
    place_middle(wrapped_elements, wrapped_pieces);

  const std::size_t n = digit.begin + digit.size;
  std::uint16_t* const wrapped_ends = coface_out_.ends;
  std::uint16_t* const stay_ends = coface_out_.ends + (num_pieces_ - front);
  std::size_t position = n - (digit.size - wrapped_elements);
  for (std::size_t t = 0; t < digit.pieces; position += digit.lengths[t], ++t) {
    if (t == front) position = 0;
    (t < front ? stay_ends[t] : wrapped_ends[t - front]) = static_cast<std::uint16_t>(position);
  }
  const std::uint16_t* const from = simplex_.partition().elements().data() + digit.begin;
  for (std::size_t i = 0; i < digit.size; ++i) {
    const std::size_t t = digit.labels[i];
    coface_out_.elements[(t < front ? stay_ends[t] : wrapped_ends[t - front])++] = from[i];
  }
  for (std::size_t i = 0; i < wrapped_elements; ++i) {
    auto& coordinate = coface_out_.base[coface_out_.elements[i]];
    if (coordinate == std::numeric_limits<std::int32_t>::min())
      throw LatticeOverflow("the base vertex of a coface leaves the range of int32");
    --coordinate;
  }
}

/// Moves the base vertex back to that of the simplex.
void CofaceEnumeration::unwrap() {
  for (std::size_t i = 0; i < wrapped_elements_; ++i) ++coface_out_.base[coface_out_.elements[i]];
}

bool CofaceEnumeration::advance_large(Digit& digit) {
  bool advanced = std::next_permutation(digit.labels, digit.labels + digit.size);
  if (!advanced && digit.pieces < digit.size) {
    advanced = next_lengths(digit.lengths, digit.pieces, digit.size);
    sort_labels(digit.labels, digit.lengths, digit.pieces);
  }
  if (!is_last(digit))
    write(digit);
  else if (advanced)
    write_last(digit);
  return advanced;
}

}  // namespace whitney::coxeter::detail
