// SPDX-License-Identifier: GPL-2.0-or-later
/// Elimination along the definitions of a sparse Hessian, in scalar operations.
#include "graph/sparse_hessian.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace lagen {
namespace {

using Terms = SparseHessian::Terms;

/// With up to so many partners H_ja H_ak is multiplied out while the reciprocal is on its way: the next pivot waits for
/// two operations less, which is what a chain of pivots takes most of its time for.
constexpr std::size_t largest_early_products = 3;

/// Nodes that one elimination may make: a matrix without structure has n^3/6 of them, and stays one node instead.
constexpr std::size_t largest_elimination = 500'000;

class Eliminator {
  public:
    Eliminator(Graph& graph, const SparseHessian& hessian)
        : graph_(graph), hessian_(hessian), rows_(hessian.definitions.size()), holders_(hessian.order),
          gone_(hessian.definitions.size(), false)
    {
        for (const SparseHessian::Entry& entry : hessian.entries) add(entry.row, entry.column, entry.value);
        find_holders();
        result_.order = hessian.order;
        for (std::size_t k = 0; k < rows_.size(); ++k) result_.is_term.push_back(k >= hessian.order);
    }

    std::optional<Elimination> run()
    {
        const std::size_t limit = graph_.size() + largest_elimination;
        for (std::size_t left = hessian_.order; left > 0; --left) {
            const std::size_t next = choose();
            std::vector<std::size_t> multiples;
            for (const std::size_t term : holders_[next]) { // users first
                if (gone_[term]) continue;
                gone_[term] = true;
                const Terms& terms = hessian_.definitions[term];
                result_.steps.push_back({term, terms, 0});
                if (terms.size() == 1 && terms[0].first == next)
                    multiples.push_back(term);
                else
                    put_in(term);
            }
            gone_[next] = true;
            put_in_multiples(multiples, next);
            const auto pivot = rows_[next].find(next);
            if (pivot == rows_[next].end() || graph_.size() > limit) return {};
            const NodeId value = pivot->second;
            result_.steps.push_back({next, multipliers(next, value), value});
        }
        return std::move(result_);
    }

  private:
    using Row = std::map<std::size_t, NodeId>;

    /// By variable: the terms that depend on it, in descending order.
    void find_holders()
    {
        std::vector<std::set<std::size_t>> variables(rows_.size());
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (k < hessian_.order) variables[k] = {k};
            for (const auto& [operand, coefficient] : hessian_.definitions[k])
                variables[k].insert(variables[operand].begin(), variables[operand].end());
        }
        for (std::size_t k = rows_.size(); k-- > hessian_.order;)
            for (const std::size_t variable : variables[k]) holders_[variable].push_back(k);
    }

    /// The variable that the fewest terms hide; of several the last.
    [[nodiscard]] std::size_t choose() const
    {
        std::size_t best = 0;
        std::size_t fewest = SIZE_MAX;
        for (std::size_t k = hessian_.order; k-- > 0;) {
            if (gone_[k]) continue;
            const auto hidden = static_cast<std::size_t>(
                std::ranges::count_if(holders_[k], [this](std::size_t term) { return !gone_[term]; }));
            if (hidden >= fewest) continue;
            best = k;
            fewest = hidden;
        }
        return best;
    }

    void add(std::size_t i, std::size_t j, NodeId value)
    {
        if (graph_.is_zero(value)) return;
        const auto [place, fresh] = rows_[i].try_emplace(j, value);
        if (!fresh) place->second = graph_.add(place->second, value);
        const NodeId sum = place->second;
        if (graph_.is_zero(sum)) {
            rows_[i].erase(j);
            rows_[j].erase(i);
        } else {
            rows_[j][i] = sum;
        }
    }

    [[nodiscard]] NodeId entry(std::size_t i, std::size_t j)
    {
        const auto found = rows_[i].find(j);
        return found == rows_[i].end() ? graph_.constant(0) : found->second;
    }

    [[nodiscard]] Row take_row(std::size_t k)
    {
        Row row = std::move(rows_[k]);
        rows_[k].clear();
        for (const auto& [j, value] : row)
            if (j != k) rows_[j].erase(k);
        return row;
    }

