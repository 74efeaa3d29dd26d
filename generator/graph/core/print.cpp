// SPDX-License-Identifier: GPL-2.0-or-later
/// Nodes as text with the fewest parentheses. Shared parts are written out, so the text is cut at a limit.
#include "graph/core/operators.hpp"
#include "text/alphabet.hpp"

namespace lagen {
namespace {

/// A piece still to be written: a fixed text, or a node in a place that binds with `precedence`.
struct Piece {
    std::string text; ///< empty: the node is meant
    NodeId node = 0;
    int precedence = 0;
};

int precedence_of(const Graph& graph, NodeId id)
{
    if (!graph.is_constant(id)) return operator_of(graph.op(id)).precedence;
    if (graph.value(id).get_den() != 1) return operator_of(Op::divide).precedence;
    return operator_of(sgn(graph.value(id)) < 0 ? Op::negate : Op::constant).precedence;
}

std::string leaf_text(const Graph& graph, NodeId id)
{
    if (graph.op(id) == Op::constant) return graph.value(id).get_str();
    return graph.op(id) == Op::pi ? "pi" : graph.input_name(id);
}

/// Appends the pieces of a node in reading order.
void expand(const Graph& graph, NodeId id, std::vector<Piece>& pieces)
{
    const Operator& entry = operator_of(graph.op(id));
    const auto operands = graph.operands(id);
    switch (entry.notation) {
    case Notation::leaf: break;
    case Notation::prefix:
        pieces.push_back({entry.name, 0, 0});
        pieces.push_back({{}, operands[0], operator_of(Op::multiply).precedence});
        break;
    case Notation::integer:
        pieces.push_back({{}, operands[0], 5});
        pieces.push_back({std::string("^").append(std::to_string(static_cast<std::int32_t>(graph.payload(id)))), 0, 0});
        break;
    case Notation::infix: {
        const bool power = entry.op == Op::real_power;
        const bool tight = power || entry.op == Op::multiply || entry.op == Op::divide;
        const bool left_only = entry.op == Op::subtract || entry.op == Op::divide || entry.precedence == 0;
        pieces.push_back({{}, operands[0], power ? 5 : entry.precedence + (entry.precedence == 0 ? 1 : 0)});
        if (!tight) pieces.push_back({" ", 0, 0});
        pieces.push_back({entry.name, 0, 0});
        if (!tight) pieces.push_back({" ", 0, 0});
        pieces.push_back({{}, operands[1], power ? 5 : entry.precedence + (left_only ? 1 : 0)});
        break;
    }
    case Notation::call:
    case Notation::block:
        pieces.push_back({entry.name, 0, 0});
        pieces.push_back({"(", 0, 0});
        if (entry.op == Op::stumpff) pieces.push_back({std::to_string(graph.payload(id)).append(", "), 0, 0});
        for (std::size_t k = 0; k < operands.size(); ++k) {
            if (k != 0) pieces.push_back({", ", 0, 0});
            pieces.push_back({{}, operands[k], 0});
        }
        if (entry.op == Op::component)
            pieces.push_back({std::string(", ").append(std::to_string(graph.payload(id))), 0, 0});
        pieces.push_back({")", 0, 0});
        break;
    }
}

} // namespace

std::string to_text(const Graph& graph, NodeId id, std::size_t limit)
{
    std::string text;
    std::vector<Piece> stack{{{}, id, 0}};
    std::vector<Piece> pieces;
    while (!stack.empty() && text.size() <= limit) {
        const Piece piece = stack.back();
        stack.pop_back();
        if (!piece.text.empty()) {
            text += piece.text;
            continue;
        }
        pieces.clear();
        const bool parentheses = precedence_of(graph, piece.node) < piece.precedence;
        if (parentheses) text += "(";
        if (operator_of(graph.op(piece.node)).notation == Notation::leaf) text += leaf_text(graph, piece.node);
        expand(graph, piece.node, pieces);
        if (parentheses) pieces.push_back({")", 0, 0});
        stack.insert(stack.end(), pieces.rbegin(), pieces.rend());
    }
    if (text.size() <= limit) return text;
    return whole_characters(text, limit) + "...";
}

} // namespace lagen
