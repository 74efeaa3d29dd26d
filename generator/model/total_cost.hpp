// SPDX-License-Identifier: GPL-2.0-or-later
/// The cost of a control problem up to now, J' = cost with J = 0 at the start: a first-order state `total_cost` that
/// lagen adds behind those of the model, and that a motion carries only where somebody names it.
#pragma once

#include "model/model.hpp"

namespace lagen {

inline constexpr const char* total_cost_name = "total_cost";

/// True where state k is that one; one that a model declares itself is not.
[[nodiscard]] inline bool is_total_cost(const Model& model, std::size_t k)
{
    const Symbol& symbol = model.states[k].symbol;
    return model.control && symbol.name == total_cost_name && symbol.where.file == nullptr;
}

} // namespace lagen
