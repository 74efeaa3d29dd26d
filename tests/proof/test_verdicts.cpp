// SPDX-License-Identifier: GPL-2.0-or-later
/// Verdicts on random identities of every class of functions and on their near misses: a true identity is never
/// refuted, a false one never proved, and few are left undecided.
#include "problem.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cstdint>
#include <map>

using namespace lagen;
using namespace lagen::test;

namespace {

class Throws {
  public:
    explicit Throws(std::uint64_t seed) : state_(seed * 6364136223846793005ULL + 99991) {}
    int roll(int sides)
    {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(sides));
    }

  private:
    std::uint64_t state_;
};

/// left = right for all P, Q, R (terms) and k (a small integer) on the domain; `odd` says that left is not symmetric,
/// so that left = -right is false.
struct Template {
    const char* kind;
    const char* left;
    const char* right;
    std::vector<std::string> domain;
};

const std::vector<Template>& templates()
{
    static const std::vector<std::string> none, positive{"x > 0", "y > 0", "z > 0"},
        small{"x > -1", "x < 1", "y > 0", "y < 1"};
    static const std::vector<Template> all{
        {"rational", "(P + Q)^3", "P^3 + 3*P^2*Q + 3*P*Q^2 + Q^3", none},
        {"rational", "1/(P*Q)", "(1/P + 1/Q)/(P + Q)", none},
        {"rational", "P/(1 + Q^2) + 1/(1 + R^2)", "(P*(1 + R^2) + 1 + Q^2)/((1 + Q^2)*(1 + R^2))", none},
        {"rational", "P/Q/R", "P/(Q*R)", none},
        {"trigonometric", "sin(P + Q)", "sin(P)*cos(Q) + cos(P)*sin(Q)", none},
        {"trigonometric", "cos(k*P)*2*cos(P)", "cos(k*P + P) + cos(k*P - P)", none},
        {"trigonometric", "sin(P/2)^2", "(1 - cos(P))/2", none},
        {"trigonometric", "tan(P/2)", "sin(P)/(1 + cos(P))", none},
        {"trigonometric", "sin(P)^4", "(3 - 4*cos(2*P) + cos(4*P))/8", none},
        {"trigonometric", "tan(P - Q)", "(tan(P) - tan(Q))/(1 + tan(P)*tan(Q))", none},
        {"hyperbolic", "cosh(P + Q)", "cosh(P)*cosh(Q) + sinh(P)*sinh(Q)", none},
        {"hyperbolic", "tanh(P/2)", "(cosh(P) - 1)/sinh(P)", none},
        {"hyperbolic", "sinh(2*P)", "2*tanh(P)/(1 - tanh(P)^2)", none},
        {"exponential", "exp(P + Q)*exp(-R)", "exp(P - R)*exp(Q)", none},
        {"exponential", "exp(P/3)^2", "exp(P)^(2/3)", none},
        {"exponential", "2^P*3^P", "6^P", none},
        {"exponential", "exp(k*log(x) + P)", "x^k*exp(P)", none},
        {"logarithm", "log((x + k)*y^2)", "log(x + k) + 2*log(y)", positive},
        {"logarithm", "log(P^2 + 1) + 1", "log(3*P^2 + 3) - log(3) + 1", none},
        {"logarithm", "log(P^2)", "2*log(abs(P))", none},
        {"logarithm", "log(sqrt(x/y))", "(log(x) - log(y))/2", positive},
        {"logarithm", "log(exp(P)*(1 + Q^2))", "P + log(1 + Q^2)", none},
        {"root", "sqrt(P^2*(1 + Q^2))", "abs(P)*sqrt(1 + Q^2)", none},
        {"root", "sqrt(x + y + 2*sqrt(x*y))", "sqrt(x) + sqrt(y)", positive},
        {"root", "1/(sqrt(x + k) + sqrt(x))", "(sqrt(x + k) - sqrt(x))/k", positive},
        {"root", "sqrt(x)*x^(1/3)", "x^(5/6)", positive},
        {"root", "sqrt(P^2 + 2*P*Q + Q^2)", "abs(P + Q)", none},
        {"root", "sqrt(1 - sin(P)^2)", "abs(cos(P))", none},
        {"root", "(8*x^2*y)^(1/3)", "2*x^(2/3)*y^(1/3)", positive},
        {"root", "sqrt(2 + 2*cos(P))", "2*abs(cos(P/2))", none},
        {"constant", "sqrt(k + 3 + 2*sqrt(3*k))*(1 + P^2)", "(sqrt(k) + sqrt(3))*(1 + P^2)", none},
        {"constant", "(7 + 5*sqrt(2))^(1/3) + P^2", "1 + sqrt(2) + P^2", none},
        {"absolute", "abs(P*Q)", "abs(P)*abs(Q)", none},
        {"absolute", "max(P, Q) - min(P, Q)", "abs(P - Q)", none},
        {"absolute", "if(x > y, P, Q)*(x - y)", "(P + Q)*(x - y)/2 + (P - Q)*abs(x - y)/2", none},
        {"absolute", "sign(P)*P", "abs(P)", none},
        {"absolute", "abs(P + abs(P))", "P + abs(P)", none},
        {"inverse", "sin(2*atan(P))", "2*P/(1 + P^2)", none},
        {"inverse", "cos(atan2(P, Q))", "P*0 + Q/sqrt(P^2 + Q^2)", none},
        {"inverse", "tan(asin(x))", "x/sqrt(1 - x^2)", none},
        {"inverse", "asin(x)", "pi/2 - acos(x)", none},
        {"inverse", "atan(y) + atan(1/y)", "pi/2", positive},
        {"inverse", "atan2(y, x)", "pi/2 - atan(x/y)", positive},
        {"inverse", "acos(cos(y))", "y", small},
        {"domain", "sqrt((y - x)^2)", "y - x", {"x > k", "y > x"}},
        {"domain", "abs(1 - x*y)", "1 - x*y", small},
        {"domain", "log(x^2 - 1)", "log(x - 1) + log(x + 1)", {"x > 1"}},
        {"domain", "sqrt((1 - x^2)^2)", "1 - x^2", {"x^2 + y^2 < 1"}},
        {"domain", "abs(sin(x))", "sin(x)", {"x > 0", "x < pi"}},
        {"domain", "sqrt((x*y - k)^2)", "x*y - k", {"x > 1", "y > k"}},
    };
    return all;
}

