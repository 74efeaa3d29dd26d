// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen methods --stability`: the intervals of linear stability, in words and in JSON.
#pragma once

#include <string>

namespace lagen {

/// A line a method; Taylor's has one for each of some orders.
[[nodiscard]] std::string stability_table_text();

/// A list of {"name", "order", "calls", "imaginary", "real", "a_stable", "l_stable"}; an interval without an end is
/// "unbounded", one that does not apply null.
[[nodiscard]] std::string stability_table_json();

} // namespace lagen
