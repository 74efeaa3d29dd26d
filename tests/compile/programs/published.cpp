// SPDX-License-Identifier: GPL-2.0-or-later
/// Published experiments on headers generated from model files; prints one result a line.
#include "lagen/integrate.hpp"
#include "lagen/print_status.hpp"

#include "arenstorf.hpp"
#include "bruls_heavy_top.hpp"
#include "sundials_kepler.hpp"

#include <iomanip>
#include <iostream>

using namespace lagen;

namespace {

using Top = models::bruls_heavy_top<double>;
using Orbit = models::arenstorf<double>;
using Kepler = models::sundials_kepler<double>;

const Top::State top_start = Top::state({.q0 = 1}, {.w2 = 150, .w3 = -4.61538});

void top(double h)
{
    const auto run = integrate(Top{}, top_start, {0.0, 20.0}, Rk4{.step = h});
    std::cout << "top " << h << ' ' << run.status() << ' ' << run.t << ' ' << run.state.head<4>().norm() << '\n';
}

template <class Method>
void kepler(const char* name, double h)
{
    const auto run = integrate(Kepler{}, Kepler::State(0.4, 0, 0, 2), {0.0, 50.0}, Method{.step = h});
    std::cout << name << ' ' << h << ' ' << run.status() << ' ' << run.t << ' ' << Kepler{}.energy(50, run.state) + 0.5
              << '\n';
}

} // namespace

int main()
{
    std::cout << std::setprecision(17);
    for (const double h : {0.005, 0.01, 0.015, 0.0194, 0.0196, 0.02}) top(h);
    const auto two = integrate(Top{}, top_start, {0.0, 2.0}, Dop853{.tolerance = 1e-13});
    const auto centre = Top{}.observables(2, two.state);
    std::cout << "centre 2 " << two.status() << ' ' << centre[1] << ' ' << centre[2] << ' ' << centre[3] << '\n';
    const Orbit::State start(0.994, 0, 0, -2.00158510637908252240537862224);
    const auto orbit = integrate(Orbit{}, start, {0.0, 17.0652165601579625588917206249}, Dop853{.tolerance = 1e-14});
    std::cout << "arenstorf 1e-14 " << orbit.status() << ' ' << orbit.t << ' '
              << (orbit.state - start).cwiseAbs().maxCoeff() << '\n';
    kepler<LeapfrogDkd>("leapfrog_dkd", 1e-3);
    kepler<LeapfrogKdk>("leapfrog_kdk", 1e-3);
    kepler<McLachlan4>("mclachlan4", 0.1);
    kepler<McLachlan4>("mclachlan4", 0.05);
    kepler<Yoshida6>("yoshida6", 0.1);
    kepler<Yoshida6>("yoshida6", 0.05);
}
