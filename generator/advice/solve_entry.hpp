// SPDX-License-Identifier: GPL-2.0-or-later
/// Values of one entry for which an equation vanishes at one point.
#pragma once

#include "advice/repair.hpp"

#include <functional>

namespace lagen {

/// The equation is at most quadratic in a factor k of the entry (in the entry itself where there is none): k solves
/// it where `value` of a trial is known exactly. Rational k alone, other than 1 and -1; a root means something at the
/// point alone, until it is decided.
[[nodiscard]] std::vector<Repair> solve_entry(Graph& graph, const Algebroid& algebroid, const EntryPlace& place,
                                              const std::function<std::optional<Rational>(const Repair&)>& value);

} // namespace lagen
