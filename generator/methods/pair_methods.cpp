// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/dop853.hpp"
#include "lagen/dopri5.hpp"
#include "lagen/tsit5.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> pair_methods()
{
    static const std::array list = {
        ListedMethod{"Dopri5", any_adaptive<Dopri5>()},
        ListedMethod{"Tsit5", any_adaptive<Tsit5>()},
        ListedMethod{"Dop853", any_adaptive<Dop853, 4>()},
    };
    return list;
}

} // namespace lagen
