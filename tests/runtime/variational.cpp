// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/variational.hpp"
#include "lagen/integrate.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace {

/// x'' = -sin x with its variational equations.
struct Swing {
    using Scalar = double;
    static constexpr int dimension = 2;
    using State = Eigen::Matrix<double, 2, 1>;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double x = s[0];
        ds[0] = s[1];
        ds[1] = -std::sin(x);
        return lagen::Status::ok;
    }

    lagen::Status variational(double, const State& s, const State& v, State& dv) const noexcept
    {
        const double first = v[0];
        dv[0] = v[1];
        dv[1] = -std::cos(s[0]) * first;
        return lagen::Status::ok;
    }
};

} // namespace

TEST_CASE("tangents of a trajectory are the differences of its neighbours, and keep the area")
{
    using Tangents = lagen::WithTangents<Swing, 2>;
    const lagen::Dop853 method{.tolerance = 1e-13};
    const Swing::State start(0.7, 0.4);
    const auto run =
        lagen::integrate(Tangents{}, Tangents::state(start, Eigen::Matrix2d::Identity()), {0.0, 3.0}, method);
    REQUIRE(run);
    const Eigen::Matrix2d V = Tangents::tangents(run.state);
    // The flow of a Hamiltonian system keeps dx ^ dv.
    CHECK(std::abs(V(0, 0) * V(1, 1) - V(0, 1) * V(1, 0) - 1) < 1e-11);
    const double h = 1e-4;
    for (int column = 0; column < 2; ++column) {
        Swing::State above = start, below = start;
        above[column] += h;
        below[column] -= h;
        const auto right = lagen::integrate(Swing{}, above, {0.0, 3.0}, method);
        const auto left = lagen::integrate(Swing{}, below, {0.0, 3.0}, method);
        REQUIRE((right && left));
        for (int row = 0; row < 2; ++row)
            CHECK(std::abs((right.state[row] - left.state[row]) / (2 * h) - V(row, column)) < 1e-7);
    }
}
