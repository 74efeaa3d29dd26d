// SPDX-License-Identifier: GPL-2.0-or-later
/// lagen::ensemble: many trajectories by several threads, in order.
#include "lagen/ensemble.hpp"
#include "cart_pole.hpp"
#include "heavy_top.hpp"
#include "heisenberg.hpp"
#include "lagen/lagen.hpp"
#include "runtime/pendulum.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace lagen;

namespace {

using Pendulum = problems::Pendulum<double>;
using State = Pendulum::State;

struct Decay {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    double rate = 1;
    Status rhs(double, const State& s, State& ds) const noexcept
    {
        ds[0] = -rate * s[0];
        return Status::ok;
    }
};

/// x' = u - x, with an input and, as headers without parameters have them, no parameters.
template <class S>
struct Pushed {
    using Scalar = S;
    using State = Eigen::Matrix<S, 1, 1>;
    static constexpr int dimension = 1;
    static constexpr bool takes_packs = true;
    static constexpr std::array<const char*, 1> input_names{"u"};
    struct Parameters {
    } parameters;
    struct Inputs {
        S u = S(0);
    } inputs;

    S& input(std::size_t) noexcept { return inputs.u; }
    status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        ds[0] = inputs.u - s[0];
        return StatusOf<S>::good();
    }
};

static_assert(detail::GoesAbreast<Pushed<double>, Rk4>);
static_assert(detail::GoesAbreast<models::heavy_top<double>, Dop853>);
static_assert(detail::GoesAbreast<models::heisenberg<double>, Dop853>, "without parameters");
static_assert(detail::GoesAbreast<models::cart_pole<float>, Rk4>, "with inputs");

State start_of(std::size_t k)
{
    return State(0.01 * static_cast<double>(k), 1);
}

/// Final states of `count` trajectories.
std::vector<State> ends(std::size_t count, const EnsembleOptions<Pendulum>& options)
{
    std::vector<State> found;
    ensemble(
        Pendulum{}, count, [](std::size_t k, Pendulum&) { return start_of(k); }, {0.0, 3.0}, Dop853{.tolerance = 1e-9},
        [&](std::size_t k, const Run<Pendulum>& run) {
            if (k != found.size()) throw std::logic_error("out of order");
            found.push_back(run.state);
        },
        options);
    return found;
}

} // namespace

TEST_CASE("Trajectories of a model without parameters go abreast, each with inputs of its own")
{
    const auto start = [](std::size_t k, Pushed<double>& each) {
        each.inputs.u = 0.1 * static_cast<double>(k);
        return Pushed<double>::State(1);
    };
    ensemble(Pushed<double>{}, 9, start, {0.0, 2.0}, Rk4{.step = 0.01},
             [&](std::size_t k, const Run<Pushed<double>>& run) {
                 Pushed<double> alone;
                 const auto s = start(k, alone);
                 CHECK(run.state[0] == integrate(alone, s, {0.0, 2.0}, Rk4{.step = 0.01}).state[0]);
                 CHECK(std::abs(run.state[0] - (alone.inputs.u + (1 - alone.inputs.u) * std::exp(-2.0))) < 1e-9);
             },
             {.threads = 1});
}

TEST_CASE("An ensemble is handed over in order, with the bits of single runs, by any number of threads")
{
    std::vector<State> single;
    for (std::size_t k = 0; k < 100; ++k)
        single.push_back(integrate(Pendulum{}, start_of(k), {0.0, 3.0}, Dop853{.tolerance = 1e-9}).state);
    for (const std::size_t threads : {1U, 2U, 3U, 7U})
        for (const std::size_t block : {0U, 1U, 16U, 1000U})
            CHECK(ends(100, {.threads = threads, .block = block}) == single);
    CHECK(ends(0, {}).empty());
    CHECK(ends(1, {.threads = 4}).size() == 1);
}

TEST_CASE("Each trajectory of an ensemble has a model of its own")
{
    std::size_t taken = 0;
    ensemble(
        Decay{}, 50,
        [](std::size_t k, Decay& each) {
            CHECK(each.rate == 1);
            each.rate = static_cast<double>(k);
            return Decay::State::Ones().eval();
        },
        {0.0, 1.0}, Rk4{.step = 1.0 / 64},
        [&](std::size_t k, const Run<Decay>& run) {
            CHECK(k == taken++);
            CHECK(std::abs(run.state[0] - std::exp(-static_cast<double>(k))) < 1e-4);
        },
        {.threads = 1});
    CHECK(taken == 50);
}

TEST_CASE("What a call throws ends an ensemble and reaches the caller, after the trajectories before it")
{
    for (const std::size_t threads : {1U, 4U}) {
        std::size_t taken = 0;
        const auto thrown_by_start = [&] {
            ensemble(
                Pendulum{}, 1000,
                [](std::size_t k, Pendulum&) {
                    if (k == 40) throw std::runtime_error("no start");
                    return start_of(k);
                },
                {0.0, 1.0}, Rk4{.step = 0.1}, [&](std::size_t, const Run<Pendulum>&) { ++taken; },
                {.threads = threads, .block = 1});
        };
        CHECK_THROWS_WITH(thrown_by_start(), "no start");
        CHECK(taken == 40);
        std::size_t calls = 0;
        const auto thrown_by_take = [&] {
            ensemble(
                Pendulum{}, 1000, [](std::size_t k, Pendulum&) { return start_of(k); }, {0.0, 1.0}, Rk4{.step = 0.1},
                [&](std::size_t, const Run<Pendulum>&) {
                    if (++calls == 7) throw std::runtime_error("enough");
                },
                {.threads = threads, .block = 1});
        };
        CHECK_THROWS_WITH(thrown_by_take(), "enough");
        CHECK(calls == 7);
    }
}
