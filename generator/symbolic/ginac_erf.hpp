// SPDX-License-Identifier: GPL-2.0-or-later
/// erf(x) as a function of GiNaC: erf(0) = 0, erf' = 2/sqrt(pi) exp(-x^2).
#pragma once

#include <ginac/ginac.h>

namespace lagen {

DECLARE_FUNCTION_1P(erf)

} // namespace lagen
