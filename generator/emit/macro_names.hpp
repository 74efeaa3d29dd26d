// SPDX-License-Identifier: GPL-2.0-or-later
/// Names that a header of the system may have defined as a macro, wherever a generated header is included.
#pragma once

#include <string_view>

namespace lagen {

/// Whether macros are called so: capitals alone from eight characters on, or one of a list.
[[nodiscard]] bool is_macro_name(std::string_view name);

} // namespace lagen