/// Three different terms and a number from 2 to 6.
std::array<std::string, 4> draw(Throws& dice)
{
    static const std::array<const char*, 10> terms{"x",     "y",         "(x + 2*y)",     "(x - y/2)", "(z - 3)",
                                                   "(x*y)", "(2*x + 1)", "(x - y + z/3)", "(x^2 - y)", "(1 + x*z)"};
    const int first = dice.roll(10), second = first + 1 + dice.roll(4), third = second + 1 + dice.roll(4);
    const auto term = [](int k) { return std::string(terms[static_cast<std::size_t>(k % 10)]); };
    return {term(first), term(second), term(third), std::to_string(2 + dice.roll(5))};
}

std::string filled(const std::string& text, const std::array<std::string, 4>& terms)
{
    const std::string marks = "PQRk";
    std::string result;
    for (std::size_t j = 0; j < text.size(); ++j) {
        const std::size_t mark = marks.find(text[j]);
        if (mark == std::string::npos)
            result += text[j];
        else
            result += terms[mark];
    }
    return result;
}

struct Tally {
    int proved = 0, refuted = 0, undecided = 0;
    std::string open; ///< the first undecided texts
    void count(ProofStatus status, const std::string& text)
    {
        proved += status == ProofStatus::proved ? 1 : 0;
        refuted += status == ProofStatus::refuted ? 1 : 0;
        undecided += status == ProofStatus::undecided ? 1 : 0;
        if (status == ProofStatus::undecided && open.size() < 1500) open += "\n  " + text;
    }
};

