// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/hidden_roots.hpp"

namespace lagen {

GiNaC::ex HiddenRoots::operator()(const GiNaC::ex& part)
{
    const bool root = GiNaC::is_a<GiNaC::power>(part) && GiNaC::is_a<GiNaC::add>(part.op(0)) &&
                      !part.op(1).info(GiNaC::info_flags::posint);
    if (!root) return part.map(*this);
    const GiNaC::ex name = symbols_.symbol("(" + to_text(from_ginac(part, symbols_, order_)) + ")");
    values_[name] = part;
    return name;
}

} // namespace lagen
