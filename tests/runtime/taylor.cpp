// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method on recurrences written by hand: order, digits, dense output, events, kinks, failures.
#include "runtime/taylor_models.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;
using namespace lagen::testing;

namespace {

template <class S>
typename Prey<S>::State far(const Taylor& method, S end = S(5))
{
    const auto run = integrate(Prey<S>{}, typename Prey<S>::State(S(2), S(0.5)), {S(0), end}, method);
    REQUIRE(run);
    REQUIRE(run.t == end);
    return run.state;
}

using EventOf = EventRequest<double, Sway::State>;

} // namespace

TEST_CASE("sums over lower orders are the products of series, in any number, in every scalar")
{
    const auto check = []<class S, int count>(S, std::integral_constant<int, count>) {
        constexpr int most = 24;
        LowerSums<S, count, most> sums;
        LowerSquares<S, count, most> squares;
        std::array<std::array<S, count>, most + 1> a{}, b{};
        std::mt19937 random(7);
        for (int k = 1; k <= most; ++k) {
            const auto found = sums(k), square = squares(k);
            for (std::size_t m = 0; m < count; ++m) {
                S expected = S(0), expected_square = S(0);
                for (int j = 1; j < k; ++j) {
                    expected += a[static_cast<std::size_t>(j)][m] * b[static_cast<std::size_t>(k - j)][m];
                    expected_square += a[static_cast<std::size_t>(j)][m] * a[static_cast<std::size_t>(k - j)][m];
                }
                REQUIRE(found[m] == expected);
                REQUIRE(square[m] == expected_square);
            }
            // Small integers: every order of summation is exact.
            for (auto* side : {&a, &b})
                for (S& entry : (*side)[static_cast<std::size_t>(k)]) entry = S(static_cast<int>(random() % 19) - 9);
            sums.keep(k, a[static_cast<std::size_t>(k)], b[static_cast<std::size_t>(k)]);
            squares.keep(k, a[static_cast<std::size_t>(k)]);
        }
    };
    const auto check_all = [&]<int... count>(auto scalar, std::integer_sequence<int, count...>)
    {
        (check(scalar, std::integral_constant<int, count + 1>{}), ...);
    };
    check_all(1.0F, std::make_integer_sequence<int, 20>{});
    check_all(1.0, std::make_integer_sequence<int, 20>{});
    check_all(1.0L, std::make_integer_sequence<int, 3>{});
}

TEST_CASE("Taylor polynomials and their slopes, of any number of functions and any order, in every scalar")
{
    const auto check = []<class S, int count>(S, std::integral_constant<int, count>) {
        TaylorSeries<S, count, 9> x;
        TaylorSeries<S, -1, 9> later;
        later.resize(static_cast<std::size_t>(count));
        for (int k = 0; k <= 9; ++k)
            for (int i = 0; i < count; ++i) {
                const auto place = static_cast<std::size_t>(i);
                later[k][place] = x[k][place] = S((5 * k + 3 * i) % 11 - 5);
            }
        const auto all_of = [](const auto& series, int order) {
            std::array<std::array<S, count>, 2> all{}; // sums and slopes
            detail::polynomial_sums<true>(series, order, S(3)).each([&](auto part, const auto& sum, const auto& slope) {
                part.store(all[0], sum);
                part.store(all[1], slope);
            });
            return all;
        };
        for (int order = 2; order <= 9; ++order) {
            const auto [sums, slopes] = all_of(x, order);
            REQUIRE(all_of(later, order)[0] == sums);
            REQUIRE(all_of(later, order)[1] == slopes);
            for (std::size_t i = 0; i < count; ++i) {
                S sum = S(0), slope = S(0), power = S(1); // of whole numbers: exact
                for (int k = 1; k <= order; ++k, power *= S(3)) {
                    sum += x[k][i] * power;
                    slope += S(k) * x[k][i] * power;
                }
                REQUIRE(sums[i] == sum);
                REQUIRE(slopes[i] == slope);
            }
        }
    };
    const auto check_all = [&]<int... count>(auto scalar, std::integer_sequence<int, count...>)
    {
        (check(scalar, std::integral_constant<int, count + 1>{}), ...);
    };
    check_all(1.0F, std::make_integer_sequence<int, 20>{});
    check_all(1.0, std::make_integer_sequence<int, 20>{});
    check_all(1.0L, std::make_integer_sequence<int, 3>{});
}

TEST_CASE("Taylor's method of order p has order p")
{
    using Real = long double;
    const auto exact = far<Real>({.tolerance = 1e-18});
    for (const int p : {3, 5, 8}) {
        Real before = 0;
        for (const double step : {0.03125, 0.015625}) {
            const Real error =
                (far<Real>({.tolerance = 1e6, .first_step = step, .max_step = step, .order = p}) - exact).norm();
            INFO("order " << p << ", step " << step << ", error " << static_cast<double>(error));
            if (step < 0.02) CHECK(std::abs(std::log2(before / error) - p) < tolerance::order);
            before = error;
        }
    }
}

