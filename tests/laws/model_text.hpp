// SPDX-License-Identifier: GPL-2.0-or-later
/// A random algebroid as a model file of kind `general`.
#pragma once

#include "local_algebroid.hpp"

namespace lagen::laws {

/// Zero entries are left out; some pairs are written in the order (b, a). Parameters have the default 1.
[[nodiscard]] std::string model_text(const LocalAlgebroid& algebroid);

/// [parameters], [base] and [fibre] alone, the fibre with these names.
[[nodiscard]] std::string model_head(const LocalAlgebroid& algebroid, const std::vector<std::string>& fibre);

/// [title.anchor] and [title.bracket]
[[nodiscard]] std::string entries_text(const LocalAlgebroid& algebroid, const std::string& title);

/// { x1 = "..", x2 = ".." }, zeros left out; empty where all are zero.
[[nodiscard]] std::string inline_table(const std::vector<std::string>& names, const std::vector<Formula>& values);

/// ["a", "b"]
[[nodiscard]] std::string quoted_list(const std::vector<std::string>& names);

} // namespace lagen::laws
