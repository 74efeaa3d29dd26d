// SPDX-License-Identifier: GPL-2.0-or-later
/// The program of docs/linearize.md: the pole on its cart, held up by the gain that `lagen linearize` prints.
#include "lagen/lagen.hpp"

#include "cart_pole.hpp"

#include <catch2/catch.hpp>

#include <numbers>

TEST_CASE("the gain of lagen linearize holds the pole up from 0.3 rad away")
{
    using Cart = lagen::models::cart_pole<double>;
    Cart cart;
    const Cart::State top = Cart::state({.th = std::numbers::pi}, {}, {}); // x, th, u, w, offset
    const Eigen::RowVector<double, 5> K{-7.9648, 55.4051, -8.54931, 12.22, -3.16228};
    Cart::State s = Cart::state({.th = std::numbers::pi - 0.3}, {}, {});
    lagen::Rk4 method{.step = 1e-3};
    for (int tick = 0; tick < 2000; ++tick) { // for 40 s; the force is held for 1/50 s
        cart.inputs.F = -K * (s - top);
        const auto run = lagen::integrate(cart, s, {0.02 * tick, 0.02 * (tick + 1)}, method);
        REQUIRE(run);
        s = run.state;
        CHECK(std::abs(s[1] - std::numbers::pi) < 0.31);
    }
    CHECK((s - top).head<4>().norm() < 1e-6);
    CHECK(std::abs(cart.inputs.F) < 1e-6);
}
