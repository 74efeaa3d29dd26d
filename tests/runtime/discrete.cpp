// SPDX-License-Identifier: GPL-2.0-or-later
/// Discrete motions in the runtime: maps between groups and algebras, arrows of given momenta, folds and branches.
#include "lagen/integrate.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace lagen;

namespace {

/// A pair groupoid over R with F^-L(x, x + d) = F^+L = sin(d)/h: folds at d = pi/2 + k pi, N = cos(d)/h.
struct Fold {
    using Scalar = double;
    static constexpr int dimension = 3, base_dimension = 1, inner_dimension = 0;
    static constexpr int fibre_dimension = 1, horizontal = 1, group_order = 0;
    static constexpr bool cayley = true;
    using State = Eigen::Vector3d;
    using Momentum = Eigen::Matrix<double, 1, 1>;

    double h = 0.5, push = 0; ///< mu gains `push` in a step

    [[nodiscard]] double step() const noexcept { return h; }
    [[nodiscard]] Momentum momentum(double, const State& s) const noexcept { return Momentum(std::sin(s[1]) / h); }
    void forward(double, const State& s, Momentum& x, Momentum& mu) const noexcept
    {
        x[0] = s[0] + s[1];
        mu[0] = s[2] + push;
    }
    void arrow_equation(double, const State& s, Momentum& R, Momentum& N) const noexcept
    {
        R[0] = s[2] - std::sin(s[1]) / h;
        N[0] = std::cos(s[1]) / h;
    }
};
static_assert(DiscreteMotion<Fold> && !RightHandSide<Fold>);

using Matrix = GroupMatrix<double, 3>;

Matrix skew(double a, double b, double c)
{
    Matrix m;
    m << 0, -c, b, c, 0, -a, -b, a, 0;
    return m;
}

} // namespace

TEST_CASE("Cayley's map and its inverse, exp and log, on matrices less the unit", "[discrete]")
{
    const Matrix one = Matrix::Identity();
    for (const double size : {1e-9, 0.1, 1.5}) {
        const Matrix A = size * skew(0.3, -0.8, 0.5);
        Matrix V, back;
        REQUIRE(cayley_less_one<double, 3>(A, V));
        CHECK(((V + one).transpose() * (V + one) - one).cwiseAbs().maxCoeff() < 1e-15);
        REQUIRE(cayley_inverse<double, 3>(V, back));
        CHECK((back - A).cwiseAbs().maxCoeff() < 4e-16 * size); // relative: nothing is lost of small ones
        const Matrix E = exp_less_one<double, 3>(A);
        CHECK(((E + one).transpose() * (E + one) - one).cwiseAbs().maxCoeff() < 2e-15);
        REQUIRE(log_of_one_and<double, 3>(E, back));
        CHECK((back - A).cwiseAbs().maxCoeff() < 2e-15 * size);
    }
    Matrix shear = Matrix::Zero(), logarithm; // unipotent: the series of exp and log are finite
    shear(0, 1) = 2, shear(1, 2) = 3;
    const Matrix E = exp_less_one<double, 3>(shear);
    CHECK((E - shear - shear * shear / 2).cwiseAbs().maxCoeff() < 1e-15);
    REQUIRE(log_of_one_and<double, 3>(E, logarithm));
    CHECK((logarithm - shear).cwiseAbs().maxCoeff() < 1e-14);
    Matrix half_turn = Matrix::Zero(), none; // rotation by pi about the third axis
    half_turn(0, 0) = half_turn(1, 1) = -2;
    CHECK_FALSE(cayley_inverse<double, 3>(half_turn, none));
}

