// SPDX-License-Identifier: GPL-2.0-or-later
/// Inputs held from row to row of a table.
#include "lagen_run/held_inputs.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace lagen;

namespace {

/// x'' = u - k sin(x) with the event v - 1/2.
struct HeldMass {
    using Scalar = double;
    using State = Eigen::Vector2d;
    static constexpr int dimension = 2;
    static constexpr std::array<const char*, 2> input_names{"u", "k"};
    static constexpr std::array<const char*, 1> events_names{"half"};
    struct Inputs {
        double u = 0, k = 0;
    } inputs;
    double& input(std::size_t k) noexcept { return k == 0 ? inputs.u : inputs.k; }
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds = {s[1], inputs.u - inputs.k * std::sin(s[0])};
        return Status::ok;
    }
    Eigen::Matrix<double, 1, 1> events(double, const State& s) const noexcept
    {
        return Eigen::Matrix<double, 1, 1>(s[1] - 0.5);
    }
};

/// What is called with rows, with u at each.
struct HeldRows {
    const HeldMass& model;
    std::vector<std::array<double, 4>> seen; ///< t, x, v, u
    void row(double t, const HeldMass::State& s) { seen.push_back({t, s[0], s[1], model.inputs.u}); }
};

const detail::HeldInputs steps{{0, 1, 2}, {1, 0, -1, 0, 0, 0}}; ///< u, k: a push, a brake, nothing

/// The work of u, by the midpoint of each part: exact, as v is linear there.
struct Work {
    const HeldMass& model;
    double time = 0, work = 0;
    template <class Inside>
    void sum(std::size_t, double, double h, const Inside& inside)
    {
        time += h;
        work += h * model.inputs.u * inside(0.5)[1];
    }
};

} // namespace

TEST_CASE("a run goes from row to row of a table of inputs, and its rows have the inputs of their times")
{
    HeldMass model;
    HeldRows rows{model, {}};
    const std::vector<double> at{0, 0.5, 1, 2, 3};
    Options<HeldMass> options{.at = at};
    const auto run = detail::integrate_held(steps, model, {0, 0}, {0, 3}, Rk4{.step = 0.4}, options, rows);
    REQUIRE(run);
    CHECK(run.state[0] == Approx(1).epsilon(1e-14));
    CHECK(run.state[1] == Approx(0).margin(1e-14));
    CHECK(run.steps == 9); // three a row
    REQUIRE(rows.seen.size() == 5);
    const double x[] = {0, 0.125, 0.5, 1, 1}, u[] = {1, 1, -1, 0, 0};
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(rows.seen[k][0] == at[k]);
        CHECK(rows.seen[k][1] == Approx(x[k]).margin(1e-14));
        CHECK(rows.seen[k][3] == u[k]);
    }
}

TEST_CASE("a run backwards takes the rows of a table in turn")
{
    HeldMass model;
    HeldRows rows{model, {}};
    const std::vector<double> at{3, 2, 1, 0};
    Options<HeldMass> options{.at = at};
    const auto run = detail::integrate_held(steps, model, {1, 0}, {3, 0}, Rk4{.step = 0.4}, options, rows);
    REQUIRE(run);
    CHECK(run.state.norm() == Approx(0).margin(1e-14));
    REQUIRE(rows.seen.size() == 4);
    CHECK(rows.seen[2][3] == -1);
    CHECK(rows.seen[3][3] == 1);
}

TEST_CASE("an event is counted over all rows of a table")
{
    HeldMass model;
    HeldRows rows{model, {}};
    std::vector<EventRequest<double, HeldMass::State>> events(1);
    events[0].stop = true;
    events[0].count = 2;
    Options<HeldMass> options{.events = events};
    const auto run = detail::integrate_held(steps, model, {0, 0}, {0, 3}, Dop853{.tolerance = 1e-12}, options, rows);
    CHECK(run.status() == Status::stopped_by_event);
    REQUIRE(run.events.size() == 2);
    CHECK(run.events[0].t == Approx(0.5).epsilon(1e-14));
    CHECK(run.t == Approx(1.5).epsilon(1e-14));
}

TEST_CASE("behind a jump a motion goes on by the row of its time")
{
    HeldMass model;
    HeldRows rows{model, {}};
    std::vector<EventRequest<double, HeldMass::State>> events(1);
    events[0].direction = Crossing::rising;
    events[0].when = [](double, const HeldMass::State& s) { return s[0] - 0.32; };
    events[0].jump = [](double, const HeldMass::State& s) { return HeldMass::State(s[0], -s[1]); };
    const Options<HeldMass> options{.events = events};
    const auto run = detail::integrate_held(steps, model, {0, 0}, {0, 2}, Dop853{.tolerance = 1e-12}, options, rows);
    REQUIRE(run);
    REQUIRE(run.events.size() == 1); // pushed to 0.32 at t = 0.8, and thrown back
    CHECK(run.events[0].t == Approx(0.8).epsilon(1e-13));
    CHECK(run.state[1] == Approx(-0.8 + 0.2 - 1).epsilon(1e-13));
    CHECK(run.state[0] == Approx(0.32 - 0.8 * 0.2 + 0.02 - 0.6 - 0.5).epsilon(1e-13));
}

