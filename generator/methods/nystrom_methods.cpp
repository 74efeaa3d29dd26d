// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/nystrom.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> nystrom_methods()
{
    static const std::array list = {
        ListedMethod{"Rkn64", any_adaptive<Rkn64>()},
        ListedMethod{"Rkn86", any_adaptive<Rkn86>()},
        ListedMethod{"Rkn1210", any_adaptive<Rkn1210>()},
        ListedMethod{"Rkng54", any_adaptive<Rkng54>()},
    };
    return list;
}

} // namespace lagen
