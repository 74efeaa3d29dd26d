// SPDX-License-Identifier: GPL-2.0-or-later
/// In which order values that use each other can be computed.
#pragma once

#include "model/model.hpp"

#include <vector>

namespace lagen {

/// Numbers of `values` such that each comes after those whose names it uses. Throws ModelError where some depend on
/// each other in a cycle, which is listed; `noun` calls them in the message: "parameters".
[[nodiscard]] std::vector<std::size_t> dependency_order(const std::vector<NamedTree>& values, const char* noun);

} // namespace lagen
