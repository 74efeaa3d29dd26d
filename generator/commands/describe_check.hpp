// SPDX-License-Identifier: GPL-2.0-or-later
/// What a check says, in words.
#pragma once

#include "verify/verify.hpp"

namespace lagen {

/// What should vanish, in sections by name; empty for kinds whose name says it.
[[nodiscard]] std::string equation_text(const Check& check);

} // namespace lagen
