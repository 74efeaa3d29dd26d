// SPDX-License-Identifier: GPL-2.0-or-later
/// Long function bodies in parts, since compilers take more than linear time for one long function. Values that a later
/// part reads go through a workspace whose places are used again.
#pragma once

#include "emit/order_body.hpp"

namespace lagen {

struct CutBody {
    std::vector<std::vector<BodyStep>> parts; ///< with loads, keeps and recalls put in
    std::size_t workspace = 0;                ///< places
};

/// Parts of about `longest` steps or fewer, cut where few values are alive and never between a factorisation and a
/// solution by it. A body of up to five times that is left whole; 0 for `longest`: always.
[[nodiscard]] CutBody cut_body(const Graph& graph, const std::vector<BodyStep>& steps, std::size_t longest);

} // namespace lagen
