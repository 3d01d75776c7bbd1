// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace whitney {

/// Bytes of memory that this process holds now (its resident set); where the system does not tell, the most it ever
/// held.
std::uint64_t resident_bytes();

/// Bytes that this process could still take without the machine swapping or the system ending it: what is free or
/// easily made so, and what the control groups of the process leave. Without an answer of the system: 2^64 - 1.
std::uint64_t available_bytes();

}  // namespace whitney
