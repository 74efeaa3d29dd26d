// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/constant_values.hpp"

#include "proof/decide.hpp"
#include "proof/enclosure.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr slong precision = 256;
/// Constants are short; a long one is let pass.
constexpr ProofBudget constant_budget{.terms = 2000, .products = 200'000};

std::string quoted(const Tree& tree)
{
    return quote(to_text(tree));
}

[[noreturn]] void refuse(const TreeNode& node, const std::string& what, const std::string& found, const char* required)
{
    throw ModelError(what + " has no real value: " + found + ", " + required, node.where,
                     "an expression that contains it is defined nowhere");
}

const char* size_of(int sign)
{
    return sign == 0 ? " is 0" : sign < 0 ? " is negative" : " is positive";
}

} // namespace

void ConstantValues::require(const Tree& tree)
{
    struct Visit {
        const Tree* tree;
        std::vector<std::size_t> open; ///< arguments to be looked at, the next one last
    };
    const auto visit = [this](const Tree& node) {
        Visit result{&node, {}};
        const std::optional<std::size_t> branch = only_branch(*node);
        for (std::size_t k = node->arguments.size(); k-- > 0;)
            if (!branch || k == 0 || k == *branch) result.open.push_back(k);
        return result;
    };
    (void)lower_(tree); // keeps every node alive
    std::vector<Visit> stack;
    if (done_.insert(tree.get()).second) stack.push_back(visit(tree));
    while (!stack.empty()) {
        Visit& top = stack.back();
        const TreeNode& node = **top.tree;
        if (top.open.empty()) {
            stack.pop_back();
            require_node(node);
            continue;
        }
        const Tree& argument = node.arguments[top.open.back()];
        top.open.pop_back();
        if (done_.insert(argument.get()).second) stack.push_back(visit(argument));
    }
}

/// Of if(c, a, b) with a constant c: the branch that is taken, or none where c is not decided.
std::optional<std::size_t> ConstantValues::only_branch(const TreeNode& node)
{
    if (node.kind != TreeKind::call || node.function != Function::select) return std::nullopt;
    const NodeId condition = node_of(node, 0);
    if (!is_constant(condition)) return std::nullopt;
    if (graph_.is_constant(condition)) return graph_.is_zero(condition) ? 2 : 1;
    const proof::Ball value = proof::Evaluation(graph_, {condition}).enclose({}, precision)[0];
    if (!value.is_finite()) return 0;
    return value.excludes_zero() ? 1 : 2;
}

NodeId ConstantValues::node_of(const TreeNode& node, std::size_t argument)
{
    return lower_(node.arguments[argument]);
}

bool ConstantValues::is_constant(NodeId node)
{
    for (NodeId id = static_cast<NodeId>(varies_.size()); id <= node; ++id) {
        const auto operands = graph_.operands(id);
        varies_.push_back(graph_.op(id) == Op::input ||
                          std::any_of(operands.begin(), operands.end(), [&](NodeId each) { return varies_[each]; }));
    }
    return !varies_[node];
}

std::optional<int> ConstantValues::sign_of(NodeId node)
{
    if (!is_constant(node)) return std::nullopt;
    if (graph_.is_constant(node)) return sgn(graph_.value(node));
    const proof::Ball value = proof::Evaluation(graph_, {node}).enclose({}, precision)[0];
    if (value.excludes_zero()) return value.is_positive() ? 1 : -1;
    if (!value.is_finite()) return std::nullopt;
    if (ZeroDecider(graph_, {}, constant_budget).decide(node).status == ProofStatus::proved) return 0;
    return std::nullopt;
}

void ConstantValues::require_node(const TreeNode& node)
{
    if (node.kind == TreeKind::call) return require_call(node);
    if (node.kind == TreeKind::power) return require_power(node);
    if (node.kind == TreeKind::divide && sign_of(node_of(node, 1)) == 0)
        refuse(node, "the quotient", "its divisor " + quoted(node.arguments[1]) + " is 0",
               "a divisor other than 0 is required");
}

void ConstantValues::require_call(const TreeNode& node)
{
    const std::string name = entry_of(node.function).name;
    const auto argument = [&](std::size_t k) { return quoted(node.arguments[k]); };
    switch (node.function) {
    case Function::log:
    case Function::sqrt: {
        const std::optional<int> sign = sign_of(node_of(node, 0));
        const bool of_log = node.function == Function::log;
        if (sign && (*sign < 0 || (*sign == 0 && of_log)))
            refuse(node, name, "its argument " + argument(0) + size_of(*sign),
                   of_log ? "a positive number is required" : "0 or a positive number is required");
        return;
    }
    case Function::asin:
    case Function::acos: {
        const NodeId a = node_of(node, 0), one = graph_.constant(1);
        for (const NodeId room : {graph_.subtract(one, a), graph_.sum(std::vector{one, a})})
            if (const auto sign = sign_of(room); sign && *sign < 0)
                refuse(node, name, "its argument " + argument(0) + " is outside -1..1",
                       "a number from -1 to 1 is required");
        return;
    }
    case Function::tan:
        if (sign_of(graph_.apply(Op::cos, node_of(node, 0))) == 0)
            refuse(node, name, "its argument " + argument(0) + " is an odd multiple of pi/2",
                   "an angle whose cosine is not 0 is required");
        return;
    case Function::atan2:
        if (sign_of(node_of(node, 0)) == 0 && sign_of(node_of(node, 1)) == 0)
            refuse(node, name, "both arguments are 0", "one other than 0 is required");
        return;
    default: return;
    }
}

void ConstantValues::require_power(const TreeNode& node)
{
    const NodeId exponent = node_of(node, 1);
    const std::optional<int> base = sign_of(node_of(node, 0));
    if (!base || *base > 0 || !is_constant(exponent)) return;
    const std::string found = "its base " + quoted(node.arguments[0]) + size_of(*base);
    if (*base == 0) {
        const std::optional<int> sign = sign_of(exponent);
        if (sign && *sign <= 0) refuse(node, "the power", found, "with this exponent another base is required");
        return;
    }
    const bool whole = !graph_.is_constant(exponent) || graph_.value(exponent).get_den() == 1;
    if (!whole) refuse(node, "the power", found, "with an exponent that is not an integer a positive base is required");
}

} // namespace lagen
