// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic/ginac_stumpff.hpp"

#include "text/diagnostic.hpp"

namespace lagen {
namespace {

GiNaC::ex value_at_zero(const GiNaC::ex& k, const GiNaC::ex& z)
{
    if (z.is_zero()) return 1 / GiNaC::factorial(GiNaC::ex_to<GiNaC::numeric>(k));
    return stumpff(k, z).hold();
}

GiNaC::ex slope(const GiNaC::ex& k, const GiNaC::ex& z, unsigned argument)
{
    if (argument != 1) throw InternalError("the order of a Stumpff function is no variable");
    return (k * stumpff(k + 2, z) - stumpff(k + 1, z)) / 2;
}

} // namespace

REGISTER_FUNCTION(stumpff, eval_func(value_at_zero).derivative_func(slope))

} // namespace lagen
