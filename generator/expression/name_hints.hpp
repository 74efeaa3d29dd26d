// SPDX-License-Identifier: GPL-2.0-or-later
/// Hints for a name that nobody declared.
#pragma once

#include <string>
#include <vector>

namespace lagen {

/// The nearest of `known`, else what the name is called in this language, else the names that are known.
[[nodiscard]] std::string hint_for_symbol(const std::string& name, const std::vector<std::string>& known);

/// The same for a function; `known` are the model's own, the built-in ones are added.
[[nodiscard]] std::string hint_for_function(const std::string& name, std::vector<std::string> known);

} // namespace lagen