    /// u = sum alpha_w w in u^T H u.
    void put_in(std::size_t u)
    {
        const Terms& terms = hessian_.definitions[u];
        const Row row = take_row(u);
        for (const auto& [j, value] : row) {
            if (j == u) continue;
            for (const auto& [operand, coefficient] : terms) {
                const NodeId product = graph_.multiply(coefficient, value);
                add(j, operand, j == operand ? graph_.multiply(graph_.constant(2), product) : product);
            }
        }
        const auto diagonal = row.find(u);
        if (diagonal == row.end()) return;
        for (std::size_t p = 0; p < terms.size(); ++p) {
            const NodeId product = graph_.multiply(terms[p].second, diagonal->second);
            for (std::size_t q = p; q < terms.size(); ++q)
                add(terms[p].first, terms[q].first, graph_.multiply(product, terms[q].second));
        }
    }

    /// All u = alpha_u y at once: H_jy = sum_u alpha_u H_ju, then H_yy = sum_u alpha_u H_uy, products that the rows of
    /// other terms share.
    void put_in_multiples(const std::vector<std::size_t>& multiples, std::size_t y)
    {
        const auto factor = [&](std::size_t u) { return hessian_.definitions[u][0].second; };
        NodeId diagonal = entry(y, y);
        for (const std::size_t u : multiples) {
            const NodeId own = entry(u, y);
            NodeId half = own;
            for (const std::size_t w : multiples) half = graph_.add(half, graph_.multiply(factor(w), entry(u, w)));
            diagonal = graph_.add(diagonal, graph_.multiply(factor(u), graph_.add(own, half)));
        }
        std::map<std::size_t, NodeId> column;
        for (const std::size_t u : multiples)
            for (const auto& [j, value] : rows_[u]) {
                if (j == y || std::ranges::find(multiples, j) != multiples.end()) continue;
                const NodeId product = graph_.multiply(factor(u), value);
                const auto [place, fresh] = column.try_emplace(j, product);
                if (!fresh) place->second = graph_.add(place->second, product);
            }
        for (const std::size_t u : multiples) static_cast<void>(take_row(u));
        for (const auto& [j, value] : column) add(j, y, value);
        rows_[y].erase(y);
        add(y, y, diagonal);
    }

    /// H_jk -= H_ja H_ak / H_aa; answers H_ja / H_aa.
    Terms multipliers(std::size_t a, NodeId pivot)
    {
        Row row = take_row(a);
        row.erase(a);
        if (row.empty()) return {};
        const NodeId reciprocal = graph_.divide(graph_.constant(1), pivot);
        const bool few = row.size() <= largest_early_products;
        Terms result;
        for (const auto& [j, value] : row) {
            const NodeId multiplier = graph_.multiply(value, reciprocal);
            for (const auto& [k, other] : row) {
                if (k < j) continue;
                const NodeId product = few ? graph_.multiply(graph_.multiply(value, other), reciprocal)
                                           : graph_.multiply(multiplier, other);
                add(j, k, graph_.negate(product));
            }
            result.emplace_back(j, multiplier);
        }
        return result;
    }

    Graph& graph_;
    const SparseHessian& hessian_;
    std::vector<Row> rows_; ///< H, both triangles
    std::vector<std::vector<std::size_t>> holders_;
    std::vector<bool> gone_;
    Elimination result_;
};

} // namespace

std::optional<Elimination> eliminate(Graph& graph, const SparseHessian& hessian)
{
    return Eliminator(graph, hessian).run();
}

std::vector<NodeId> solve_by(Graph& graph, const Elimination& elimination, std::span<const NodeId> right)
{
    if (right.size() != elimination.order) throw InternalError("solve_by() wants one entry of b for every variable");
    std::vector<NodeId> force(elimination.is_term.size(), graph.constant(0));
    std::copy(right.begin(), right.end(), force.begin());
    for (const Elimination::Step& step : elimination.steps)
        for (const auto& [variable, factor] : step.terms) {
            const NodeId product = graph.multiply(factor, force[step.variable]);
            force[variable] = elimination.is_term[step.variable] ? graph.add(force[variable], product)
                                                                 : graph.subtract(force[variable], product);
        }
    std::vector<NodeId> z(elimination.is_term.size(), graph.constant(0));
    for (std::size_t k = elimination.steps.size(); k-- > 0;) {
        const Elimination::Step& step = elimination.steps[k];
        const bool term = elimination.is_term[step.variable];
        NodeId value = graph.constant(0);
        if (!term) value = graph.multiply(force[step.variable], graph.divide(graph.constant(1), step.pivot));
        for (const auto& [variable, factor] : step.terms) {
            const NodeId product = graph.multiply(factor, z[variable]);
            value = term ? graph.add(value, product) : graph.subtract(value, product);
        }
        z[step.variable] = value;
    }
    z.resize(elimination.order);
    return z;
}

} // namespace lagen
