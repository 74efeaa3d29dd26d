// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce MODEL --group G --action 'x=..'`: the quotient of TQ by a group whose action leaves L as it is.
#pragma once

#include "commands/line/options.hpp"
#include "pipeline.hpp"

namespace lagen {

/// What is made of a model with its proof.
struct GroupQuotient {
    StructureReport report;
    std::string said;     ///< for a person: what names are defined as, and L; or why there is no file
    std::string document; ///< the model file; empty where the action or the symmetry is refuted
    std::string lagrangian;
};

/// Proves that the expressions of `action` ("x=expr, ..") are a right action x.W of the group on the coordinates, that
/// it leaves L, and that the motions of the quotient are those of the model: no theorem is relied on. `slice`
/// ("x=expr, ..", or empty) is where orbits are cut. Throws where a model is not of the sort that is reduced, where an
/// option is wrong, and where the orbits of no slice have the dimension of the group.
[[nodiscard]] GroupQuotient quotient_by_group(const CheckedModel& checked, const std::vector<Setting>& settings,
                                              const std::string& group, const std::string& action,
                                              const std::string& slice);

} // namespace lagen
