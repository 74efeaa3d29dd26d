// SPDX-License-Identifier: MIT
// A user's program: the heavy top for one second.
#include "heavy_top.hpp"

#include <lagen/dop853.hpp> // lagen/integrate.hpp has every method

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