TEST_CASE("a table of inputs that does not fit the model or the run is refused")
{
    detail::HeldInputs inputs;
    const Interval<double> span{0, 1};
    CHECK(detail::plan_inputs({}, 1, span, inputs));
    CHECK_FALSE(detail::plan_inputs({0, 1, 1}, 1, span, inputs));
    CHECK_FALSE(detail::plan_inputs({0, 1, 0, 2}, 1, span, inputs));
    inputs = {};
    CHECK_FALSE(detail::plan_inputs({0.5, 1}, 1, span, inputs)); // it begins before the first row
}

namespace {

const detail::HeldInputs kicks{{0, 0.77, 1.31}, {1, 1, -2, 1, 0.5, 2}};

template <class Method>
Eigen::Vector2d end_of_kicks(const Method& method)
{
    HeldMass model;
    HeldRows rows{model, {}};
    const auto run = detail::integrate_held(kicks, model, {0.3, 0}, {0, 2}, method, {}, rows);
    REQUIRE(run);
    return run.state;
}

} // namespace

TEST_CASE("across the rows of a table methods keep their order, and step control its tolerance")
{
    const Eigen::Vector2d exact = end_of_kicks(Verner98{.tolerance = 1e-14});
    const double coarse = (end_of_kicks(Rk4{.step = 0.1}) - exact).norm();
    const double fine = (end_of_kicks(Rk4{.step = 0.05}) - exact).norm();
    CHECK(coarse > 1e-9);
    CHECK(std::log2(coarse / fine) == Approx(4).margin(0.3));
    CHECK((end_of_kicks(Dopri5{.tolerance = 1e-9}) - exact).norm() < 1e-8);
    CHECK((end_of_kicks(Dop853{.tolerance = 1e-12}) - exact).norm() < 1e-11);
}

TEMPLATE_TEST_CASE(
    "an Integrator holds the inputs that it is given, also where a step begins with the slope of the last", "", Dopri5,
    Tsit5, Dop853)
{
    Integrator integrator(HeldMass{}, {0, 0}, 0.0, TestType{.tolerance = 1e-9});
    REQUIRE(integrator.hold({.u = 1}) == Status::ok);
    REQUIRE(integrator.advance_to(1) == Status::ok);
    CHECK(integrator.at(0.5 * (integrator.t_before() + 1))[1] == Approx(0.5 * (integrator.t_before() + 1)));
    REQUIRE(integrator.hold({.u = -1}) == Status::ok);
    CHECK(integrator.model().inputs.u == -1);
    CHECK(integrator.at(1) == integrator.state());
    CHECK(std::isnan(integrator.at(0.99)[0]));
    REQUIRE(integrator.advance_to(2) == Status::ok);
    CHECK(integrator.state()[0] == Approx(1).epsilon(1e-13));
    CHECK(integrator.state()[1] == Approx(0).margin(1e-13));
}

TEST_CASE("an Integrator of a fixed step holds inputs from where it stands")
{
    Integrator integrator(HeldMass{}, {0, 0}, 0.0, Rk4{.step = 0.4});
    for (const double u : {1.0, -1.0, 0.0}) {
        REQUIRE(integrator.hold({.u = u}) == Status::ok);
        REQUIRE(integrator.advance_to(integrator.t() + 1) == Status::ok);
    }
    CHECK(integrator.state()[0] == Approx(1).epsilon(1e-14));
    CHECK(integrator.state()[1] == Approx(0).margin(1e-14));
}

TEST_CASE("what an observer sums along a run goes over all of it, whatever rows are asked for")
{
    const std::vector<double> last{3}, none;
    const std::array<EventRequest<double, HeldMass::State>, 1> never{{{.index = 0, .direction = Crossing::rising}}};
    for (const std::vector<double>* at : {&last, &none})
        for (const bool watched : {false, true}) {
            HeldMass model;
            Work work{model};
            Options<HeldMass> options{.at = *at};
            if (watched) options.events = never;
            const auto run = detail::integrate_held(steps, model, {0, 0.1}, {0, 3}, Rk4{.step = 0.4}, options, work);
            REQUIRE(run);
            CHECK(work.time == Approx(3).epsilon(1e-14));
            // from v = 0.1 to 1.1 and back
            CHECK(work.work == Approx(0).margin(1e-14));
            CHECK(run.state[0] == Approx(1.3).epsilon(1e-14));
        }
    HeldMass model;
    Work work{model};
    REQUIRE(detail::integrate_held(steps, model, {0, 0.1}, {0, 1.5}, Dop853{}, {}, work));
    CHECK(work.work == Approx((1.1 * 1.1 - 0.1 * 0.1) / 2 - (1.1 * 1.1 - 0.6 * 0.6) / 2).epsilon(1e-12));
}

TEST_CASE("an event that jumps at the time of a row of a table happens once")
{
    HeldMass model;
    HeldRows rows{model, {}};
    const std::array<EventRequest<double, HeldMass::State>, 1> surface{
        {{.direction = Crossing::rising,
          .when = [](double, const HeldMass::State& s) { return s[0] - 0.5; },
          .jump = [](double, const HeldMass::State& s) { return HeldMass::State(s[0], s[1] / 2); }}}};
    Options<HeldMass> options{.events = surface};
    const auto run = detail::integrate_held(steps, model, {0, 0}, {0, 3}, Rk4{.step = 0.25}, options, rows);
    CHECK(run.events.size() == 1);
    CHECK(run.events[0].t == Approx(1).epsilon(1e-14));
    CHECK(run.starts_on.empty());
}
