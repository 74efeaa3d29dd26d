// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/verner.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> verner_methods()
{
    static const std::array list = {
        ListedMethod{"Verner65", any_adaptive<Verner65>()},
        ListedMethod{"Verner76", any_adaptive<Verner76>()},
        ListedMethod{"Verner87", any_adaptive<Verner87>()},
        ListedMethod{"Verner98", any_adaptive<Verner98>()},
    };
    return list;
}

} // namespace lagen
