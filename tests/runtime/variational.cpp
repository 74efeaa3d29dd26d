// SPDX-License-Identifier: GPL-2.0-or-later
#include "lagen/integrate.hpp"
#include "lagen/tangents.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <array>
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

/// x'' = -x with everything that a run may ask of a model; the domain is x > -1/2.
struct Bounded {
    using Scalar = double;
    static constexpr int dimension = 2;
    using State = Eigen::Matrix<double, 2, 1>;
    static constexpr std::array<const char*, 1> events_names{"turn"}, invariants_names{"radius"};
    static constexpr std::array<const char*, 1> observables_names{"double"}, parameter_names{"rate"};
    double rate = 1;

    lagen::Status rhs(double, const State& s, State& ds) const noexcept
    {
        const double x = s[0];
        ds[0] = s[1];
        ds[1] = -rate * x;
        return lagen::Status::ok;
    }
    lagen::Status variational(double t, const State&, const State& v, State& dv) const noexcept
    {
        return rhs(t, v, dv);
    }
    double& parameter(std::size_t) noexcept { return rate; }
    lagen::Status parameter_status() const noexcept
    {
        return rate > 0 ? lagen::Status::ok : lagen::Status::singular_mass_matrix;
    }
    using One = Eigen::Matrix<double, 1, 1>;
    One domain(double, const State& s) const noexcept { return One(s[0] + 0.5); }
    One events(double, const State& s) const noexcept { return One(s[0]); }
    One invariants(double, const State& s) const noexcept { return One(s.norm()); }
    One observables(double, const State& s) const noexcept { return One(2 * s[0]); }
    double energy(double, const State& s) const noexcept { return (s[1] * s[1] + rate * s[0] * s[0]) / 2; }
};

template <class M>
concept names_its_parts = requires(M model)
{
    M::observables_names;
    M::invariants_names;
    M::parameter_names;
    model.parameter(std::size_t{0});
    model.parameter_status();
};

} // namespace

TEST_CASE("a run with tangents leaves the domain, meets events and refuses parameters where its model does")
{
    using Tangents = lagen::WithTangents<Bounded, 1>;
    const Bounded model;
    const Bounded::State s(1, 0), v(0.3, 0.4);
    const auto check = [&](const auto& method) {
        const std::array<lagen::EventRequest<double, Bounded::State>, 1> turn{{{.index = 0}}};
        const std::array<lagen::EventRequest<double, Tangents::State>, 1> same{{{.index = 0}}};
        const auto alone = lagen::integrate(model, s, {0.0, 10.0}, method, {.events = turn});
        const auto both =
            lagen::integrate(Tangents{model}, Tangents::state(s, v), {0.0, 10.0}, method, {.events = same});
        CHECK(alone.status() == lagen::Status::left_domain);
        CHECK(both.status() == lagen::Status::left_domain);
        // The tangent has its share in the choice of steps, and the boundary is found all the same.
        CHECK_THAT(alone.t, Catch::WithinAbs(std::acos(-0.5), 1e-7));
        CHECK_THAT(both.t, Catch::WithinAbs(alone.t, 1e-7));
        REQUIRE(alone.events.size() == 1);
        REQUIRE(both.events.size() == 1);
        CHECK_THAT(both.events[0].t, Catch::WithinAbs(alone.events[0].t, 1e-7));
        // Linear equations are their own variational ones.
        CHECK((Tangents::tangents(both.state) - Eigen::Vector2d(0.3 * both.state[0] + 0.4 * std::sin(both.t),
                                                                0.3 * both.state[1] + 0.4 * std::cos(both.t)))
                  .norm() < 1e-7);
    };
    check(lagen::Dop853{.tolerance = 1e-10});
    check(lagen::Rk4{.step = 0.01});
    const auto refused = lagen::integrate(Tangents{Bounded{.rate = -1}}, Tangents::state(s, v), {0.0, 1.0},
                                          lagen::Dop853{.tolerance = 1e-10});
    CHECK(refused.status() == lagen::Status::singular_mass_matrix);
    CHECK(refused.rhs_calls == 0);
}

TEST_CASE("a model with tangents has the parts that its model has, and no others")
{
    using Tangents = lagen::WithTangents<Bounded, 2>;
    static_assert(lagen::HasDomain<Tangents> && lagen::HasEvents<Tangents> && lagen::HasEnergy<Tangents>);
    static_assert(!lagen::HasConstraints<Tangents> && !lagen::HasHamiltonian<Tangents>);
    using Plain = lagen::WithTangents<Swing, 2>;
    static_assert(!lagen::HasDomain<Plain> && !lagen::HasEvents<Plain> && !lagen::HasEnergy<Plain>);
    static_assert(names_its_parts<Tangents> && !names_its_parts<Plain>);
    Tangents both;
    both.parameter(0) = 4;
    CHECK(both.model.rate == 4);
    const auto all = Tangents::state(Bounded::State(0.25, 1), Eigen::Matrix2d::Identity());
    CHECK(both.energy(0, all) == both.model.energy(0, Bounded::State(0.25, 1)));
    CHECK(both.domain(0, all)[0] == 0.75);
    CHECK(both.events(0, all)[0] == 0.25);
    CHECK(both.invariants(0, all)[0] == Bounded::State(0.25, 1).norm());
    CHECK(both.observables(0, all)[0] == 0.5);
    CHECK(Tangents::observables_names == Bounded::observables_names);
    CHECK(Tangents::invariants_names == Bounded::invariants_names);
    CHECK(Tangents::point(all) == Bounded::State(0.25, 1));
}

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
