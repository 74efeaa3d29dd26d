// SPDX-License-Identifier: GPL-2.0-or-later
/// Every explicit method in float and double, on Kepler's orbit: an instantiation each, which takes the compiler longer
/// than the runs.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"
#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

// In long double every method has its order on the same orbit: tests/convergence/orders.cpp.
TEST_CASE("Every method runs in float and double, each to its own accuracy")
{
    const auto check = []<class S>(S, const auto& method, double accuracy) {
        using Model = problems::Kepler<S>;
        const auto run = integrate(Model{}, Model::exact(S(0.2), S(0)), {S(0), S(3)}, method);
        CHECK(run.status() == Status::ok);
        CHECK(static_cast<double>((run.state - Model::exact(S(0.2), S(3))).norm()) < accuracy);
    };
    const auto all = [&](const auto& method, double accuracy) {
        check(0.0, method, accuracy);
#if !LAGEN_SANITIZED // it takes minutes to compile these with sanitizers
        check(0.0f, method, accuracy + 1e-4);
#endif
    };
    all(Euler{.step = 1e-3}, 2e-2);
    all(Midpoint{.step = 1e-2}, 1e-3);
    all(Heun{.step = 1e-2}, 1e-3);
    all(Ralston{.step = 1e-2}, 1e-3);
    all(Kutta3{.step = 1e-2}, 1e-5);
    all(Rk4{.step = 1e-2}, 1e-7);
    all(Rk38{.step = 1e-2}, 1e-7);
    all(LeapfrogDkd{.step = 1e-2}, 1e-3);
    all(LeapfrogKdk{.step = 1e-2}, 1e-3);
    all(McLachlan4{.step = 1e-2}, 1e-7);
    all(BlanesMoan4{.step = 1e-2}, 1e-7);
    all(Srkn4{.step = 1e-2}, 1e-7);
    all(Yoshida6{.step = 1e-2}, 1e-8);
    all(BlanesMoan6{.step = 5e-2}, 1e-8);
    all(Srkn6{.step = 1e-1}, 1e-8);
    all(KahanLi8{.step = 1e-1}, 1e-8);
    all(Sofroniou10{.step = 2e-1}, 1e-8);
    all(Dopri5{.tolerance = 1e-6}, 1e-4);
    all(Tsit5{.tolerance = 1e-6}, 1e-4);
    all(Dop853{.tolerance = 1e-6}, 1e-4);
}
