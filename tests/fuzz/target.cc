// SPDX-License-Identifier: GPL-3.0-or-later
//
// One source for all targets: WHITNEY_FUZZ_HEADER and WHITNEY_FUZZ_BODY say which.
#include WHITNEY_FUZZ_HEADER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  whitney::fuzz::WHITNEY_FUZZ_BODY({data, size});
  return 0;
}
