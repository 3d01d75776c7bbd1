// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace whitney::io {

/// RFC 4648, with padding.
std::string base64_encode(std::string_view bytes);
/// Nothing if the text is not base64 to its end.
std::optional<std::string> base64_decode(std::string_view text);

}  // namespace whitney::io
