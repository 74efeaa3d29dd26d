// SPDX-License-Identifier: GPL-2.0-or-later
/// The content of a TOML string literal with the place of origin of every byte.
#pragma once

#include "text/diagnostic.hpp"

namespace lagen {

/// Decodes the literal (basic, literal, multi-line of either, or a bare key) that starts at byte `begin` of the file
/// and ends before `end`. `value` is what the TOML parser read there; where decoding disagrees with it (it never
/// should), every byte is said to come from `begin`, so that positions are coarse but never wrong in content.
[[nodiscard]] Excerpt decode_string(const std::shared_ptr<const SourceFile>& file, std::size_t begin, std::size_t end,
                                    const std::string& value);

} // namespace lagen
