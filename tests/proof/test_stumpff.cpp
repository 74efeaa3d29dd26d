// SPDX-License-Identifier: GPL-2.0-or-later
/// Stumpff functions in the zero decision: identities, their near misses, rotations, and arguments that vanish on a
/// component.
#include "graph/calculus/differentiate.hpp"
#include "problem.hpp"
#include "proof/enclosure.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace lagen;
using namespace lagen::test;

namespace {

using Matrix = std::array<NodeId, 9>;

/// 3 x 3 matrices of nodes, by rows.
class Rotations : public Problem {
  public:
    Rotations() : Problem({{"v1", "v2", "v3"}, {}, {}, {}, {}}) {}

    Matrix hat() { return named({"0", "-v3", "v2", "v3", "0", "-v1", "-v2", "v1", "0"}); }
    Matrix one() { return named({"1", "0", "0", "0", "1", "0", "0", "0", "1"}); }

    /// 1 + c_1 V + sign c_2 V V.
    Matrix exponential(const std::string& sign = "1")
    {
        const std::string z = ", v1^2 + v2^2 + v3^2)";
        return sum(sum(one(), node("stumpff(1" + z), hat()), node(sign + "*stumpff(2" + z), product(hat(), hat()));
    }

    /// (1 - V/2)^-1 (1 + V/2).
    Matrix cayley()
    {
        const Matrix left = sum(one(), graph.constant(Rational(-1, 2)), hat());
        const Matrix right = sum(one(), graph.constant(Rational(1, 2)), hat());
        Matrix result;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::vector<NodeId> column{right[j], right[3 + j], right[6 + j]};
            const auto z = graph.solve(left, column, MatrixStructure::general);
            for (std::size_t i = 0; i < 3; ++i) result[3 * i + j] = z[i];
        }
        return result;
    }

    Matrix sum(Matrix a, NodeId factor, const Matrix& b)
    {
        for (std::size_t k = 0; k < 9; ++k) a[k] = graph.add(a[k], graph.multiply(factor, b[k]));
        return a;
    }

    Matrix product(const Matrix& a, const Matrix& b)
    {
        Matrix result;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                NodeId entry = graph.constant(0);
                for (std::size_t k = 0; k < 3; ++k)
                    entry = graph.add(entry, graph.multiply(a[3 * i + k], b[3 * k + j]));
                result[3 * i + j] = entry;
            }
        return result;
    }

    static Matrix transposed(const Matrix& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }

    NodeId determinant(const Matrix& a)
    {
        const auto minor = [&](std::size_t i, std::size_t j) {
            return graph.subtract(graph.multiply(a[3 + i], a[6 + j]), graph.multiply(a[3 + j], a[6 + i]));
        };
        return graph.add(graph.subtract(graph.multiply(a[0], minor(1, 2)), graph.multiply(a[1], minor(0, 2))),
                         graph.multiply(a[2], minor(0, 1)));
    }

    /// How many of the entries are proved, refuted, undecided.
    std::array<int, 3> verdicts(const Matrix& a)
    {
        std::array<int, 3> count{};
        for (const NodeId entry : a) ++count[static_cast<std::size_t>(decider->decide(entry).status)];
        return count;
    }

  private:
    Matrix named(const std::array<const char*, 9>& texts)
    {
        Matrix result;
        for (std::size_t k = 0; k < 9; ++k) result[k] = node(texts[k]);
        return result;
    }
};

constexpr std::array<int, 3> all_proved{9, 0, 0};

/// Orthogonal, of determinant 1, and v is its axis.
void check_rotation(Rotations& p, const Matrix& r)
{
    CHECK(p.verdicts(p.sum(p.product(p.transposed(r), r), p.graph.constant(-1), p.one())) == all_proved);
    const NodeId minus_one = p.graph.constant(-1);
    CHECK(p.decider->decide(p.graph.add(p.determinant(r), minus_one)).status == ProofStatus::proved);
    const std::array<NodeId, 3> v{p.node("v1"), p.node("v2"), p.node("v3")};
    for (std::size_t i = 0; i < 3; ++i) {
        NodeId image = p.graph.negate(v[i]);
        for (std::size_t k = 0; k < 3; ++k) image = p.graph.add(image, p.graph.multiply(r[3 * i + k], v[k]));
        CHECK(p.decider->decide(image).status == ProofStatus::proved);
    }
}

