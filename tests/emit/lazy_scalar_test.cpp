// SPDX-License-Identifier: GPL-2.0-or-later
/// What `select` is given has the scalar's own type: scalars with expression templates have one for every sum.
#include "emit/node_expressions.hpp"
#include "emit/spell.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

TEST_CASE("the branches of a selection are scalars, not expressions")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    const NodeId less = g.apply(Op::less, a, b);
    const auto text = [&](NodeId x, NodeId y) {
        const NodeId choice = g.select(less, x, y);
        NodeExpressions expressions(g); // knows the nodes that are there
        expressions.name(a, variable("a"));
        expressions.name(b, variable("b"));
        return spell(expressions(choice)).text;
    };
    CHECK(text(a, g.constant(2)) == "select(a < b, a, S(2))");
    CHECK(text(g.add(a, b), g.constant(Rational(1, 3))) == "select(a < b, S(a + b), S(S(1) / S(3)))");
    CHECK(text(g.pi(), g.select(less, b, a)) == "select(a < b, arithmetic::pi<S>(), select(a < b, b, a))");
}
