// SPDX-License-Identifier: MIT
/// What is asked of the compiler. Every other header includes this one before anything else, by way of others or
/// itself; a missing file ends the compilation behind its sentence, which would go on for thousands of lines.
#pragma once

#if __cplusplus < 201907L
#error "lagen's headers are C++20: compile with -std=c++20"
#include "lagen/that_is_all"
#endif

#if defined(min) || defined(max)
#error "lagen: min or max is a macro here: define NOMINMAX before <windows.h>, or include lagen's headers first"
#include "lagen/that_is_all"
#endif

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "lagen needs NaN and infinity, by which runs see that they fail: leave out -ffast-math and -Ofast"
#include "lagen/that_is_all"
#endif