/// R^T dR/dv1 is antisymmetric.
void check_derivative(Rotations& p, const Matrix& r)
{
    const std::pair<NodeId, NodeId> seed[] = {{p.node("v1"), p.graph.constant(1)}};
    const auto slopes = directional(p.graph, std::vector<NodeId>(r.begin(), r.end()), seed);
    Matrix slope;
    std::copy(slopes.begin(), slopes.end(), slope.begin());
    const Matrix turn = p.product(p.transposed(r), slope);
    CHECK(p.verdicts(p.sum(turn, p.graph.constant(1), p.transposed(turn))) == all_proved);
}

} // namespace

TEST_CASE("identities of Stumpff functions are proved")
{
    const char* identities[] = {
        "stumpff(0, x)^2 + x*stumpff(1, x)^2 - 1",
        "x*stumpff(3, x) - 1 + stumpff(1, x)",
        "x^2*stumpff(6, x) - x/24 + 1/2 - stumpff(2, x)",
        "stumpff(1, x)^2 - 2*stumpff(2, x) + x*stumpff(2, x)^2",
        "stumpff(0, x^2) - cos(x)",
        "x*stumpff(1, x^2) - sin(x)",
        "stumpff(2, x^2) - 2*sin(x/2)^2/x^2",
        "stumpff(0, -x^2) - cosh(x)",
        "(x + y)*stumpff(1, -(x + y)^2) - sinh(x + y)",
        "stumpff(0, x^2/y^2) - cos(x/y)",
        "stumpff(0, 4*x) - 2*stumpff(0, x)^2 + 1",
        "stumpff(1, 4*x*y) - stumpff(0, x*y)*stumpff(1, x*y)",
        "stumpff(2, 9*x) - (1 - stumpff(0, 9*x))/(9*x)",
        "stumpff(2, x/2) - stumpff(1, x/8)^2/2",
        "stumpff(1, x/y)^2*x/y + stumpff(0, x/y)^2 - 1",
        "stumpff(4, x - x) - 1/24",
        "stumpff(0, pi^2) + 1",
        "stumpff(0, sqrt(x))^2 + sqrt(x)*stumpff(1, sqrt(x))^2 - 1",
        "sqrt(x)*stumpff(2, sqrt(x)) + stumpff(0, sqrt(x)) - 1",
        "stumpff(0, x^2 + 3*y^2) - cos(sqrt(x^2 + 3*y^2))",
        "sqrt(x^2 + y^2)*stumpff(1, x^2 + y^2) - sin(sqrt(x^2 + y^2))",
        "stumpff(2, x^2 + y^2) - 2*sin(sqrt(x^2 + y^2)/2)^2/(x^2 + y^2)",
        "stumpff(3, 8*x^2 + 8*y^2)*(x^2 + y^2) - 1/8 + sin(sqrt(8*x^2 + 8*y^2))/(8*sqrt(8*x^2 + 8*y^2))",
        "(x*stumpff(3, x) + stumpff(1, x) - 1)*x^(1/4)",
        "(stumpff(0, 4*x) - 2*stumpff(0, x)^2 + 1)*sqrt(x)*x^(1/3)",
        "stumpff(0, sqrt(x)) - cos(x^(1/4))",
        "stumpff(0, stumpff(2, x))^2 + stumpff(2, x)*stumpff(1, stumpff(2, x))^2 - 1",
    };
    Problem p({{"x", "y"}, {}, {}, {}, {}});
    for (const char* text : identities) {
        const Decision decision = p.decide(text);
        INFO(text << ": " << decision.residual << " " << decision.evidence);
        CHECK(decision.status == ProofStatus::proved);
    }
}

TEST_CASE("near misses of identities of Stumpff functions are refuted")
{
    const char* misses[] = {
        "stumpff(0, x)^2 - x*stumpff(1, x)^2 - 1",
        "x*stumpff(3, x) - 1 - stumpff(1, x)",
        "stumpff(0, x^2) - cosh(x)",
        "stumpff(1, 4*x) - 2*stumpff(0, x)*stumpff(1, x)",
        "stumpff(2, x^2 + y^2) - sin(sqrt(x^2 + y^2)/2)^2/(x^2 + y^2)",
        "stumpff(0, x^2 + y^2) - cos(sqrt(x^2 + 2*y^2))",
        "stumpff(2, x) - stumpff(2, x + 1/10^15)",
        "stumpff(5, x) - stumpff(6, x)*6",
        "stumpff(2, 10^6*x) - stumpff(2, 10^6*x + 1)",
    };
    Problem p({{"x", "y"}, {}, {}, {}, {}});
    for (const char* text : misses) {
        const Decision decision = p.decide(text);
        INFO(text << ": " << decision.residual << " " << decision.evidence);
        CHECK(decision.status == ProofStatus::refuted);
    }
}

