// SPDX-License-Identifier: GPL-2.0-or-later
/// One change of a valid algebroid that most often makes it invalid; whether it did is for the oracle to say.
#pragma once

#include "local_algebroid.hpp"

#include <functional>

namespace lagen::laws {

struct Mutation {
    std::string name;
    /// False where this algebroid offers no place for it.
    std::function<bool(LocalAlgebroid&, Dice&)> apply;
};

[[nodiscard]] const std::vector<Mutation>& mutations();

} // namespace lagen::laws
