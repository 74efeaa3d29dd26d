// SPDX-License-Identifier: GPL-2.0-or-later
/// Bounds |a| <= C u^p of parts of u, against values in the box; powers that are known by hand.
#include "problem.hpp"
#include "proof/power_bounds.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace lagen;
using namespace lagen::proof;

namespace {

constexpr slong bits = 128;
constexpr double width = 0.25;

/// Nodes over x and y with their values in the box |x|, |y| <= 1/4.
class Box {
  public:
    explicit Box(const std::vector<std::string>& texts) : problem_({{"x", "y"}, {}, {}, {}, {}})
    {
        for (const std::string& text : texts) nodes_.push_back(problem_.node(text));
        inputs_ = {problem_.node("x"), problem_.node("y")};
        BallInputs box;
        for (const NodeId input : inputs_) arb_add_error_2exp_si(box[input].get(), -2);
        const std::vector<NodeId> all = reachable(problem_.graph, nodes_);
        const std::vector<Ball> found = Evaluation(problem_.graph, all).enclose(box, bits);
        for (std::size_t k = 0; k < all.size(); ++k) values_.emplace(all[k], found[k]);
    }

    [[nodiscard]] std::optional<PowerBound> bound(std::size_t of, std::size_t base)
    {
        PowerBounds bounds(
            problem_.graph, [this](NodeId node) -> const Ball& { return values_.at(node); }, bits);
        return bounds.of(nodes_[of], nodes_[base]);
    }

    [[nodiscard]] double at(std::size_t k, double x, double y) const
    {
        const BallInputs point{{inputs_[0], Ball(Rational(x), bits)}, {inputs_[1], Ball(Rational(y), bits)}};
        return Evaluation(problem_.graph, {nodes_[k]}).enclose(point, bits)[0].middle();
    }

  private:
    test::Problem problem_;
    std::vector<NodeId> nodes_;
    std::array<NodeId, 2> inputs_{};
    std::map<NodeId, Ball> values_;
};

/// The power of the bound of `part` by `base`, which holds at points of the box; none where there is no bound.
std::optional<Rational> power(const std::string& part, const std::string& base)
{
    Box box({part, base});
    const std::optional<PowerBound> found = box.bound(0, 1);
    if (!found) return std::nullopt;
    INFO(part << " by " << base);
    for (int i = -5; i <= 5; ++i)
        for (int j = -5; j <= 5; ++j) {
            const double x = width * i / 5, y = width * j / 5;
            CHECK(std::abs(box.at(0, x, y)) <=
                  found->C.bound() * std::pow(box.at(1, x, y), found->p.get_d()) * (1 + 1e-12));
        }
    return found->p;
}

} // namespace

TEST_CASE("parts of a sum of squares are bounded by its root, their products by itself")
{
    const std::string square = "x^2 + y^2";
    CHECK(power("x", square) == Rational(1, 2));
    CHECK(power("x*y", square) == Rational(1));
    CHECK(power("-3*x^3", square) == Rational(3, 2));
    CHECK(power("x + 5*x*y", square) == Rational(1, 2)); // the least of the terms'
    CHECK(power("x*cos(y)", square) == Rational(1, 2));
    CHECK(power("x/(2 + y)", square) == Rational(1, 2));
    CHECK(power("abs(x*y)*sqrt(x^2 + y^2)", square) == Rational(3, 2));
    CHECK(power("(x^2 + y^2)^(3/4)", square) == Rational(3, 4));
    CHECK(power("x", "3*x^4 + y^2") == Rational(1, 4));
    CHECK(power("x*y", "(x^2 + y^2)/7") == Rational(1));
    CHECK(power("x", "sqrt(x^2 + y^2)") == Rational(1));
}

TEST_CASE("there is no bound where none is seen")
{
    const std::string square = "x^2 + y^2";
    CHECK(power("1 + x", square) == std::nullopt);
    CHECK(power("cos(x)", square) == std::nullopt);
    CHECK(power("x/y", square) == std::nullopt);
    CHECK(power("y", "x^2") == std::nullopt);
    CHECK(power("x", "x^2 + y^3") == std::nullopt); // y^3 is below 0 as well
    CHECK(power("x", "x^2 - y^2") == std::nullopt);
}

TEST_CASE("products that share their factors are looked at once")
{
    test::Problem problem({{"x", "y"}, {}, {}, {}, {}});
    Graph& graph = problem.graph;
    const NodeId x = problem.node("x"), base = problem.node("x^2 + y^2"), product = problem.node("x*y");
    NodeId shared = x;
    for (int k = 0; k < 14; ++k) // 2^14 paths lead to x
        shared = graph.multiply(graph.add(shared, x), graph.subtract(shared, product));
    int asked = 0;
    const Ball one(Rational(1), bits);
    const auto value = [&](NodeId) -> const Ball& { return ++asked, one; };
    PowerBounds bounds(graph, value, bits);
    CHECK(bounds.of(shared, base).has_value());
    CHECK(asked < 200);
}
