// SPDX-License-Identifier: GPL-2.0-or-later
/// The rank of a matrix of functions at almost every point: a minor that is not zero at some point, and all minors that
/// border it zero.
#pragma once

#include "proof/decide.hpp"

namespace lagen {

/// Of a bundle map on the fibres, at almost every point of M.
struct FibreRank {
    std::optional<std::size_t> rank; ///< nothing where it is not decided
    bool surjective = false;
    bool injective = false;
    std::vector<std::string> where; ///< it is this everywhere where these strict conditions hold, which the domain does
                                    ///< not imply
};

/// Of Phi^a_b with `rows` rows of `columns` entries.
[[nodiscard]] FibreRank fibre_rank(Graph& graph, const std::vector<NodeId>& matrix, std::size_t rows,
                                   std::size_t columns, const ZeroDecider& decider);

} // namespace lagen
