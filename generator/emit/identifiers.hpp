// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as identifiers of a programming language.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

/// ASCII letters, digits and '_': "x[1]" becomes x_1, Greek is transliterated, other letters become "uXXXX". A reserved
/// name gains a trailing '_'; distinct names stay distinct (a second clash gains another '_'), and one that needs no
/// change keeps its own.
[[nodiscard]] std::vector<std::string> identifiers(const std::vector<std::string>& names,
                                                   const std::function<bool(std::string_view)>& is_reserved);

} // namespace lagen
