// SPDX-License-Identifier: GPL-2.0-or-later
/// How far the energy walks by Taylor's method in a long time, on generated headers.
#pragma once

#include "kepler.hpp"
#include "rigid_body.hpp"

#include "lagen/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

/// The largest error of the energy after 10^3, 10^4, .. and `longest` units of time, relative to it, in epsilons times
/// the square root of the number of steps: a random walk has a bound, a bias has none.
template <template <class> class Model>
void walk(const char* name, double longest, const typename Model<double>::State& s)
{
    const Model<double> model;
    Model<long double> wide;
    for (std::size_t k = 0; k < wide.parameter_names.size(); ++k) wide.parameter(k) = Model<double>(model).parameter(k);
    const auto energy = [&](const auto& at) {
        return wide.energy(0, typename Model<long double>::State(at.template cast<long double>()));
    };
    lagen::Integrator integrator(model, s, 0.0, lagen::Taylor{.tolerance = 1e-16});
    long double largest = 0;
    for (double end = 1e3; end < 2 * longest; end *= 10) {
        if (integrator.advance_to(end) != lagen::Status::ok) return;
        const long double error = std::abs(energy(integrator.state()) / energy(s) - 1);
        largest = std::max(largest, error / std::sqrt(static_cast<long double>(integrator.steps())));
    }
    std::printf("%s walk %.3g\n", name, static_cast<double>(largest / std::numeric_limits<double>::epsilon()));
}

inline void walks(double longest)
{
    walk<lagen::models::rigid_body>("rigid_body", longest, {-1.5, 0.5, 0.35});
    walk<lagen::models::kepler>("oval", longest, {0.7, 0, 0, std::sqrt(1.5)});
    walk<lagen::models::kepler>("ellipse", longest, {0.5, 0, 0, std::sqrt(3.0)});
}