TEST_CASE("the order grows with the digits that are asked for and those that there are")
{
    const auto order = []<class S>(S, double tolerance) {
        return TaylorStepper<Prey<S>>(Taylor{.tolerance = tolerance}).order();
    };
    CHECK(order(1.0, 1e-6) == 16);
    CHECK(order(1.0, 1e-12) == 24);
    CHECK(order(1.0, 1e-30) == order(1.0, 1e-16));
    CHECK(order(1.0F, 1e-30) < order(1.0, 1e-30));
    CHECK(order(1.0L, 1e-18) == 22);
    CHECK(TaylorStepper<Prey<double>>(Taylor{.order = 5}).order() == 5);
}

TEST_CASE("errors follow the tolerance down to the rounding of the scalar")
{
    const Eigen::Vector2d exact = far<long double>({.tolerance = 1e-19}).cast<double>();
    for (const double tolerance : {1e-4, 1e-7, 1e-10, 1e-13}) {
        const double error = (far<double>({.tolerance = tolerance}) - exact).norm();
        CHECK(error < 30 * tolerance);
        CHECK(error > 1e-4 * tolerance);
    }
    CHECK((far<double>({.tolerance = 1e-16}) - exact).norm() < 2e-15);
    CHECK((far<float>({.tolerance = 1e-7}).cast<double>() - exact).norm() < 1e-6);
    CHECK((far<double>({.tolerance = 1e-13}, -5) - far<long double>({.tolerance = 1e-19}, -5).cast<double>()).norm() <
          1e-11);
}

TEST_CASE("the polynomial is the dense output, and rows do not change the steps")
{
    const Prey<double> model;
    const Eigen::Vector2d s(2, 0.5);
    const Taylor method{.tolerance = 1e-13};
    const std::vector<double> times{0.1, 1.7, 2.9, 4.4, 5.0};
    const auto plain = integrate(model, s, {0.0, 5.0}, method);
    const auto run = integrate(model, s, {0.0, 5.0}, method, {.at = times, .dense = true});
    REQUIRE(run);
    CHECK(run.steps == plain.steps);
    CHECK(run.state == plain.state);
    REQUIRE(run.states.size() == times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        const Eigen::Vector2d exact =
            far<long double>({.tolerance = 1e-19}, static_cast<long double>(times[k])).cast<double>();
        CHECK((run.states[k] - exact).norm() < 1e-11);
        CHECK((run.solution(times[k]) - exact).norm() < 1e-11);
    }
    CHECK(run.rhs_calls == run.steps + 2);
}

TEST_CASE("two crossings of an event that are 3e-5 apart in a step of 2 are both found")
{
    const std::vector<EventOf> events{{.index = 0, .direction = Crossing::any, .stop = false},
                                      {.index = 1, .direction = Crossing::any, .stop = false}};
    const auto run = integrate(Sway{}, {0.0, 1.0}, {0.0, 40.0}, Taylor{.tolerance = 1e-14}, {.events = events});
    REQUIRE(run);
    CHECK(run.steps < 30);
    std::vector<double> tops, turns;
    for (const auto& event : run.events) (event.request == 0 ? tops : turns).push_back(event.t);
    const double pi = std::acos(-1.0), half = std::acos(Sway::top);
    REQUIRE(turns.size() == 13);
    REQUIRE(tops.size() == 14);
    for (std::size_t k = 0; k < turns.size(); ++k)
        CHECK(std::abs(turns[k] - pi * (static_cast<double>(k) + 0.5)) < 1e-12);
    // x is within 1e-10 of its top: a rounding of 1e-16 moves the crossing by 1e-11.
    for (std::size_t k = 0; k < tops.size(); ++k)
        CHECK(std::abs(tops[k] - (pi * (0.5 + 2 * static_cast<double>(k / 2)) + (k % 2 == 0 ? -half : half))) < 1e-9);
}

TEST_CASE("the roots of polynomials are isolated, each change of sign in a part of its own")
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-0.5, 1.5);
    for (int round = 0; round < 300; ++round) {
        constexpr std::size_t size = 9;
        std::vector<double> roots;
        std::array<double, size> c{1};
        for (std::size_t n = 1; n < size; ++n) {
            const double root = place(random);
            if (root > 0 && root <= 1) roots.push_back(root);
            for (std::size_t k = n; k > 0; --k) c[k] = c[k - 1] - root * c[k];
            c[0] *= -root;
        }
        std::vector<double> ends;
        detail::RootIsolation<double, size>::isolate(c, size, 1e-13, [&](double end) { ends.push_back(end); });
        CHECK(std::is_sorted(ends.begin(), ends.end()));
        std::sort(roots.begin(), roots.end());
        for (std::size_t k = 0; k + 1 < roots.size(); ++k) {
            if (roots[k + 1] - roots[k] < 1e-9) continue;
            const auto between = [&](double end) { return end >= roots[k] - 1e-9 && end <= roots[k + 1] + 1e-9; };
            CHECK(std::any_of(ends.begin(), ends.end(), between));
        }
        if (!roots.empty()) CHECK(ends.back() >= roots.back() - 1e-9);
    }
}

