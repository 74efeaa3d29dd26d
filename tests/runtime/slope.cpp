// SPDX-License-Identifier: GPL-2.0-or-later
/// Slopes of long runs: what is round-off, what swings, and what drifts.
#include "lagen_run/slope.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace lagen::detail;

namespace {

/// The slope of value(0), value(1), .. at the times 0, h, 2 h, ..
template <class Value>
Slope slope_of(std::size_t number, double h, const Value& value)
{
    BatchMeans means;
    means.begin(1);
    for (std::size_t n = 0; n < number; ++n)
        if (const std::array at_n{value(n)}; means.wants()) means.see(static_cast<double>(n) * h, at_n);
    return means.slope(0);
}

/// The part of `trials` series, with the slope 0 each, whose slope is within its error.
template <class Series>
double coverage(std::size_t trials, std::size_t number, Series series)
{
    std::mt19937_64 random(20261123);
    std::size_t covered = 0;
    for (std::size_t trial = 0; trial < trials; ++trial) {
        auto next = series(random);
        const Slope slope = slope_of(number, 0.5, [&](std::size_t) { return next(); });
        covered += std::abs(slope.value) <= slope.error ? 1U : 0U;
    }
    return static_cast<double>(covered) / static_cast<double>(trials);
}

/// The same by least squares that take the departures of all values as independent.
double naive_coverage(std::size_t trials, std::size_t number)
{
    std::mt19937_64 random(20261123);
    std::normal_distribution<double> step;
    std::size_t covered = 0;
    const auto n = static_cast<double>(number);
    for (std::size_t trial = 0; trial < trials; ++trial) {
        std::vector<double> walk(number); // from 0
        for (std::size_t k = 1; k < number; ++k) walk[k] = walk[k - 1] + step(random);
        double sum = 0, first = 0, squares = 0;
        const double middle = (n - 1) / 2, spread = n * (n * n - 1) / 12;
        for (std::size_t k = 0; k < number; ++k) {
            sum += walk[k];
            first += (static_cast<double>(k) - middle) * walk[k];
        }
        const double slope = first / spread;
        for (std::size_t k = 0; k < number; ++k)
            squares += std::pow(walk[k] - sum / n - slope * (static_cast<double>(k) - middle), 2);
        covered += std::abs(slope) <= 1.96 * std::sqrt(squares / (n - 2) / spread) ? 1U : 0U;
    }
    return static_cast<double>(covered) / static_cast<double>(trials);
}

} // namespace

TEST_CASE("the slope of a random walk is within its error nineteen times in twenty", "[slope]")
{
    const auto walk = [](std::mt19937_64& random) {
        return [&random, step = std::normal_distribution<double>(), at = 0.0]() mutable { return at += step(random); };
    };
    // Of 2000 series, 0.005 is one standard deviation; batches of one value have no neighbours that share anything.
    CHECK(coverage(2000, 2000, walk) == Approx(0.95).margin(0.02));
    CHECK(coverage(2000, 2900, walk) == Approx(0.95).margin(0.02));
    CHECK(coverage(2000, 10, walk) > 0.95);
    // What takes the departures as independent is wrong nearly every time.
    CHECK(naive_coverage(400, 2000) < 0.15);
}

TEST_CASE("independent errors and errors that last for a while are within the error of the slope", "[slope]")
{
    const auto forgetful = [](double memory) {
        return [memory](std::mt19937_64& random) {
            return [&random, memory, step = std::normal_distribution<double>(), at = 0.0]() mutable {
                return at = memory * at + step(random);
            };
        };
    };
    for (const double memory : {0.0, 0.9, 0.99, 0.999}) CHECK(coverage(500, 4000, forgetful(memory)) > 0.95);
}

TEST_CASE("a swing has no slope, and a bound of it that falls with the square of the time", "[slope]")
{
    double before = 0;
    for (const std::size_t number : {std::size_t{1'000}, std::size_t{8'000}}) { // every step counts
        const Slope slope = slope_of(number, 0.01, [](std::size_t n) { return std::cos(0.913 * double(n)); });
        CHECK(std::abs(slope.value) <= slope.error);
        if (before > 0) CHECK(slope.error < before / 32);
        before = slope.error;
    }
    // Of any period from one turn in a run to a dozen steps, and of any phase.
    const auto swing = [](std::mt19937_64& random) {
        std::uniform_real_distribution<double> unit;
        return [turns = std::exp(std::log(2000.0) * unit(random)), phase = 2 * M_PI * unit(random), n = 0.0]() mutable {
            return std::sin(phase + 2 * M_PI * turns * (n++) / 23'000);
        };
    };
    CHECK(coverage(2000, 23'000, swing) > 0.94);
    const Slope million = slope_of(1'000'000, 0.01, [](std::size_t n) { return std::cos(0.0913 * double(n)); });
    CHECK(std::abs(million.value) <= million.error);
    CHECK(million.error < 1e-5); // of a swing by 1, after 1e4 units of time: less than a tenth of it in all
}

TEST_CASE("a drift is found under a swing and under a random walk, with its slope", "[slope]")
{
    const Slope line = slope_of(100'000, 0.01, [](std::size_t n) { return 3 + 2e-5 * 0.01 * double(n); });
    CHECK(line.value == Approx(2e-5).epsilon(1e-9));
    CHECK(line.error < 1e-9 * line.value);
    const Slope under =
        slope_of(1'000'000, 0.01, [](std::size_t n) { return std::cos(0.0913 * double(n)) + 2e-5 * 0.01 * double(n); });
    CHECK(under.error < 1e-5);
    CHECK(std::abs(under.value - 2e-5) <= under.error);
    std::mt19937_64 random(7);
    std::normal_distribution<double> step;
    double walk = 0;
    const Slope lost = slope_of(100'000, 1, [&](std::size_t n) { return (walk += step(random)) + 0.05 * double(n); });
    CHECK(std::abs(lost.value - 0.05) <= 1.5 * lost.error);
    CHECK(lost.error < 0.05 / 4);
}

TEST_CASE("fewer than eight values have no slope, and what does not move has the slope 0", "[slope]")
{
    const auto constant = [](std::size_t) { return 2.5; };
    CHECK(std::isnan(slope_of(7, 1, constant).value));
    for (const std::size_t number : {8U, 31U, 1000U}) {
        const Slope slope = slope_of(number, 1, constant);
        CHECK(std::abs(slope.value) < 1e-15);
        CHECK(slope.error < 1e-15);
    }
}

TEST_CASE("Student's quantile is that of the tables to 0.6 %", "[slope]")
{
    for (const auto& [n, value] : {std::pair(6.0, 2.4469), {14.0, 2.1448}, {29.0, 2.0452}})
        CHECK(student_quantile(n) == Approx(value).epsilon(6e-3));
}
