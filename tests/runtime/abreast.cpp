// SPDX-License-Identifier: GPL-2.0-or-later
/// Trajectories on the lanes of packs: each has the bits of `integrate`, whatever the others do.
#include "heavy_top.hpp"
#include "lagen/ensemble.hpp"
#include "lagen/lagen.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>
#include <tuple>
#include <vector>

using namespace lagen;

namespace {

/// Kepler's problem with an attraction of its own, and a force that depends on time; fails where x < `wall`.
template <class S>
struct Orbit {
    using Scalar = S;
    using State = Eigen::Matrix<S, 4, 1>;
    static constexpr int dimension = 4;
    static constexpr bool takes_packs = true;
    static constexpr std::array<const char*, 3> parameter_names{"mu", "push", "wall"};
    static constexpr std::array<const char*, 1> events_names{"axis"};
    struct Parameters {
        S mu = S(1), push = S(0), wall = S(-100);
    } parameters;

    S& parameter(std::size_t k) noexcept
    {
        return k == 0 ? parameters.mu : (k == 1 ? parameters.push : parameters.wall);
    }
    status_t<S> rhs(S t, const State& s, State& ds) const noexcept
    {
        using std::sqrt;
        auto status = StatusOf<S>::good();
        StatusOf<S>::fail(status, s[0] < parameters.wall, Status::singular_mass_matrix);
        const S x = s[0], y = s[1], square = x * x + y * y, cube = square * sqrt(square);
        const S pull = parameters.mu / cube;
        ds[0] = s[2];
        ds[1] = s[3];
        ds[2] = parameters.push * sincos(t).sine - pull * x;
        ds[3] = -pull * y;
        return status;
    }
    Eigen::Matrix<S, 1, 1> events(S, const State& s) const noexcept { return Eigen::Matrix<S, 1, 1>(s[1]); }
    Eigen::Matrix<S, 1, 1> domain(S, const State& s) const noexcept { return Eigen::Matrix<S, 1, 1>(S(3) - s[1]); }
};

/// x'' = -w^2 x with its Taylor coefficients and those of its event.
template <class S>
struct Swing {
    using Scalar = S;
    using State = Eigen::Matrix<S, 2, 1>;
    static constexpr int dimension = 2;
    static constexpr bool takes_packs = true;
    static constexpr SecondOrder second_order = SecondOrder::velocity_free;
    static constexpr std::array<const char*, 1> parameter_names{"w"}, events_names{"middle"};
    struct Parameters {
        S w = S(1);
    } parameters;

    S& parameter(std::size_t) noexcept { return parameters.w; }
    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        ds[0] = s[1];
        ds[1] = -(parameters.w * parameters.w) * s[0];
        return StatusOf<S>::good();
    }
    Eigen::Matrix<S, 1, 1> events(S, const State& s) const noexcept { return Eigen::Matrix<S, 1, 1>(s[0]); }

    template <int most>
    status_t<S> taylor(S, const State& s, int order, TaylorSeries<S, 2, most>& x) const noexcept
    {
        x[0] = {s[0], s[1]};
        const S square = parameters.w * parameters.w;
        for (int k = 0; k < order; ++k) x[k + 1] = {x[k][1] / S(k + 1), -(square * x[k][0]) / S(k + 1)};
        return StatusOf<S>::good();
    }
    template <int most>
    status_t<S> event_series(S, const State&, int order, const TaylorSeries<S, 2, most>& x,
                             TaylorSeries<S, 1, most>& e) const noexcept
    {
        for (int k = 0; k <= order; ++k) e[k][0] = x[k][0];
        return StatusOf<S>::good();
    }
};

/// x' = 1; counts its calls.
template <class S>
struct Counted {
    using Scalar = S;
    using State = Eigen::Matrix<S, 1, 1>;
    static constexpr int dimension = 1;
    static constexpr bool takes_packs = true;
    static inline std::size_t calls = 0;

    status_t<S> rhs(S, const State&, State& ds) const noexcept
    {
        ++calls;
        ds[0] = S(1);
        return StatusOf<S>::good();
    }
};

template <class M>
struct Task {
    M model;
    typename M::State start;
    double end;
};

/// What an observer saw, so that two runs that saw the same have equal sums.
template <class State>
struct Witness {
    double sum = 0;
    std::size_t calls = 0;
    void operator()(double t, const State& s)
    {
        sum = 0.5 * sum + t + s.squaredNorm();
        ++calls;
    }
};

