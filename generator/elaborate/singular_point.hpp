// SPDX-License-Identifier: GPL-2.0-or-later
/// Points where several functions vanish at once, as on the singular set of a level set.
#pragma once

#include "proof/decide.hpp"

namespace lagen {

/// An exact point with small denominators where all of `functions` are 0 and the domain holds, with its values of `x`;
/// parameters are `fixed`. Nothing where the search finds none: then there may be one all the same.
[[nodiscard]] std::optional<NamedPoint> common_zero(Graph& graph, const std::vector<NodeId>& functions,
                                                    const std::vector<NodeId>& x, const std::vector<NodeId>& domain,
                                                    const std::map<NodeId, Rational>& fixed);

} // namespace lagen
