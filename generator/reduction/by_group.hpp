// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce MODEL --group G --action 'x=..'`: the quotient of TQ by a group whose action leaves L as it is.
#pragma once

#include "reduction/reduced_document.hpp"

namespace lagen {

struct GroupRequest {
    std::string group;           ///< "SO(3)"
    std::vector<Setting> action; ///< where x.W puts coordinates; those left out stay
    std::vector<Setting> slice;  ///< coordinates with their values where orbits are cut; empty: it is chosen
    std::string slice_text;      ///< as it was given
};

/// Proves that the expressions of `action` are a right action x.W of the group on the coordinates, that it leaves L,
/// and that the motions of the quotient are those of the model: no theorem is relied on. Throws where a model is not of
/// the sort that is reduced, where an option is wrong, and where the orbits of no slice have the dimension of the
/// group.
[[nodiscard]] ReducedModel quotient_by_group(const CheckedModel& checked, const GroupRequest& request);

} // namespace lagen