bool is_same(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

template <class M>
void check_same(const Run<M>& one, const Run<M>& other)
{
    CHECK(is_same(one.t, other.t));
    for (Eigen::Index i = 0; i < one.state.size(); ++i) CHECK(is_same(one.state[i], other.state[i]));
    CHECK(one.outcome == other.outcome);
    CHECK(is_same(one.failed_at, other.failed_at));
    CHECK(one.steps == other.steps);
    CHECK(one.rejected == other.rejected);
    CHECK(one.rhs_calls == other.rhs_calls);
    CHECK(one.times == other.times);
    CHECK(one.states == other.states);
    REQUIRE(one.events.size() == other.events.size());
    for (std::size_t k = 0; k < one.events.size(); ++k) {
        CHECK(one.events[k].t == other.events[k].t);
        CHECK(one.events[k].state == other.events[k].state);
    }
}

/// Asks for nothing between rows.
struct Nobody {
    double sum = 0;
    std::size_t calls = 0;
};

template <int N, class Observer, class M, class Method>
void check_observed(const std::vector<Task<M>>& tasks, const std::vector<Method>& methods, const Options<M>& options)
{
    using Given = detail::Trajectory<M, Method, Observer>;
    std::vector<Observer> observers(tasks.size());
    std::vector<Run<M>> runs(tasks.size());
    std::array<Given, std::size_t(N)> given;
    std::array<std::size_t, std::size_t(N)> places{};
    std::size_t next = 0;
    detail::Abreast<M, Method, N, Observer>().run(
        [&](int lane) -> const Given* {
            if (next == tasks.size()) return nullptr;
            const Task<M>& task = tasks[next];
            Given& place = given[std::size_t(lane)];
            place = {&task.model, &task.start,     {0.0, task.end}, &methods[next % methods.size()],
                     &options,    &observers[next]};
            places[std::size_t(lane)] = next++;
            return &place;
        },
        [&](int lane, Run<M>&& run) { runs[places[std::size_t(lane)]] = std::move(run); });
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        INFO("trajectory " << k << ", " << N << " lanes");
        Observer alone;
        check_same(runs[k], integrate(tasks[k].model, tasks[k].start, {0.0, tasks[k].end}, methods[k % methods.size()],
                                      options, alone));
        CHECK(is_same(observers[k].sum, alone.sum));
        CHECK(observers[k].calls == alone.calls);
    }
}

#ifdef LAGEN_ALL_TESTS
constexpr bool all_tests = true;
#else
constexpr bool all_tests = false;
#endif
/// Every task by N lanes and alone: the same bits. Each is compiled for seconds: some are for scripts/test --all.
template <int N, class M, class Method>
void check_abreast(const std::vector<Task<M>>& tasks, const std::vector<Method>& methods, const Options<M>& options)
{
    if constexpr (all_tests || N > 2) check_observed<N, Witness<typename M::State>>(tasks, methods, options);
    if constexpr (all_tests) check_observed<N, Nobody>(tasks, methods, options);
}

std::vector<Task<Orbit<double>>> orbits()
{
    std::vector<Task<Orbit<double>>> tasks;
    for (int k = 0; k < 21; ++k) {
        Orbit<double> model;
        model.parameters = {1 + 0.01 * k, 0.02 * k, -100};
        tasks.push_back({model, {1, 0, 0.01 * k, 0.3 + 0.05 * k}, k % 5 == 0 ? 0.5 * k : 3.0});
    }
    return tasks;
}

/// Every fourth ends at 1, the others at `end`.
std::vector<Task<Swing<double>>> swings(int count, double end)
{
    std::vector<Task<Swing<double>>> tasks;
    for (int k = 0; k < count; ++k) {
        Swing<double> model;
        model.parameters.w = 0.2 * k;
        tasks.push_back({model, {1 + 0.1 * k, 0.3}, k % 4 == 0 ? 1.0 : end});
    }
    return tasks;
}

using Top = models::heavy_top<double>;

std::vector<Task<Top>> tops()
{
    std::vector<Task<Top>> tasks;
    for (int k = 0; k < 19; ++k) {
        Top model;
        model.parameters.mgl = 1 + 0.1 * k;
        const double angle = 0.3 + 0.01 * k;
        tasks.push_back({model,
                         Top::state({.g1 = std::sin(angle), .g3 = std::cos(angle)}, {.w1 = 0.1, .w3 = 1 + 0.3 * k}),
                         k % 3 == 0 ? -2.0 : 4.0});
    }
    return tasks;
}

} // namespace