/// left - right made false: by a relative 1e-12 .. 1e-15, by a sign, or by a small term.
std::string missed(const std::string& left, const std::string& right, Throws& dice)
{
    switch (dice.roll(4)) {
    case 0: return '(' + left + ")*(1 + 1/10^" + std::to_string(12 + dice.roll(4)) + ") - (" + right + ')';
    case 1: return '(' + left + ") + (" + right + ')';
    case 2: return '(' + left + ") - (" + right + ") + x^2/10^15";
    default: return '(' + left + ") - (1 - 1/10^13)*(" + right + ')';
    }
}

} // namespace

TEST_CASE("random identities of every class are proved, their near misses refuted, and no verdict is wrong")
{
    constexpr std::uint64_t rounds = 24;
    std::map<std::string, Tally> truths, misses;
    for (std::uint64_t round = 0; round < rounds; ++round)
        for (std::size_t k = 0; k < templates().size(); ++k) {
            const Template& entry = templates()[k];
            Throws dice(round * 1000 + k);
            const std::array<std::string, 4> terms = draw(dice);
            Statement statement{{"x", "y", "z"}, {}, {}, {}, {}};
            for (const std::string& text : entry.domain) statement.domain.push_back(filled(text, terms));
            const std::string left = filled(entry.left, terms), right = filled(entry.right, terms);
            Problem problem(statement);
            const NodeId residual = problem.node(left + " - (" + right + ')');
            const Decision same = problem.decider->decide(residual);
            INFO(left << "  =  " << right << ": " << same.residual << "; " << same.evidence);
            CHECK(to_text(same.status) != std::string("refuted"));
            truths[entry.kind].count(same.status, left + " - (" + right + ')');
            if (same.status == ProofStatus::proved && round % 4 == 0)
                CHECK(problem.decider->largest_bound(residual, 2) < 1e-60);
            const std::string text = missed(left, right, dice);
            const Decision other = problem.decide(text);
            INFO(text);
            CHECK(to_text(other.status) != std::string("proved"));
            misses[entry.kind].count(other.status, text);
        }
    for (const auto& [kind, tally] : truths) {
        INFO(kind << ": " << tally.proved << " proved, " << tally.undecided << " undecided" << tally.open);
        CHECK(tally.undecided <= tally.proved / 50);
    }
    for (const auto& [kind, tally] : misses) {
        INFO(kind << ": " << tally.refuted << " near misses refuted, " << tally.undecided << " undecided"
                  << tally.open);
        CHECK(tally.undecided <= tally.refuted / 50);
    }
}

TEST_CASE("what holds on one branch only is refuted or left open, never proved")
{
    const char* const texts[] = {"sqrt(P^2) - P",
                                 "sqrt((P + Q + z)^2) - P - Q - z",
                                 "abs(P) - P",
                                 "asin(sin(P)) - P",
                                 "acos(cos(P)) - P",
                                 "atan(tan(P)) - P",
                                 "atan2(P, Q) - atan(P/Q)",
                                 "log(P^2) - 2*log(P) + P*0 + sqrt(x^2) - x",
                                 "max(P, Q) - P",
                                 "sign(P) - 1",
                                 "if(x > y, P, Q) - P",
                                 "sqrt(1 - cos(P)^2) - sin(P)",
                                 "sqrt(P^4) + P^2",
                                 "(P^2)^(1/4) - sqrt(P) + abs(Q) - Q",
                                 "atan(P) + atan(1/P) - pi/2",
                                 "acos(P) + asin(P)",
                                 "abs(P*Q) - P*abs(Q)",
                                 "sqrt(2 + 2*cos(P)) - 2*cos(P/2)"};
    int refuted = 0, all = 0;
    for (std::uint64_t round = 0; round < 20; ++round)
        for (std::size_t k = 0; k < std::size(texts); ++k) {
            Throws dice(round * 77 + k);
            Problem problem({{"x", "y", "z"}, {}, {}, {}, {}});
            const std::string text = filled(texts[k], draw(dice));
            const Decision decision = problem.decide(text);
            INFO(text << ": " << decision.evidence);
            CHECK(to_text(decision.status) != std::string("proved"));
            refuted += decision.status == ProofStatus::refuted ? 1 : 0;
            ++all;
        }
    CHECK(refuted >= all * 9 / 10);
}
