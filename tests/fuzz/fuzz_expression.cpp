// SPDX-License-Identifier: GPL-2.0-or-later
/// Bytes as an expression: parsed, printed and parsed again; closed over a scope with families, sizes and definitions;
/// lowered and differentiated.
///   parse(to_text(t)) has the value of t, and printing is stable from the second time on
///   a closed tree is scalar, and its names are declared symbols
#include "expression/parse.hpp"
#include "expression/scope.hpp"
#include "fuzz/harness.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"

#include <set>

using namespace lagen;
using fuzz::accepted;
using fuzz::require;

namespace {

constexpr std::size_t largest_graph = 10'000; ///< nodes that are worth the time of a derivative
constexpr std::size_t longest_text = 20'000;  ///< of a closed tree that is read again

Tree parse(const std::string& text)
{
    return parse_expression(whole_text("<fuzz>", text));
}

Scope make_scope()
{
    Scope scope;
    for (const char* symbol : {"x", "y", "z", "t", "a1", "ω"}) scope.declare(symbol, {});
    scope.declare_size("n", 3, {});
    scope.declare_size("k", 2, {});
    scope.declare_family("v", {Rank::vector, 3, 1}, {});
    scope.declare_family("q", {Rank::vector, 4, 1}, {});
    scope.declare_family("W", {Rank::matrix, 2, 2}, {});
    scope.declare_family("R", {Rank::matrix, 3, 3}, {});
    scope.define({"E", {}, parse("x^2 + y^2/2"), {}});
    scope.define({"f", {"a", "b"}, parse("a*sin(b) + E"), {}});
    scope.define({"g", {"a"}, parse("f(a, f(a, a))^2"), {}});
    scope.define({"l", {"m"}, parse("l(m) + 1"), {}});
    return scope;
}

const Scope& scope_of_all()
{
    static const Scope scope = make_scope();
    return scope;
}

bool is_cut(const std::string& text)
{
    return text.ends_with("...");
}

/// The value at fixed rational inputs; nothing where an operation is not rational.
std::vector<Rational> exact_value(const Tree& tree)
{
    std::vector<Rational> result;
    accepted([&] {
        Graph graph;
        const NodeId node = Lowering(graph)(tree);
        std::map<std::string, Rational> inputs;
        long next = 3;
        std::set<std::string> names;
        for (const NodeId input : graph.inputs()) names.insert(graph.input_name(input));
        for (const std::string& name : names) inputs[name] = Rational(next += 2, 7);
        for (auto& [name, value] : inputs) value.canonicalize();
        if (graph.size() < largest_graph) result = evaluate_exactly(graph, std::vector{node}, inputs);
    });
    return result;
}

bool is_scalar_kind(TreeKind kind)
{
    return kind != TreeKind::array && kind != TreeKind::index && kind != TreeKind::sum_over &&
           kind != TreeKind::product_over && kind != TreeKind::apply;
}

bool is_scalar(const Tree& root)
{
    std::set<const TreeNode*> seen;
    std::vector<const TreeNode*> open{root.get()};
    while (!open.empty()) {
        const TreeNode* node = open.back();
        open.pop_back();
        if (!seen.insert(node).second) continue;
        if (!is_scalar_kind(node->kind)) return false;
        if (node->kind == TreeKind::call && entry_of(node->function).array) return false;
        for (const Tree& argument : node->arguments) open.push_back(argument.get());
    }
    return true;
}

void check_printing(const Tree& tree)
{
    const std::string text = to_text(tree);
    if (is_cut(text)) return;
    const Tree again = parse(text); // what was printed must be read
    const std::string second = to_text(again);
    require(second == text, "printed as '" + text + "', read and printed again as '" + second + "'");
    require(is_scalar(tree) == is_scalar(again), "'" + text + "' changed its kind in print");
    if (is_scalar(tree)) require(exact_value(again) == exact_value(tree), "'" + text + "' has another value");
}

void lower_and_differentiate(const Tree& closed)
{
    Graph graph;
    const NodeId node = Lowering(graph)(closed);
    if (graph.size() > largest_graph) return;
    std::map<std::string, double> inputs;
    double next = 0.3;
    for (const NodeId input : graph.inputs()) inputs[graph.input_name(input)] = next += 0.37;
    static_cast<void>(evaluate<double>(graph, std::vector{node}, inputs));
    const std::vector<NodeId> variables = graph.inputs();
    const std::vector<NodeId> slopes = gradient(graph, node, variables);
    if (graph.size() < largest_graph) static_cast<void>(evaluate<double>(graph, slopes, inputs));
}

void check_closed(const Scope& scope, const Tree& closed)
{
    require(is_scalar(closed), "a closed tree is not scalar");
    for (const std::string& symbol : names_in(closed))
        require(scope.has_symbol(symbol), "closed over the undeclared '" + symbol + "'");
    const std::string text = to_text(closed);
    accepted([&] { lower_and_differentiate(closed); });
    if (text.size() > longest_text) return;
    Tree again;
    // What is written out may be deeper than what a user may write, and solve has no spelling.
    if (!accepted([&] { again = scope.close(parse(text), true); })) return;
    require(exact_value(again) == exact_value(closed), "closed '" + text + "' has another value when read again");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    accepted([&] { static_cast<void>(parse_comparison(whole_text("<fuzz>", text))); });
    Tree tree;
    if (!accepted([&] { tree = parse(text); })) return 0;
    check_printing(tree);

    const Scope scope = scope_of_all();
    accepted([&] { static_cast<void>(scope.close(tree)); });
    ArrayValue closed;
    if (!accepted([&] { closed = scope.close_array(tree, true); })) return 0;
    require(closed.entries.size() == closed.shape.size(), "an array has not as many entries as its shape says");
    const std::size_t last = closed.entries.size() - 1;
    for (const std::size_t k : std::set{std::size_t{0}, last})
        if (!closed.entries.empty()) check_closed(scope, closed.entries[k]);
    return 0;
}