#ifdef LAGEN_ALL_TESTS
using Adaptive = std::tuple<Dopri5, Tsit5, Dop853, Verner65, Verner76, Verner87, Verner98>;
using FixedStep = std::tuple<Euler, Kutta3, Rk4>;
#else
using Adaptive = std::tuple<Dop853>;
using FixedStep = std::tuple<Rk4>;
#endif

TEMPLATE_LIST_TEST_CASE("A trajectory on a lane has the bits of one alone, by adaptive methods", "", Adaptive)
{
    const std::vector<TestType> methods{TestType{.tolerance = 1e-6}, TestType{.tolerance = 1e-9},
                                        TestType{.relative = 1e-3, .absolute = 1e-5, .max_step = 0.3}};
    check_abreast<2>(orbits(), methods, {});
    check_abreast<8>(orbits(), methods, {});
    check_abreast<4>(tops(), methods, {});
}

TEMPLATE_LIST_TEST_CASE("A trajectory on a lane has the bits of one alone, by methods of fixed step", "", FixedStep)
{
    const std::vector<TestType> methods{TestType{.step = 0.01}, TestType{.step = 0.003}};
    check_abreast<2>(orbits(), methods, {});
    check_abreast<4>(tops(), methods, {});
    check_abreast<4>(tops(), std::vector<TestType>{TestType{.step = 0.01, .compensated = true}}, {});
    check_abreast<4>(tops(), std::vector<TestType>{TestType{.step = 0.01, .compensated = true}, TestType{.step = 0.01}},
                     {});
}

TEST_CASE("Nystrom methods go on lanes")
{
    const std::vector<Task<Swing<double>>> tasks = swings(11, 7);
    const std::vector<double> at{0.5, 1, 6.25};
    check_abreast<4>(tasks, std::vector<Rkn64>{{.tolerance = 1e-7}}, {.at = at});
    check_abreast<4>(tasks, std::vector<Rkn86>{{.tolerance = 1e-9}}, {.at = at});
    check_abreast<4>(tasks, std::vector<Rkng54>{{.tolerance = 1e-6}}, {.at = at});
}

TEST_CASE("Lanes fail, leave the domain and are refused each by itself")
{
    std::vector<Task<Orbit<double>>> tasks = orbits();
    tasks[1].start = {1, 0, -1, 0}; // into the centre
    tasks[3].model.parameters.wall = 0.5;
    tasks[4].start = {1, 2.5, 0, 2}; // over the boundary
    tasks[5].start = {1, 4, 0, 0};   // begins beyond it
    tasks[6].start[2] = std::nan("");
    tasks[7].end = INFINITY;
    tasks[8].end = 0;
    tasks[9].end = -2;
    check_abreast<8>(tasks, std::vector<Dop853>{{.tolerance = 1e-8}}, {});
#ifdef LAGEN_ALL_TESTS
    check_abreast<8>(tasks, std::vector<Dopri5>{{.tolerance = 1e-5}}, {});
    check_abreast<2>(tasks, std::vector<Verner76>{{.tolerance = 1e-7}}, {});
#endif
    tasks[7].end = 1;
    check_abreast<2>(tasks, std::vector<Rk4>{{.step = 0.01}}, {});
    check_abreast<8>(tasks, std::vector<Dop853>{{.tolerance = 1e-8}}, {.max_steps = 7});
    check_abreast<8>(tasks, std::vector<Dop853>{{.tolerance = -1}, {.tolerance = 1e-40}, {.tolerance = 1e-6}}, {});
}

TEST_CASE("Rows, events and solutions of lanes are those of trajectories alone")
{
    const std::vector<double> at{0, 0.1, 0.25, 0.25, 1, 2.9};
    const std::vector<EventRequest<double, Orbit<double>::State>> events{
        {.index = 0, .direction = Crossing::falling},
        {.stop = true, .count = 2, .when = [](double, const Orbit<double>::State& s) { return s[0] - 0.8; }}};
    check_abreast<8>(orbits(), std::vector<Dop853>{{.tolerance = 1e-9}}, {.at = at, .events = events});
    check_abreast<8>(orbits(), std::vector<Dop853>{{.tolerance = 1e-6}}, {.at = at, .events = events, .dense = true});
#ifdef LAGEN_ALL_TESTS
    check_abreast<8>(orbits(), std::vector<Tsit5>{{.tolerance = 1e-6}}, {.at = at, .events = events, .dense = true});
    check_abreast<8>(orbits(), std::vector<Verner98>{{.tolerance = 1e-9}}, {.at = at, .events = events});
    check_abreast<8>(orbits(), std::vector<Rk4>{{.step = 0.01}}, {.at = at, .events = events});
#endif
}