TEST_CASE("the arrow of given momenta is the one on the branch of the guess, up to its fold", "[discrete]")
{
    const Fold model;
    const auto start = [&](double guess, double mu) {
        return Integrator(model, Fold::State(0, guess, mu), 0.0, Discrete{});
    };
    CHECK(start(0, 1.99).status() == Status::ok);
    CHECK(std::abs(start(0, 1.99).state()[1] - std::asin(0.995)) < 1e-12);
    CHECK(std::abs(start(2.5, 1.99).state()[1] - (M_PI - std::asin(0.995))) < 1e-12);
    CHECK(std::abs(start(0, -1.99999).state()[1] - std::asin(-0.999995)) < 1e-9);
    CHECK(start(0, 2.01).status() == Status::no_solution);
    CHECK(start(2.5, 2.01).status() == Status::no_solution);
    CHECK(start(0, std::nan("")).status() == Status::non_finite);
}

TEST_CASE("the arrows of given momenta are found on both sides of a fold, the one that a run begins with first",
          "[discrete]")
{
    const Fold model;
    for (const double mu : {1.0, -1.0}) {
        const Fold::State s(0, 0, mu);
        const auto arrows = arrows_of_momenta(model, 0.0, s);
        REQUIRE(arrows.size() >= 4); // of infinitely many: asin(mu h) + 2 pi k, pi - asin(mu h) + 2 pi k
        CHECK(arrows[0].state == Integrator(model, s, 0.0, Discrete{}).state());
        CHECK(arrows[0].distance == 0);
        for (std::size_t k = 0; k < arrows.size(); ++k) {
            const double d = arrows[k].state[1];
            CHECK(std::abs(std::sin(d) / model.h - mu) < 1e-12);
            CHECK(arrows[k].negative == (std::cos(d) < 0));
            CHECK(arrows[k].distance == Approx(std::abs(d - arrows[0].state[1])));
            if (k > 0) CHECK(arrows[k].distance > arrows[k - 1].distance - 1e-9);
        }
        CHECK(std::abs(arrows[1].state[1] - mu * (M_PI - std::asin(0.5))) < 1e-12);
    }
    CHECK(arrows_of_momenta(model, 0.0, Fold::State(0, 0, 2.01)).empty());
    CHECK(arrows_of_momenta(model, 0.0, Fold::State(0, 0, std::nan(""))).empty());
}

TEST_CASE("a run that starts at its arrow stays on the branch of it, whichever sign det N has there", "[discrete]")
{
    Fold model;
    model.push = 0.1;
    for (const double d : {0.3, 2.5}) {
        Integrator run(model, Fold::State(0, d, std::sin(d) / model.h), 0.0, Discrete{});
        CHECK(run.state()[1] == d);
        REQUIRE(run.step() == Status::ok);
        const double sine = std::sin(d) + 0.05, there = d < 1 ? std::asin(sine) : M_PI - std::asin(sine);
        CHECK(std::abs(run.state()[1] - there) < 1e-14);
    }
}

TEST_CASE("a discrete run ends before the fold with its last good state, and has no values between its steps",
          "[discrete]")
{
    Fold model;
    model.push = 0.3;
    const auto run = integrate(model, Fold::State(0, 0, 0), {0.0, 50.0}, Discrete{});
    CHECK(run.status() == Status::no_solution);
    CHECK(run.steps == 6); // mu = 1.8 is the last below 1/h = 2
    CHECK(run.t == 3.0);
    CHECK(run.failed_at == 3.5);
    CHECK(std::abs(run.state[2] - 1.8) < 1e-15);
    CHECK(std::abs(run.state[1] - std::asin(0.9)) < 1e-14);

    model.push = 0.1;
    const std::vector<double> times{0.5, 0.75, 1.0};
    const auto rows = integrate(model, Fold::State(0, 0, 0), {0.0, 1.0}, Discrete{}, {.at = times});
    REQUIRE(rows.states.size() == 3);
    CHECK(rows.states[0].allFinite());
    CHECK(std::isnan(rows.states[1][0]));
    CHECK(std::abs(rows.states[2][2] - 0.2) < 1e-15);

    CHECK(integrate(model, Fold::State(0, 0, 0), {0.0, 0.7}, Discrete{}).status() == Status::invalid_input);
    model.h = -0.5;
    CHECK(integrate(model, Fold::State(0, 0, 0), {0.0, 1.0}, Discrete{}).status() == Status::invalid_input);
}
