// SPDX-License-Identifier: GPL-2.0-or-later
/// `verify` against an oracle that shares no code with it, on random algebroids and on near misses.
#include "verify/checking.hpp"
#include "verify/random_algebroids.hpp"

#include "support/sanitized.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using namespace lagen::oracle;

namespace {
constexpr std::size_t trials = LAGEN_SANITIZED ? 60 : 500;
}

TEST_CASE("five hundred random algebroids in random frames are proved, each of them")
{
    for (std::size_t number = 0; number < trials; ++number) {
        Dice dice(number);
        const RandomAlgebroid algebroid = random_algebroid(number, dice);
        REQUIRE(holds_at_points(algebroid, dice));
        const std::string text = model_text(algebroid);
        INFO(text);
        CHECK(verified_text(text).structure.verdict == Verdict::valid);
    }
}

TEST_CASE("one changed entry in a random algebroid is refuted exactly where the oracle finds a violation")
{
    std::size_t violated = 0;
    for (std::size_t number = 0; number < trials; ++number) {
        Dice dice(1000 + number);
        const RandomAlgebroid near_miss = mutated(random_algebroid(number, dice), dice);
        const bool valid = holds_at_points(near_miss, dice);
        const std::string text = model_text(near_miss);
        INFO(text);
        CHECK(verified_text(text).structure.verdict == (valid ? Verdict::valid : Verdict::invalid));
        violated += valid ? 0 : 1;
    }
    CHECK(violated > 4 * trials / 5);
}
