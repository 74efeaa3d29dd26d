// SPDX-License-Identifier: GPL-2.0-or-later
// README's first program, as it was when compiling a run took 6.3 seconds: what it takes is measured by this text.
#include "heavy_top.hpp"

#include <lagen/integrate.hpp>

#include <cstdio>

int main()
{
    using Top = lagen::models::heavy_top<double>; // or float, long double, a multiprecision type, a pack
    Top top;
    top.parameters.mgl = 2.0;
    Top::State s = Top::state({.g1 = 0.6, .g3 = 0.8}, {.w1 = 0.9, .w2 = -0.4, .w3 = 1.6});
    const auto run = lagen::integrate(top, s, {0.0, 1.0}, lagen::Dop853{.tolerance = 1e-10});
    std::printf("top energy %.6f status %s\n", top.energy(1.0, s), lagen::to_text(run.status()));
    return run ? 0 : 1;
}
