// SPDX-License-Identifier: GPL-2.0-or-later
/// The changes that would mend a refuted algebroid: one sign, the order of one pair, or the one component of a bracket
/// that the anchor asks for, with which every equation is proved again.
#pragma once

#include "geometry/structure_equations.hpp"
#include "mechanics/system.hpp"
#include "verify/judge.hpp"

namespace lagen {

/// A hint for each residual of structure_equations of `algebroid`, "" where there is none (and where it is not
/// refuted). `editable`: what the model file gives itself, so that a hint can ask to change it; `names` is the
/// algebroid as it is written. The effort is bounded by a count of operations, so that the same model has the same
/// hints everywhere.
[[nodiscard]] std::vector<std::string> repair_hints(Judge& judge, BaseGradient& partial, const Algebroid& algebroid,
                                                    const WrittenAlgebroid& names, const BaseFunctions& functions,
                                                    Editable editable, const ResidualList& list);

} // namespace lagen