TEST_CASE("the exponential of hat(v) is a rotation about v and its slope is tangent to the group")
{
    Rotations p;
    const Matrix r = p.exponential();
    check_rotation(p, r);
    check_derivative(p, r);
}

TEST_CASE("the Cayley transform of hat(v) is a rotation about v and its slope is tangent to the group")
{
    Rotations p;
    const Matrix r = p.cayley();
    check_rotation(p, r);
    check_derivative(p, r);
}

TEST_CASE("an exponential with one wrong sign is no rotation")
{
    Rotations p;
    const Matrix r = p.exponential("-1");
    const auto found = p.verdicts(p.sum(p.product(p.transposed(r), r), p.graph.constant(-1), p.one()));
    CHECK(found[static_cast<std::size_t>(ProofStatus::refuted)] == 9);
}

TEST_CASE("an argument that vanishes on a component proves nothing there")
{
    // c_2(z) + e - c_2(z) has the denominator z in the ring; where z e = 0, only its points with z = 0 tell.
    Problem lines({{"y", "x"}, {}, {"x^2 - y^2"}, {}, {}});
    const Decision sum = lines.decide("(x + y + stumpff(2, x - y)) - stumpff(2, x - y)");
    CHECK(sum.status == ProofStatus::refuted);
    Problem half({{"x"}, {}, {}, {"x > 0"}, {}});
    CHECK(half.decide("(abs(x) - x + stumpff(2, x + abs(x))) - stumpff(2, x + abs(x))").status == ProofStatus::proved);
    Problem whole({{"x"}, {}, {}, {}, {}});
    CHECK(whole.decide("(abs(x) - x + stumpff(2, x + abs(x))) - stumpff(2, x + abs(x))").status ==
          ProofStatus::refuted);
    // True, and zero at all points, but the proof would divide by what vanishes on half of them.
    const Decision open = lines.decide("(x - y)*stumpff(2, x - y) + stumpff(0, x - y) - 1");
    CHECK(open.status == ProofStatus::undecided);
    CHECK(open.evidence.find("zero wherever") != std::string::npos);
}

TEST_CASE("enclosures of Stumpff functions hold the value and are narrow on both sides of 0 and across it")
{
    using proof::Ball;
    using proof::enclose_stumpff;
    const auto check = [](unsigned k, const Rational& z, double expected) {
        const Ball value = enclose_stumpff(k, Ball(z, 256), 256);
        REQUIRE(value.is_finite());
        CHECK(value.middle() == Approx(expected).epsilon(tolerance::roundoff(4)));
        CHECK(arb_rel_accuracy_bits(value.get()) > 200);
    };
    check(0, 4, std::cos(2.0));
    check(1, -4, std::sinh(2.0) / 2);
    check(2, 10000, 2 * std::pow(std::sin(50.0) / 100, 2));
    check(0, 1000000, std::cos(1000.0));
    check(3, -1000000, (std::sinh(500.0) * 2 * (std::cosh(500.0) / 1000) - 1) / 1e6);
    check(5, 0, 1.0 / 120);
    check(5, Rational(1, 1000000007), 1.0 / 120 - 1.0 / 5040 / 1000000007);
    Ball across;
    arb_add_error_2exp_si(across.get(), -100);
    const Ball value = enclose_stumpff(2, across, 256);
    CHECK(value.middle() == 0.5);
    CHECK(arb_rel_accuracy_bits(value.get()) > 95);
    Ball wide;
    arb_add_error_2exp_si(wide.get(), 200);
    CHECK_FALSE(enclose_stumpff(2, wide, 256).is_finite());
}

TEST_CASE("a constraint in Stumpff functions stands beside a root of their argument")
{
    Problem one({{"y", "x"}, {}, {"y - stumpff(1, 1 + x^2)"}, {}, {}});
    CHECK(one.decide("sqrt(1 + x^2)*(y - stumpff(1, 1 + x^2))").status == ProofStatus::proved);
    CHECK(one.decide("sqrt(1 + x^2)*(y - stumpff(2, 1 + x^2))").status == ProofStatus::refuted);
    Problem two({{"z", "x", "y"}, {}, {"z - stumpff(2, x^2 + y^2)"}, {}, {}});
    CHECK(two.decide("sqrt(x^2 + y^2)*(z - stumpff(2, x^2 + y^2))").status == ProofStatus::proved);
}
