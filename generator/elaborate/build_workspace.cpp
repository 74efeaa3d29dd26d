// SPDX-License-Identifier: GPL-2.0-or-later
/// Formulas of the kinds of algebroid on one graph, and their readable form.
#include "elaborate/build_workspace.hpp"

#include "elaborate/bind_parameters.hpp"

#include "proof/print_fraction.hpp"
#include "proof/triangular.hpp"
#include "symbolic/shortest_form.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

constexpr std::size_t normal_terms = 400;
constexpr std::size_t normal_products = 20'000;
constexpr std::size_t normal_length = 4000;   ///< of a normal form that is considered
constexpr std::size_t rewritten_length = 600; ///< of a form that GiNaC looks for a shorter one of
constexpr std::size_t parenthesis_cost = 2;

std::size_t cost_of(const Tree& tree)
{
    const std::string text = to_text(tree);
    return text.size() + parenthesis_cost * static_cast<std::size_t>(std::count(text.begin(), text.end(), '('));
}

} // namespace

BuildWorkspace::BuildWorkspace(const Model& model)
    : model_(model), lower_(graph_), x_([&] {
          bind_parameters(graph_, model);
          std::vector<NodeId> x;
          for (const Symbol& symbol : model.base.coordinates) x.push_back(graph_.input(symbol.name));
          return x;
      }()),
      partial_(graph_, x_)
{
    setting_.variables = x_;
    for (const Parameter& parameter : model.parameters) {
        if (parameter.bound) continue;
        setting_.parameters.push_back(graph_.input(parameter.symbol.name));
        order_.parameters.push_back(parameter.symbol.name);
    }
    for (const Symbol& symbol : model.base.coordinates) order_.variables.push_back(symbol.name);
    if (is_nonholonomic(model)) { // constraints may depend on time
        setting_.variables.push_back(graph_.input("t"));
        order_.variables.emplace_back("t");
    }
    for (const Tree& tree : model.base.domain) setting_.domain.push_back(lower_(tree));
    for (const Tree& tree : model.base.constraints) setting_.constraints.push_back(lower_(tree));
    // A Casimir's name stands for a function of the base, and constraints for parts of it.
    if (model.base.constraints.empty() && model.base.casimirs.empty() &&
        contains(model.algebroid, AlgebroidKind::frame))
        construction_.emplace();
    (void)proof::keep_triangular(graph_, setting_); // others are refused where the claims are made, with their place
    solved_ = proof::triangular_constraints(graph_, setting_);
}

Algebroid BuildWorkspace::lowered(const AlgebroidBlock& block, const BlockParts& parts)
{
    WrittenAlgebroid algebroid;
    algebroid.base = model_.base.coordinates;
    algebroid.fibre = block.fibre;
    algebroid.rho = parts.rho;
    algebroid.C = parts.C;
    return lower_algebroid(graph_, lower_, algebroid);
}

/// The normal form as a tree; null where it costs too much or holds on a part of the domain only.
Tree BuildWorkspace::normal_tree(NodeId node, bool& zero)
{
    try {
        proof::NormalForm forms(graph_, setting_, solved_, node, {}, {normal_terms, normal_products});
        const proof::Fraction form = forms.of(node);
        if (!forms.condition().empty()) return nullptr;
        zero = form.is_zero();
        const auto [text, tree] = proof::print(forms.ring(), forms.readable(form), 2 * normal_length);
        return text.size() > normal_length ? nullptr : tree;
    } catch (const proof::BudgetExhausted&) {
        return nullptr;
    } catch (const proof::VanishingDivisor&) {
        return nullptr;
    }
}

void BuildWorkspace::rest_on(const AlgebroidBlock& block, const BlockParts& parts)
{
    if (construction_) construction_->algebroids.push_back(lowered(block, parts));
}

void BuildWorkspace::require_own_base(const AlgebroidBlock& block, const BlockParts& parts)
{
    if (!construction_) return;
    const Algebroid algebroid = lowered(block, parts);
    const std::set<std::size_t> base(block.base.begin(), block.base.end());
    std::vector<NodeId> outside;
    for (std::size_t i = 0; i < algebroid.x.size(); ++i)
        if (!base.contains(i)) outside.push_back(algebroid.x[i]);
    const bool stands = !depends_on_any(graph_, algebroid.entries(), outside) &&
                        std::ranges::all_of(parts.rho, [&](const AnchorValue& each) { return base.contains(each.i); });
    if (!stands) construction_.reset();
}

