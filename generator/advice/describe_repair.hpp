// SPDX-License-Identifier: GPL-2.0-or-later
/// Repairs in the words and in the order of the model file.
#pragma once

#include "advice/repair.hpp"
#include "verify/judge.hpp"

namespace lagen {

/// Values that are numbers, as such: x*y/(y*x) is 1.
[[nodiscard]] Repair simplified(Graph& graph, Judge& judge, Repair repair);

/// Can the file have it? Not an entry that depends on the base in a bracket of constants.
[[nodiscard]] bool is_admissible(const Graph& graph, const Algebroid& algebroid, const Editable& editable,
                                 const Repair& repair);

/// "[a, b] needs component c = V, given is W; with it <what> hold", or "<what> hold with ..."; empty where there is no
/// repair or a value has a long text. The normal forms of values come from `judge`.
[[nodiscard]] std::string describe(Graph& graph, Judge& judge, const WrittenAlgebroid& names, const Algebroid& lowered,
                                   const std::vector<Repair>& repairs, const std::string& what);

} // namespace lagen
