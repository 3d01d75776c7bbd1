// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/topology/incidence.h>

namespace whitney {

Incidence empty_lists(std::size_t size) {
  Incidence out;
  out.offset.assign(size + 1, 0);
  return out;
}

Incidence transposed(const Incidence& incidence, std::size_t size) {
  Incidence out = empty_lists(size);
  out.index.resize(incidence.index.size());
  for (std::uint32_t i : incidence.index) ++out.offset[i + 1];
  for (std::size_t i = 0; i < size; ++i) out.offset[i + 1] += out.offset[i];
  std::vector<std::uint32_t> at(out.offset.begin(), out.offset.end() - 1);
  for (std::uint32_t i = 0; i < incidence.size(); ++i)
    for (std::uint32_t j : incidence[i]) out.index[at[j]++] = i;
  return out;
}

}  // namespace whitney