TEST_CASE("multiple roots and what is all noise are isolated in few parts")
{
    const auto parts_of = [](const std::array<double, 5>& c) {
        int parts = 0;
        detail::RootIsolation<double, 5>::isolate(c, 5, 1e-14, [&](double) { ++parts; });
        return parts;
    };
    CHECK(parts_of({0.09, -0.6, 1, 0, 0}) >= 1); // (x - 0.3)^2
    CHECK(parts_of({0.09, -0.6, 1, 0, 0}) <= 1100);
    CHECK(parts_of({-0.027, 0.27, -0.9, 1, 0}) >= 1); // (x - 0.3)^3
    CHECK(parts_of({-0.027, 0.27, -0.9, 1, 0}) <= 1100);
    CHECK(parts_of({0, 0, 0, 0, 1}) <= 1100);
}

TEST_CASE("a run leaves its domain inside a step that ends within it")
{
    struct Walled : Sway {
        Eigen::Matrix<double, 1, 1> domain(double, const State& s) const noexcept
        {
            return Eigen::Matrix<double, 1, 1>(0.9 - s[0]);
        }
    };
    const auto run = integrate(Walled{}, {0.0, 1.0}, {0.0, 3.0}, Taylor{.tolerance = 1e-12});
    CHECK(run.status() == Status::left_domain);
    CHECK(run.t == Approx(std::asin(0.9)).margin(1e-3));
    CHECK(run.state[0] <= 0.9);
}

TEST_CASE("a run ends where a condition of its domain has a root, though the motion is back before the step ends")
{
    static_assert(HasDomainSeries<Capped>);
    const double crossing = std::asin(1 - 1e-10);
    const auto run = integrate(Capped{}, {0.0, 1.0}, {0.0, 30.0}, Taylor{.tolerance = 1e-12});
    CHECK(run.status() == Status::left_domain);
    CHECK(std::abs(run.t - crossing) < 1e-10);
    CHECK(run.failed_at >= run.t);
    CHECK(run.failed_at - run.t < 1e-14);
    CHECK(run.rejected < 5);
    // Nor does an end within a hundredth of a step behind the crossing make it try for ever.
    for (const double rest : {1e-9, 1e-6, 1e-3, 0.01, 0.1}) {
        const auto near = integrate(Capped{}, {0.0, 1.0}, {0.0, crossing + rest}, Taylor{.tolerance = 1e-12});
        CHECK(near.status() == Status::left_domain);
        CHECK(std::abs(near.t - crossing) < 1e-10);
        CHECK(near.rejected < 20);
    }
}

TEST_CASE("a state that is no number is no end of a step")
{
    const auto run = integrate(Ramp{Ramp::Kind::kink}, Ramp::State(1e300), {0.0, 100.0}, Taylor{.tolerance = 1e-10});
    CHECK_FALSE(run);
    CHECK(std::isfinite(run.state[0]));
}

TEST_CASE("a kink inside a step is noticed by the equation at its end")
{
    const auto run = integrate(Ramp{}, Ramp::State(-0.5), {0.0, 1.0}, Taylor{.tolerance = 1e-10});
    REQUIRE(run);
    CHECK(run.rejected > 0);
    CHECK(std::abs(run.state[0] - std::expm1(0.5)) < 1e-8);
}

TEST_CASE("a run into a pole or into a singular matrix ends there with a status")
{
    const auto pole = integrate(Ramp{Ramp::Kind::pole}, Ramp::State(1.0), {0.0, 2.0}, Taylor{});
    CHECK_FALSE(pole);
    CHECK(pole.t == Approx(1.0).margin(1e-6));
    CHECK((pole.status() == Status::step_too_small || pole.status() == Status::non_finite));
    const auto singular = integrate(Ramp{Ramp::Kind::singular}, Ramp::State(0.5), {0.0, 2.0}, Taylor{});
    CHECK(singular.status() == Status::singular_mass_matrix);
    CHECK(singular.state[0] == Approx(1.0).margin(1e-9));
    const auto refused = integrate(Ramp{}, Ramp::State(0.5), {0.0, 2.0}, Taylor{.tolerance = -1});
    CHECK(refused.status() == Status::invalid_input);
}