TEST_CASE("Taylor's method goes on lanes, its events too")
{
    std::vector<Task<Swing<double>>> tasks = swings(19, 20);
    const std::vector<double> at{0.5, 1, 7.25};
    const std::vector<EventRequest<double, Swing<double>::State>> events{{.index = 0}};
    const std::vector<Taylor> one{{.tolerance = 1e-12}};
    check_abreast<8>(tasks, one, {});
    check_abreast<8>(tasks, one, {.at = at, .events = events});
    // Two orders: those of the second are integrated alone.
    check_abreast<8>(tasks, std::vector<Taylor>{{.tolerance = 1e-12}, {.tolerance = 1e-6}}, {.at = at});
    tasks[2].start[0] = INFINITY;
    tasks[3].model.parameters.w = 1e200;
    check_abreast<8>(tasks, one, {.at = at, .events = events});
}

TEST_CASE("A lane whose trajectory has ended takes the next one: none waits for the longest")
{
    // On one lane 504 steps, on each of the seven others 63 trajectories of 8 steps.
    std::vector<Task<Counted<double>>> tasks{{{}, Counted<double>::State(1), 63}};
    for (int k = 0; k < 7 * 63; ++k) tasks.push_back({{}, Counted<double>::State(k), 1});
    std::size_t& calls = Counted<Pack<double, 8>>::calls;
    calls = 0;
    check_observed<8, Nobody, Counted<double>, Rk4>(tasks, {{.step = 0.125}}, {});
    CHECK(calls == 4 * 504);
}

TEST_CASE("Ensembles of models that can be had over packs are those of single runs, in order, by any number of threads")
{
    const auto start = [](std::size_t k, Top& each) {
        each.parameters.mgl = 1 + 0.01 * double(k);
        return Top::state({.g3 = 1}, {.w1 = 0.1, .w3 = 1 + 0.1 * double(k % 7)});
    };
    const auto compare = [&](const auto& method) {
        std::vector<Run<Top>> alone;
        for (std::size_t k = 0; k < 50; ++k) {
            Top each;
            const Top::State s = start(k, each);
            alone.push_back(integrate(each, s, {0.0, 2.0}, method));
        }
        for (const std::size_t threads : {1U, 3U})
            for (const std::size_t block : {1U, 3U, 16U}) {
                std::size_t taken = 0;
                ensemble(Top{}, alone.size(), start, {0.0, 2.0}, method,
                         [&](std::size_t k, const Run<Top>& run) {
                             REQUIRE(k == taken++);
                             check_same(run, alone[k]);
                         },
                         {.threads = threads, .block = block});
                CHECK(taken == alone.size());
            }
    };
    compare(Dop853{.tolerance = 1e-8});
#ifdef LAGEN_ALL_TESTS
    compare(Rk4{.step = 0.01});
#endif
    compare(Gauss4{.step = 0.05});
}

TEST_CASE("What a call throws ends an ensemble on lanes, after the trajectories before it")
{
    for (const std::size_t threads : {1U, 4U}) {
        std::size_t taken = 0;
        const auto thrown_by_start = [&] {
            ensemble(
                Top{}, 1000,
                [](std::size_t k, Top&) {
                    if (k == 40) throw std::runtime_error("no start");
                    return Top::state({.g3 = 1}, {.w3 = 5});
                },
                {0.0, 1.0}, Dopri5{}, [&](std::size_t, const Run<Top>&) { ++taken; }, {.threads = threads, .block = 1});
        };
        CHECK_THROWS_WITH(thrown_by_start(), "no start");
        CHECK(taken == 40);
        std::size_t calls = 0;
        const auto thrown_by_take = [&] {
            ensemble(
                Top{}, 1000, [](std::size_t, Top&) { return Top::state({.g3 = 1}, {.w3 = 5}); }, {0.0, 1.0}, Dopri5{},
                [&](std::size_t, const Run<Top>&) {
                    if (++calls == 7) throw std::runtime_error("enough");
                },
                {.threads = threads});
        };
        CHECK_THROWS_WITH(thrown_by_take(), "enough");
        CHECK(calls == 7);
    }
}
