// SPDX-License-Identifier: GPL-2.0-or-later
/// stumpff(k, z) as a function of GiNaC: c_k(0) = 1/k!, c_k' = (k c_{k+2} - c_{k+1})/2; k is a number.
#pragma once

#include <ginac/ginac.h>

namespace lagen {

DECLARE_FUNCTION_2P(stumpff)

} // namespace lagen
