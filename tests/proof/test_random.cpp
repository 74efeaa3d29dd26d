// SPDX-License-Identifier: GPL-2.0-or-later
#include "problem.hpp"

#include <catch2/catch.hpp>

#include <cstdint>

using namespace lagen;
using namespace lagen::test;

namespace {

/// A small fixed generator, so that the cases are the same everywhere.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}
    std::size_t roll(std::size_t sides)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>((state_ >> 33) % sides);
    }

  private:
    std::uint64_t state_;
};

/// An expression and another text of the same value.
struct Twin {
    std::string left, right;
};

Twin leaf(Dice& dice)
{
    static const char* const names[] = {"x", "y", "z"};
    const std::string name = names[dice.roll(3)];
    switch (dice.roll(5)) {
    case 0: return {name, name};
    case 1: return {"sin(" + name + ")", "(2*sin(" + name + "/2)*cos(" + name + "/2))"};
    case 2: return {"cos(" + name + " + y)", "(cos(" + name + ")*cos(y) - sin(" + name + ")*sin(y))"};
    case 3: return {"sin(x - " + name + ")", "(-sin(" + name + " - x))"};
    default: return {std::to_string(dice.roll(5) + 1), "(cos(z)^2 + sin(z)^2)*0 + "};
    }
}

Twin grow(Dice& dice, int depth)
{
    if (depth == 0) {
        Twin twin = leaf(dice);
        if (twin.right.back() == ' ') twin.right = '(' + twin.right + twin.left + ')';
        return twin;
    }
    const Twin a = grow(dice, depth - 1), b = grow(dice, depth - 1);
    switch (dice.roll(5)) {
    case 0: return {'(' + a.left + " + " + b.left + ')', '(' + b.right + " - (-" + a.right + "))"};
    case 1: return {'(' + a.left + "*(" + b.left + " + 1))", '(' + a.right + '*' + b.right + " + " + a.right + ')'};
    case 2:
        return {"((" + a.left + " - " + b.left + ")^2)",
                '(' + a.right + "^2 - 2*" + a.right + '*' + b.right + " + " + b.right + "^2)"};
    case 3: return {"(" + a.left + "/(2 + " + b.left + "^2))", "(3*" + a.right + "/(6 + 3*" + b.right + "^2))"};
    default:
        return {"((" + a.left + " + " + b.left + "*x)/(3 + x^2))",
                '(' + a.right + "/(x^2 + 3) + x/(3 + x^2)*" + b.right + ')'};
    }
}

} // namespace

TEST_CASE("random expressions equal their rewritings, and a mutation of one of them is never proved equal")
{
    std::size_t proved = 0, refuted = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Dice dice(seed * 977);
        const Twin twin = grow(dice, 1 + static_cast<int>(seed % 2));
        Problem problem({{"x", "y", "z"}, {}, {}, {}, {}});
        const Decision same = problem.decide(twin.left + " - (" + twin.right + ")");
        INFO(twin.left << "  against  " << twin.right << ": " << same.residual);
        CHECK(to_text(same.status) != std::string("refuted"));
        proved += same.status == ProofStatus::proved ? 1 : 0;
        const char* const mutations[] = {"x/10^20", "sin(y)^3/10^15", "(x - y)/(1 + z^2)", "1/10^40"};
        const Decision other = problem.decide(twin.left + " - (" + twin.right + ") + " + mutations[dice.roll(4)]);
        CHECK(to_text(other.status) != std::string("proved"));
        refuted += other.status == ProofStatus::refuted ? 1 : 0;
    }
    CHECK(proved == 60);
    CHECK(refuted == 60);
}
