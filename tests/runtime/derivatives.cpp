// SPDX-License-Identifier: GPL-2.0-or-later
/// Runs in scalars that carry derivatives (Eigen's AutoDiffScalar, whose copies may throw) against runs of the
/// variational equations, and against central differences over a parameter.
// AutoDiffScalar takes whole numbers and long double as double.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"

#include "heavy_top.hpp"
#include "lagen/integrate.hpp"
#include "support/tolerances.hpp"

#include <unsupported/Eigen/AutoDiff>

#include <catch2/catch.hpp>

namespace {

using namespace lagen;
using Top = models::heavy_top<double>;

const Top::State start = Top::state({.g1 = 0, .g2 = 0.6, .g3 = 0.8}, {.w1 = 0.1, .w2 = -0.3, .w3 = 2});

/// s' = f(s), V' = (df/ds) V with a 6 x 6 matrix V behind s.
struct TangentTop {
    using Scalar = double;
    static constexpr int dimension = 42;
    using State = Eigen::Matrix<double, 42, 1>;
    Top top;

    Status rhs(double t, const State& s, State& ds) const noexcept
    {
        const Top::State x = s.head<6>();
        Top::State f;
        const Status status = top.rhs(t, x, f);
        const Eigen::Matrix<double, 6, 6> v = Eigen::Map<const Eigen::Matrix<double, 6, 6>>(s.data() + 6);
        ds.head<6>() = f;
        Eigen::Map<Eigen::Matrix<double, 6, 6>>(ds.data() + 6) = top.jacobian(t, x) * v;
        return status;
    }
};

template <class Method>
Eigen::Matrix<double, 6, 6> by_variational_equations(const Method& method)
{
    TangentTop::State s;
    s.head<6>() = start;
    Eigen::Map<Eigen::Matrix<double, 6, 6>>(s.data() + 6).setIdentity();
    const auto run = integrate(TangentTop{}, s, {0.0, 1.0}, method);
    REQUIRE(run.status() == Status::ok);
    return Eigen::Map<const Eigen::Matrix<double, 6, 6>>(run.state.data() + 6);
}

template <class Derivatives, class Method>
Eigen::Matrix<double, 6, 6> by_derivatives(const Method& method)
{
    using Scalar = Eigen::AutoDiffScalar<Derivatives>;
    static_assert(!std::is_nothrow_copy_constructible_v<Scalar>);
    using Model = models::heavy_top<Scalar>;
    typename Model::State s;
    for (int i = 0; i < 6; ++i) s[i] = Scalar(start[i], 6, i);
    const auto run = integrate(Model{}, s, {Scalar(0), Scalar(1)}, method);
    REQUIRE(run.status() == Status::ok);
    Eigen::Matrix<double, 6, 6> result;
    for (int i = 0; i < 6; ++i) result.row(i) = run.state[i].derivatives().transpose();
    return result;
}

using Fixed = Eigen::Matrix<double, 6, 1>;

double largest(const Eigen::Matrix<double, 6, 6>& difference)
{
    return difference.cwiseAbs().maxCoeff();
}

} // namespace

TEST_CASE("derivatives carried through a run are those of the variational equations")
{
    const auto by_rk4 = by_variational_equations(Rk4{.step = 0.01});
    REQUIRE(largest(by_rk4) > 0.5);
    CHECK(largest(by_derivatives<Fixed>(Rk4{.step = 0.01}) - by_rk4) < tolerance::roundoff(1000));
    const auto by_dop853 = by_variational_equations(Dop853{.tolerance = 1e-13});
    CHECK(largest(by_derivatives<Eigen::VectorXd>(Dop853{.tolerance = 1e-13}) - by_dop853) < tolerance::difference);
    CHECK(largest(by_derivatives<Fixed>(Gauss8{.step = 0.02}) - by_dop853) < tolerance::difference);
    CHECK(largest(by_derivatives<Fixed>(Radau5{.tolerance = 1e-13}) - by_dop853) < tolerance::difference);
}

TEST_CASE("the sensitivity of a run to a parameter is its central difference")
{
    using Scalar = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
    models::heavy_top<Scalar> top;
    const double mgl = top.parameters.mgl.value();
    top.parameters.mgl = Scalar(mgl, 1, 0);
    models::heavy_top<Scalar>::State s;
    for (int i = 0; i < 6; ++i) s[i] = start[i];
    const auto run = integrate(top, s, {0.0, 1.0}, Rk4{.step = 0.01});
    REQUIRE(run.status() == Status::ok);
    const auto end_at = [](double value) {
        Top shifted;
        shifted.parameters.mgl = value;
        return integrate(shifted, start, {0.0, 1.0}, Rk4{.step = 0.01}).state;
    };
    const double h = 1e-5;
    const Top::State slope = (end_at(mgl + h) - end_at(mgl - h)) / (2 * h);
    REQUIRE(slope.cwiseAbs().maxCoeff() > 0.01);
    for (int i = 0; i < 6; ++i) CHECK(std::abs(run.state[i].derivatives()[0] - slope[i]) < tolerance::difference);
}
