// SPDX-License-Identifier: GPL-2.0-or-later
/// Compositions of the steps of a symmetric discrete Lagrangian: orders of a pendulum by the midpoint, whole steps that
/// are undone by their reverse, and steps that fail.
#include "lagen/integrate.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace lagen;

namespace {

/// A pair groupoid over R with L(x, y) = (y - x)^2/(2 h) + h g cos((x + y)/2): F^-+L = (y - x)/h +- (h g/2) sin.
struct Pendulum {
    using Scalar = double;
    static constexpr int dimension = 3, base_dimension = 1, inner_dimension = 0;
    static constexpr int fibre_dimension = 1, horizontal = 1, group_order = 0;
    static constexpr bool cayley = true;
    static constexpr std::size_t step_parameter = 0;
    static constexpr std::array<const char*, 2> parameter_names{"h", "g"};
    using State = Eigen::Vector3d;
    using Momentum = Eigen::Matrix<double, 1, 1>;

    std::array<double, 2> parameters{0.1, 1};

    [[nodiscard]] double& parameter(std::size_t k) noexcept { return parameters[k]; }
    [[nodiscard]] double step() const noexcept { return parameters[0]; }
    [[nodiscard]] double pull(const State& s) const noexcept
    {
        return parameters[0] * parameters[1] / 2 * std::sin(s[0] + s[1] / 2);
    }
    [[nodiscard]] Momentum momentum(double, const State& s) const noexcept
    {
        return Momentum(s[1] / parameters[0] + pull(s));
    }
    void forward(double, const State& s, Momentum& x, Momentum& mu) const noexcept
    {
        x[0] = s[0] + s[1];
        mu[0] = s[2] - 2 * pull(s);
    }
    void arrow_equation(double t, const State& s, Momentum& R, Momentum& N) const noexcept
    {
        R[0] = s[2] - momentum(t, s)[0];
        N[0] = 1 / parameters[0] + parameters[0] * parameters[1] / 4 * std::cos(s[0] + s[1] / 2);
    }
};
static_assert(DiscreteMotion<Pendulum> && HasParameters<Pendulum>);

template <class Method>
Pendulum::State ended(double h, const Pendulum::State& start, double end)
{
    Pendulum model;
    model.parameter(0) = h;
    const auto run = integrate(model, start, {0.0, end}, Method{});
    REQUIRE(run.status() == Status::ok);
    return run.state;
}

/// Between the errors of two steps at t = 4.
template <class Method>
double order(double h)
{
    const Pendulum::State start(1.2, 0, 0.4), exact = ended<Discrete8>(0.02, start, 4);
    const auto error = [&](double step) {
        const Pendulum::State found = ended<Method>(step, start, 4);
        return std::hypot(found[0] - exact[0], found[2] - exact[2]);
    };
    return std::log2(error(h) / error(h / 2));
}

} // namespace

TEST_CASE("compositions of the midpoint of a pendulum have the orders 4, 6 and 8", "[discrete]")
{
    CHECK(std::abs(order<Discrete>(0.1) - 2) < 0.1);
    CHECK(std::abs(order<Discrete4>(0.2) - 4) < 0.25);
    CHECK(std::abs(order<Discrete6>(0.4) - 6) < 0.25);
    CHECK(std::abs(order<Discrete8>(0.8) - 8) < 0.4);
}

TEST_CASE("the arrow of a whole step leads to the point of the next one, and a motion goes back by its reverse",
          "[discrete]")
{
    Pendulum model;
    model.parameter(0) = 0.5;
    Integrator run(model, Pendulum::State(1.2, 0, 0.4), 0.0, Discrete6{});
    for (int k = 0; k < 8; ++k) {
        const Pendulum::State before = run.state();
        REQUIRE(run.step() == Status::ok);
        CHECK(std::abs(before[0] + before[1] - run.state()[0]) < 1e-14);
    }
    const Pendulum::State there = run.state();
    const Pendulum::State back = ended<Discrete6>(0.5, {there[0], 0, -there[2]}, 4.0);
    CHECK(std::abs(there[0] - 1.2) > 0.1);
    CHECK(std::abs(back[0] - 1.2) < 1e-13);
    CHECK(std::abs(back[2] + 0.4) < 1e-13);
}

TEST_CASE("a motion that goes on from a state of its own makes the same steps", "[discrete]")
{
    const Pendulum::State start(1.2, 0, 0.4), half = ended<Discrete4>(0.1, start, 1.0);
    const Pendulum::State whole = ended<Discrete4>(0.1, start, 2.0), again = ended<Discrete4>(0.1, half, 1.0);
    CHECK((whole - again).cwiseAbs().maxCoeff() < 1e-15);
}

TEST_CASE("a step of a composition that fails leaves the state as it was, with its status", "[discrete]")
{
    Pendulum model;
    model.parameter(0) = 3; // N = 0 at cos = -4/(h^2 g): steps of 0.41 h = 1.24 fold where g is large
    model.parameter(1) = 8;
    const Pendulum::State start(3.0, 0, 2.5);
    Integrator run(model, start, 0.0, Discrete4{});
    Status status = run.status();
    Pendulum::State last = run.state();
    for (int k = 0; k < 50 && status == Status::ok; ++k) {
        last = run.state();
        status = run.step();
    }
    CHECK((status == Status::no_solution || status == Status::branch_lost || status == Status::singular_mass_matrix));
    CHECK(run.state() == last);
}

TEST_CASE("any other step than the model's own is refused by a composition", "[discrete]")
{
    CHECK(integrate(Pendulum{}, Pendulum::State(1, 0, 0), {0.0, 0.25}, Discrete4{}).status() == Status::invalid_input);
}
