// SPDX-License-Identifier: GPL-2.0-or-later
/// Gauss' methods of six and eight stages: iterations without a Jacobian, one stage after another and in packs, and
/// where Newton's method takes over.
#include "lagen/lagen.hpp"
#include "support/problems.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

template <class S>
struct PackedKepler : problems::Kepler<S> {
    static constexpr bool takes_packs = true;
};

template <class S>
struct PackedBody : problems::RigidBody<S> {
    static constexpr bool takes_packs = true;
};

/// x'' = -stiffness x, and a status where x < least.
template <class S>
struct Spring {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2;
    static constexpr bool takes_packs = true;
    static constexpr std::array<const char*, 2> parameter_names{"stiffness", "least"};
    struct Parameters {
        S stiffness = S(1);
        S least = S(-100);
    } parameters;
    S& parameter(std::size_t k) noexcept { return k == 0 ? parameters.stiffness : parameters.least; }

    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        const S x = s[0], v = s[1];
        auto status = StatusOf<S>::good();
        StatusOf<S>::fail(status, x < parameters.least, Status::singular_mass_matrix);
        ds[0] = v;
        ds[1] = -parameters.stiffness * x;
        return status;
    }
    static constexpr std::array<int, 2> jacobian_rows{0, 1}, jacobian_columns{1, 0};
    void jacobian_values(S, const State&, std::array<S, 2>& values) const noexcept
    {
        values = {S(1), S(-parameters.stiffness)};
    }
};

static_assert(detail::TakesPacks<PackedKepler<double>>);
static_assert(detail::TakesPacks<PackedBody<float>>);
static_assert(detail::TakesPacks<Spring<double>>);
static_assert(!detail::TakesPacks<problems::Kepler<double>>);      // does not say so
static_assert(!detail::TakesPacks<PackedKepler<long double>>);     // has no vectors
static_assert(!detail::TakesPacks<PackedKepler<Pack<double, 4>>>); // is one already

} // namespace

TEST_CASE("Stages in packs give the steps that stages one after another give, without a decomposition")
{
    const auto check = [](const auto& method, std::size_t stages) {
        const auto s = problems::Kepler<double>::exact(0.3, 0.5);
        const auto apart = integrate(problems::Kepler<double>{}, s, {0.5, 20.5}, method);
        const auto together = integrate(PackedKepler<double>{}, s, {0.5, 20.5}, method);
        CHECK(together.status() == Status::ok);
        CHECK(together.steps == apart.steps);
        CHECK(apart.decompositions == 0);
        CHECK(together.decompositions == 0);
        CHECK(together.rhs_calls % stages == 0);
        CHECK(together.rhs_calls < 12 * stages * together.steps);
        CHECK((together.state - apart.state).norm() < tolerance::roundoff(200));
        CHECK((together.state - problems::Kepler<double>::exact(0.3, 20.5)).norm() < 1e-12);
    };
    check(Gauss12{.step = 0.125}, 6);
    check(Gauss16{.step = 0.25}, 8);
}

TEST_CASE("The parameters of a model reach its packs")
{
    Spring<double> spring;
    spring.parameters.stiffness = 4;
    const auto run = integrate(spring, {1.0, 0.0}, {0.0, 3.0}, Gauss16{.step = 0.25});
    CHECK(run.decompositions == 0);
    CHECK_THAT(run.state[0], Catch::WithinAbs(std::cos(6.0), tolerance::roundoff(20)));
    CHECK_THAT(run.state[1], Catch::WithinAbs(-2 * std::sin(6.0), tolerance::roundoff(40)));
}

// Without a Jacobian the iteration converges where h omega < 9.94 and 11.31 [Green, Patrick, Spiteri 2019], and well in
// a part of that.
TEST_CASE("Long steps are left to Newton's method, which keeps the energy")
{
    Spring<double> spring;
    spring.parameters.stiffness = 400;
    const auto check = [&](const auto& method) {
        const auto run = integrate(spring, {1.0, 0.0}, {0.0, 200.0}, method);
        CHECK(run.status() == Status::ok);
        CHECK(run.steps == 200);
        CHECK(run.decompositions >= 200);
        const double energy = run.state[1] * run.state[1] / 400 + run.state[0] * run.state[0];
        CHECK_THAT(energy, Catch::WithinAbs(1, tolerance::roundoff(100)));
    };
    check(Gauss12{.step = 1});
    check(Gauss16{.step = 1});
}

TEST_CASE("A stage in a pack that cannot be evaluated ends the run with its status")
{
    Spring<double> spring;
    spring.parameters.least = 0.5; // passed at t = pi/3
    const auto run = integrate(spring, {1.0, 0.0}, {0.0, 3.0}, Gauss16{.step = 0.125});
    CHECK(run.status() == Status::singular_mass_matrix);
    CHECK(run.t == 1.0);
    CHECK_THAT(run.state[0], Catch::WithinAbs(std::cos(1.0), tolerance::roundoff(20)));
}

TEST_CASE("Values inside a step of stages in packs have the order of the method")
{
    const std::array<double, 3> at{0.61, 7.777, 20.3};
    const auto s = problems::Kepler<double>::exact(0.3, 0.5);
    const auto plain = integrate(PackedKepler<double>{}, s, {0.5, 20.5}, Gauss16{.step = 0.25});
    const auto run = integrate(PackedKepler<double>{}, s, {0.5, 20.5}, Gauss16{.step = 0.25}, {.at = at});
    CHECK(run.state == plain.state);
    REQUIRE(run.states.size() == 3);
    for (std::size_t k = 0; k < at.size(); ++k)
        CHECK((run.states[k] - problems::Kepler<double>::exact(0.3, at[k])).norm() < 1e-12);
}

TEST_CASE("Packs of float keep a Casimir to the rounding of float")
{
    using Body = PackedBody<float>;
    const Body::State s(0.6f, 0.1f, 0.8f);
    const auto run = integrate(Body{}, s, {0.0f, 20.0f}, Gauss16{.step = 0.25});
    CHECK(run.status() == Status::ok);
    CHECK(std::abs(run.state.squaredNorm() - s.squaredNorm()) < 1e-6f);
}
