// SPDX-License-Identifier: GPL-2.0-or-later
#include "symbolic/ginac_erf.hpp"

namespace lagen {
namespace {

GiNaC::ex erf_at_zero(const GiNaC::ex& x)
{
    return x.is_zero() ? GiNaC::ex(0) : erf(x).hold();
}

GiNaC::ex bell(const GiNaC::ex& x, unsigned)
{
    return 2 / GiNaC::sqrt(GiNaC::Pi) * GiNaC::exp(-GiNaC::pow(x, 2));
}

} // namespace

REGISTER_FUNCTION(erf, eval_func(erf_at_zero).derivative_func(bell))

} // namespace lagen