std::shared_ptr<const Construction> BuildWorkspace::take_construction()
{
    if (!construction_) return nullptr;
    construction_->graph = graph_;
    construction_->x = x_;
    construction_->parameters = setting_.parameters;
    construction_->domain = setting_.domain;
    return std::make_shared<const Construction>(*std::move(construction_));
}

Tree BuildWorkspace::readable(NodeId node)
{
    if (graph_.is_zero(node)) return nullptr;
    const auto known = readable_.find(node);
    if (known != readable_.end()) return known->second;
    bool zero = false;
    const Tree normal = normal_tree(node, zero);
    const Tree built = to_tree(graph_, node);
    Tree& best = readable_[node];
    if (zero) return best;
    best = built;
    std::size_t cost = cost_of(built);
    const auto offer = [&](const Tree& tree) {
        const std::size_t other = cost_of(tree);
        if (other >= cost) return;
        best = tree;
        cost = other;
    };
    if (normal != nullptr) offer(normal);
    for (const Tree& tree : {normal, built}) {
        if (tree == nullptr || cost_of(tree) > rewritten_length) continue;
        try {
            const Tree shortest = shortest_form(to_ginac(tree, symbols_), symbols_, order_);
            if (shortest->kind == TreeKind::number && shortest->number == 0) return best = nullptr;
            offer(shortest);
        } catch (const MathematicsError&) {
            continue; // the other forms stand
        }
    }
    return best;
}

void BuildWorkspace::append_structure(BlockParts& parts, std::size_t c, std::size_t a, std::size_t b, NodeId value,
                                      const SourceRange& where)
{
    if (Tree tree = readable(value)) parts.C.push_back({c, a, b, std::move(tree), where});
}

void BuildWorkspace::append_anchor(BlockParts& parts, std::size_t i, std::size_t a, NodeId value,
                                   const SourceRange& where)
{
    if (Tree tree = readable(value)) parts.rho.push_back({i, a, std::move(tree), where});
}

Decision BuildWorkspace::decide(NodeId function) const
{
    return ZeroDecider(graph_, setting_).decide(function);
}

// Linear systems of graph nodes, a block of coupled rows and columns at a time.

std::vector<CoupledBlock> coupled_blocks(const Graph& graph, const std::vector<NodeId>& matrix, std::size_t m)
{
    return coupled_blocks(m, [&](std::size_t i, std::size_t j) { return graph.is_zero(matrix[i * m + j]); });
}

namespace {

std::vector<NodeId> part_of(const std::vector<NodeId>& nodes, const Places& places)
{
    std::vector<NodeId> part;
    for (const std::size_t place : places) part.push_back(nodes[place]);
    return part;
}

/// Cramer's rule for one block; columns of `right` outside its rows do not enter.
void solve_written(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                   const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    for (std::size_t k = 0; k < right.size(); ++k) {
        const CramersRule z{graph, matrix, m, block.rows, block.columns, part_of(right[k], block.rows)};
        for (std::size_t j = 0; j < block.columns.size(); ++j) {
            const NodeId above = z.numerator(j);
            result[k][block.columns[j]] = graph.is_zero(above) ? above : graph.divide(above, z.divisor);
        }
    }
}

void solve_as_components(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m, const CoupledBlock& block,
                         const std::vector<std::vector<NodeId>>& right, std::vector<std::vector<NodeId>>& result)
{
    std::vector<NodeId> entries;
    for (const std::size_t row : block.rows)
        for (const std::size_t column : block.columns) entries.push_back(matrix[row * m + column]);
    for (std::size_t k = 0; k < right.size(); ++k) {
        const std::vector<NodeId> z = graph.solve(entries, part_of(right[k], block.rows), MatrixStructure::general);
        for (std::size_t j = 0; j < block.columns.size(); ++j) result[k][block.columns[j]] = z[j];
    }
}

} // namespace

std::vector<std::vector<NodeId>> solve_exactly(Graph& graph, const std::vector<NodeId>& matrix, std::size_t m,
                                               const std::vector<std::vector<NodeId>>& right)
{
    std::vector<std::vector<NodeId>> result(right.size(), std::vector<NodeId>(m, graph.constant(0)));
    for (const CoupledBlock& block : coupled_blocks(graph, matrix, m)) {
        if (block.rows.size() != block.columns.size()) throw InternalError("a linear system is singular by structure");
        if (block.rows.size() <= written_determinant_limit)
            solve_written(graph, matrix, m, block, right, result);
        else
            solve_as_components(graph, matrix, m, block, right, result);
    }
    return result;
}

} // namespace lagen
