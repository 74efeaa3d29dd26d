// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method beside DOP853 at equal errors, on one generated model: the tolerance of each is the loosest, in
/// steps of 10^(1/4), whose state at the end is within the target of a run in long double. Compiled by
/// scripts/series-table with -D MODEL=heavy_top -D START=1,0,.. . Prints, a line a target, the errors, the microseconds
/// (least of 15 interleaved rounds) and their ratio.
#include "model_header.hpp"

#include MODEL_HEADER(MODEL)

#include "lagen/integrate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace {

template <class S>
using Model = lagen::models::MODEL<S>;
using State = Model<double>::State;

constexpr double duration = 20;

template <class S>
typename Model<S>::State start()
{
    constexpr double lanes[] = {START};
    typename Model<S>::State s;
    for (int i = 0; i < Model<S>::dimension; ++i) s[i] = S(lanes[i]);
    return s;
}

template <class Method>
double error_of(const Method& method, const State& exact)
{
    const auto run = lagen::integrate(Model<double>{}, start<double>(), {0.0, duration}, method);
    return run ? (run.state - exact).norm() / exact.norm() : 1e300;
}

/// The method at the loosest tolerance that meets the target.
template <class Method>
Method tuned(double target, const State& exact)
{
    for (int quarter = 0; quarter < 60; ++quarter) {
        const Method method{.tolerance = 1e-2 * std::pow(10.0, -0.25 * quarter)};
        if (error_of(method, exact) <= target) return method;
    }
    return Method{.tolerance = 1e-16};
}

template <class Method>
double microseconds(const Method& method)
{
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 10; ++k) {
        const auto run = lagen::integrate(Model<double>{}, start<double>(), {0.0, duration}, method);
        asm volatile("" : : "g"(&run) : "memory");
    }
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / 10;
}

} // namespace

int main()
{
    const auto reference = lagen::integrate(Model<long double>{}, start<long double>(), {0.0L, duration},
                                            lagen::Taylor{.tolerance = 1e-19});
    if (!reference) return 1;
    const State exact = reference.state.cast<double>();
    for (const double target : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const auto series = tuned<lagen::Taylor>(target, exact);
        const auto pair = tuned<lagen::Dop853>(target, exact);
        double best = 1e300, best_of_pair = 1e300;
        for (int round = 0; round < 15; ++round) {
            best = std::min(best, microseconds(series));
            best_of_pair = std::min(best_of_pair, microseconds(pair));
        }
        std::printf("%-16s %.0e  %8.1e %8.1e  %9.2f %9.2f %6.3f\n", TEXT_OF(MODEL), target, error_of(series, exact),
                    error_of(pair, exact), best, best_of_pair, best / best_of_pair);
    }
}
