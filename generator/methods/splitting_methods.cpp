// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/splittings.hpp"

#include "methods/method_list.hpp"

#include <array>

namespace lagen {

std::span<const ListedMethod> splitting_methods()
{
    static const std::array list = {
        ListedMethod{"LeapfrogDkd", any_fixed<LeapfrogDkd>()},
        ListedMethod{"LeapfrogKdk", any_fixed<LeapfrogKdk>()},
        ListedMethod{"McLachlan4", any_fixed<McLachlan4>()},
        ListedMethod{"BlanesMoan4", any_fixed<BlanesMoan4>()},
        ListedMethod{"Srkn4", any_fixed<Srkn4>()},
        ListedMethod{"Yoshida6", any_fixed<Yoshida6>()},
        ListedMethod{"BlanesMoan6", any_fixed<BlanesMoan6>()},
        ListedMethod{"Srkn6", any_fixed<Srkn6>()},
        ListedMethod{"KahanLi8", any_fixed<KahanLi8>()},
        ListedMethod{"Sofroniou10", any_fixed<Sofroniou10>()},
    };
    return list;
}

} // namespace lagen
