// SPDX-License-Identifier: GPL-2.0-or-later
/// diff, grad, jacobian and Dt of closed values.
#include "expression/closing.hpp"
#include "expression/derivative.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace lagen {

namespace {

/// The hint for a second argument that is no name.
constexpr const char* symbols_hint = "derivatives are taken by coordinates, momenta, parameters, t: by symbols";
constexpr std::size_t longest_shown = 60;

/// The names of the symbols that an argument is made of.
std::vector<std::string> symbols_of(const Maker& maker, const Tree& written, Closed& value, const char* function)
{
    std::vector<std::string> symbols;
    for (const ClosedTree& entry : maker.entries(value)) {
        if (entry.tree->kind == TreeKind::name) {
            symbols.push_back(entry.tree->name);
            continue;
        }
        const std::string text = to_text(written), meaning = to_text(entry.tree);
        const bool stands_for = text != meaning && value.shape.rank == Rank::scalar && meaning.size() <= longest_shown;
        refuse(written, fmt::format("{} is taken by {}, which is no symbol", function, quote(text)),
               stands_for ? fmt::format("{} stands for {} here", quote(text), meaning) : symbols_hint);
    }
    return symbols;
}

void require_ranks(const TreeNode& node, Derivative derivative, const Shape& f, const Shape& q)
{
    const auto refuse_rank = [&](std::size_t k, const Shape& shape, const char* hint) {
        refuse(node.arguments[k], fmt::format("{} is taken {} {}", node.name, k == 0 ? "of" : "by", to_text(shape)),
               hint);
    };
    switch (derivative) {
    case Derivative::diff:
        if (q.rank != Rank::scalar) refuse_rank(1, q, "grad(f, q) and jacobian(f, q) are taken by several symbols");
        break;
    case Derivative::grad:
        if (f.rank != Rank::scalar) refuse_rank(0, f, "grad is taken of a scalar, jacobian(f, q) of a vector");
        if (q.rank == Rank::scalar)
            refuse_rank(1, q, "grad is taken by a family or a vector, diff(f, q) by one symbol");
        break;
    case Derivative::jacobian:
        if (f.rank != Rank::vector) refuse_rank(0, f, "jacobian is taken of a vector, grad(f, q) of a scalar");
        if (q.rank != Rank::vector) refuse_rank(1, q, "jacobian is taken by a vector of symbols");
        break;
    case Derivative::rate: break;
    }
}

/// Entries of the derivative of a function with a kink are as far from smooth as it is.
ClosedTree with_kink(ClosedTree derivative, const ClosedTree& function)
{
    if (function.measure.nonsmooth != nullptr) derivative.measure.nonsmooth = function.measure.nonsmooth;
    return derivative;
}

} // namespace

const DerivativeEntry* Expansion::Closing::derivative_of(const TreeNode& node) const
{
    if (node.kind != TreeKind::apply) return nullptr;
    const Definition* own = scope_.find_definition(node.name);
    return own && !own->parameters.empty() ? nullptr : find_derivative(node.name);
}

void Expansion::Closing::require_arity(const TreeNode& node, const DerivativeEntry& entry)
{
    const std::size_t given = node.arguments.size();
    if (given != entry.arity)
        throw ModelError(fmt::format("{} takes {} argument{}, and {} {} given", entry.name, entry.arity,
                                     entry.arity == 1 ? "" : "s", given, given == 1 ? "is" : "are"),
                         node.where, entry.hint);
}

Value Expansion::Closing::differentiate(const Maker& make, const Tree& tree, std::span<const Value> arguments) const
{
    const Derivative derivative = derivative_of(*tree)->derivative;
    if (std::ranges::any_of(arguments, [](const Value& value) { return value->open; })) return open_value(tree->where);
    if (derivative == Derivative::rate) return rate_of(make, tree, *arguments[0]);
    Closed &f = *arguments[0], &q = *arguments[1];
    require_ranks(*tree, derivative, f.shape, q.shape);
    const std::vector<std::string> symbols = symbols_of(make, tree->arguments[1], q, tree->name.c_str());
    const std::set<std::string> wanted(symbols.begin(), symbols.end());
    Gradients gradients(make, [&](const TreeNode& node) {
        const Definition* rate = scope_.find_definition(rate_name(node.name));
        if (rate != nullptr && rate->body == nullptr)
            throw ModelError(fmt::format("{} is taken of an expression with '{}'", tree->name, node.name),
                             node.where.file ? node.where : tree->where,
                             fmt::format("what '{}' depends on is put in later; definitions have derivatives, and "
                                         "'lagrangian' where the model has L",
                                         node.name));
        return wanted.contains(node.name);
    });
    std::vector<ClosedTree> entries;
    for (const ClosedTree& entry : make.entries(f)) {
        const Gradients::Partials& partials = gradients.of(entry.tree);
        for (const std::string& symbol : symbols) {
            const auto place = std::ranges::find(gradients.symbols(), symbol);
            const auto found = partials.find(static_cast<std::size_t>(place - gradients.symbols().begin()));
            entries.push_back(with_kink(found == partials.end() ? make.number(0) : found->second, entry));
        }
    }
    if (derivative == Derivative::jacobian)
        return array_value(make, matrix_shape(f.shape.rows, q.shape.rows), std::move(entries));
    const Shape shape = derivative == Derivative::grad ? q.shape : f.shape;
    return shape.rank == Rank::scalar ? scalar(std::move(entries[0])) : array_value(make, shape, std::move(entries));
}

/// dX/dx^i times the rate of x^i, and dX/dt.
Value Expansion::Closing::rate_of(const Maker& make, const Tree& tree, Closed& X) const
{
    const auto rate_of_symbol = [&](const std::string& name) { return scope_.find_definition(rate_name(name)); };
    Gradients gradients(make, [&](const TreeNode& node) {
        const Definition* rate = rate_of_symbol(node.name);
        if (rate == nullptr || rate->body == nullptr)
            throw ModelError(
                fmt::format("Dt is taken of an expression with '{}', whose rate is not known here", node.name),
                node.where.file ? node.where : tree->where,
                scope_.has_definition(rate_name("t"))
                    ? "Dt(X) is for X over t, parameters and base coordinates: other rates are known along "
                      "a motion alone"
                    : "the anchor is not known where this stands");
        return rate->body->kind != TreeKind::number || rate->body->number != 0;
    });
    Gradients rates(make, [](const TreeNode&) { return false; });
    std::vector<ClosedTree> entries;
    for (const ClosedTree& entry : make.entries(X)) {
        std::vector<ClosedTree> terms;
        for (const auto& [symbol, partial] : gradients.of(entry.tree))
            terms.push_back(
                make.multiply({partial, rates.measured(rate_of_symbol(gradients.symbols()[symbol])->body)}));
        entries.push_back(with_kink(make.add(std::move(terms)), entry));
    }
    return X.shape.rank == Rank::scalar ? scalar(std::move(entries[0]))
                                        : array_value(make, X.shape, std::move(entries));
}

} // namespace lagen
