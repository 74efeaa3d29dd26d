// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/gauss.hpp"
#include "lagen/radau5.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> implicit_methods()
{
    static constexpr KernelsAsked jacobian{.jacobian = true}, both{.jacobian = true, .packs = true};
    static const std::array list = {
        ListedMethod{"Gauss2", any_fixed<Gauss2>(), jacobian},
        ListedMethod{"Gauss4", any_fixed<Gauss4, 6>(), jacobian},
        ListedMethod{"Gauss6", any_fixed<Gauss6>(), jacobian},
        ListedMethod{"Gauss8", any_fixed<Gauss8>(), both},
        ListedMethod{"Gauss12", any_fixed<Gauss12>(), both},
        ListedMethod{"Gauss16", any_fixed<Gauss16>(), both},
        ListedMethod{"Radau5", any_adaptive<Radau5, 6>(), jacobian},
        ListedMethod{"Radau3Fixed", any_fixed<Radau3Fixed>(), jacobian},
        ListedMethod{"Radau5Fixed", any_fixed<Radau5Fixed>(), jacobian},
    };
    return list;
}

} // namespace lagen
