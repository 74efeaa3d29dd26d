// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/fixed_step.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> fixed_step_methods()
{
    static const std::array list = {
        ListedMethod{"Euler", any_fixed<Euler>()},   ListedMethod{"Midpoint", any_fixed<Midpoint>()},
        ListedMethod{"Heun", any_fixed<Heun>()},     ListedMethod{"Ralston", any_fixed<Ralston>()},
        ListedMethod{"Kutta3", any_fixed<Kutta3>()}, ListedMethod{"Rk4", any_fixed<Rk4, 7>()},
        ListedMethod{"Rk38", any_fixed<Rk38>()},
    };
    return list;
}

} // namespace lagen
