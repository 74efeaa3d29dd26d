// SPDX-License-Identifier: GPL-2.0-or-later
/// Operations that one call computes together: which they are, in which order, and how they are called.
#include "emit/spell.hpp"
#include "emit/write_body.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// The statements of a function with these outputs, its values last; every input is called by its own name.
std::vector<std::string> lines(const Graph& graph, const std::vector<NodeId>& outputs)
{
    LocalNames names;
    for (const NodeId id : graph.inputs()) {
        names.inputs[id] = graph.input_name(id);
        names.taken.insert(graph.input_name(id));
    }
    const Body body = write_body({graph, names, outputs, {}, {}, Checking::none});
    std::vector<std::string> text;
    for (const Statement& statement : body.parts.front()) {
        if (statement.kind == Statement::Kind::load) continue;
        if (statement.kind == Statement::Kind::store)
            text.push_back(spell(statement.expressions[0]).text);
        else
            for (const std::string& line : spell(statement)) text.push_back(line);
    }
    return text;
}

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("sine and cosine of one angle come from one call and are called after it", "[emit][batch]")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId sum = g.add(a, g.input("b"));
    CHECK(lines(g, {g.apply(Op::cos, a), g.apply(Op::sin, a)}) ==
          Lines{"const auto [sin_a, cos_a] = sincos<S>(a);", "cos_a", "sin_a"});
    const NodeId sine = g.apply(Op::sin, sum);
    CHECK(lines(g, {g.multiply(g.apply(Op::cos, sum), sine)}) ==
          Lines{"const S w0 = a + b;", "const auto [w1, w2] = sincos<S>(w0);", "w2 * w1"});
}

TEST_CASE("the sines and cosines of several angles come from one call", "[emit][batch]")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    const NodeId difference = g.subtract(a, b);
    CHECK(
        lines(g, {g.apply(Op::cos, difference), g.apply(Op::sin, b), g.multiply(g.apply(Op::sin, a), b)}) ==
        Lines{"const auto [sines, cosines] = sincos<S, 3>({a, b, a - b});", "cosines[2]", "sines[1]", "sines[0] * b"});
}

TEST_CASE("two sines alone, and three square roots, are left to the functions of one argument", "[emit][batch]")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId b = g.input("b");
    CHECK(lines(g, {g.apply(Op::sin, a), g.apply(Op::sin, b)}) == Lines{"sin(a)", "sin(b)"});
    CHECK(lines(g, {g.apply(Op::sqrt, a), g.apply(Op::sqrt, b), g.apply(Op::sqrt, g.add(a, b))}) ==
          Lines{"sqrt(a)", "sqrt(b)", "sqrt(a + b)"});
}

TEST_CASE("an angle that depends on another's sine waits for a second call", "[emit][batch]")
{
    Graph g;
    const NodeId a = g.input("a");
    const NodeId inner = g.apply(Op::sin, a);
    const NodeId outer = g.add(inner, a);
    const std::vector<NodeId> outputs{g.apply(Op::sin, outer), g.apply(Op::cos, outer), g.apply(Op::cos, a)};
    CHECK(lines(g, outputs) == Lines{"const auto [sin_a, cos_a] = sincos<S>(a);", "const S w0 = sin_a + a;",
                                     "const auto [w1, w2] = sincos<S>(w0);", "w1", "w2", "cos_a"});
}

TEST_CASE("four inverse cubes of distances are four roots and four reciprocals, together", "[emit][batch]")
{
    Graph g;
    std::vector<NodeId> cubes;
    for (const char* name : {"a", "b", "c", "d"}) {
        const NodeId square = g.input(name);
        cubes.push_back(g.divide(g.constant(1), g.multiply(square, g.apply(Op::sqrt, square))));
    }
    CHECK(lines(g, cubes) == Lines{"const auto roots = square_roots<S, 4>({a, b, c, d});",
                                   "const auto inverses = reciprocals<S, 4>({a * roots[0], b * roots[1], c * roots[2], "
                                   "d * roots[3]});",
                                   "inverses[0]", "inverses[1]", "inverses[2]", "inverses[3]"});
}

TEST_CASE("the names of arrays avoid the names of the model", "[emit][batch]")
{
    Graph g;
    const NodeId a = g.input("sines");
    const NodeId b = g.input("sin_x");
    const NodeId x = g.input("x");
    CHECK(lines(g, {g.apply(Op::sin, x), g.multiply(b, g.apply(Op::cos, x))}) ==
          Lines{"const auto [sin_x_, cos_x] = sincos<S>(x);", "sin_x_", "sin_x * cos_x"});
    CHECK(lines(g, {g.apply(Op::sin, a), g.apply(Op::cos, a), g.apply(Op::cos, b)}).front() ==
          "const auto [sines_, cosines] = sincos<S, 2>({sines, sin_x});");
}
