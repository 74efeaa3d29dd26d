// SPDX-License-Identifier: GPL-2.0-or-later
#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> taylor_methods()
{
    static const std::array list = {ListedMethod{"Taylor", Taylor{}}};
    return list;
}

} // namespace lagen
