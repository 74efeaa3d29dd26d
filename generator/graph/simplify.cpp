// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: several forms of the same outputs, weighed; the cheapest is kept.
#include "graph/simplify.hpp"

#include "graph/form.hpp"
#include "graph/probe_rounding.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>

namespace lagen {
namespace {

/// Beyond this the outputs stay as they are: the passes are quadratic in places.
constexpr std::size_t largest_graph = 50'000;

/// Sharing works on what factoring leaves and the other way round, so both orders compete.
enum class Order { factor_then_share, share_then_factor, share_only };

void improve(Form& form, Order order)
{
    if (order == Order::share_then_factor) {
        share_term_pairs(form);
        draw_out_factors(form);
    } else if (order == Order::factor_then_share) {
        draw_out_factors(form);
    }
    share_factor_pairs(form);
    share_term_pairs(form);
    share_reciprocals(form);
    share_factor_pairs(form);
    inline_single_products(form);
    absorb_signs(form);
}

std::optional<Form> collected(const Graph& graph, std::span<const NodeId> outputs, ExpansionMode expansion)
{
    std::optional<Form> form;
    try {
        form = collect(graph, outputs, expansion);
        Form shorter = *form;
        cancel_terms(shorter);
        return shorter;
    } catch (const FormRefused&) {
        return form; // too large to collect (nothing), or to look for terms that cancel
    }
}

/// The candidates, and what those with divided rows were divided by. A divisor of one is zero only where the matrix is
/// singular as written, so all of them may be asked for whenever one is needed.
struct Portfolio {
    Portfolio(Graph& owner, const std::vector<NodeId>& written) : graph(owner), candidates{written}
    {
        undivided = factors_of(written);
    }

    /// Forms of `outputs`, which have the values of the written ones, in every expansion of the list.
    void add_forms(const std::vector<NodeId>& outputs, std::initializer_list<ExpansionMode> expansions)
    {
        const std::size_t known = candidates.size();
        for (const ExpansionMode expansion : expansions) add_forms(outputs, expansion);
        give_back_digits(outputs, known);
    }

    /// Do the outputs contain a matrix whose rows were divided?
    [[nodiscard]] bool has_divided(const std::vector<NodeId>& outputs) const
    {
        return !std::ranges::includes(undivided, factors_of(outputs));
    }

    Graph& graph;
    std::vector<std::vector<NodeId>> candidates;
    std::vector<NodeId> divisors;
    std::vector<NodeId> undivided; ///< factorisations of the candidates with rows as they were, ascending

  private:
    void add_forms(const std::vector<NodeId>& outputs, ExpansionMode expansion)
    {
        const auto form = collected(graph, outputs, expansion);
        if (!form) return;
        for (const Order order : {Order::factor_then_share, Order::share_then_factor, Order::share_only})
            for (const bool divided : {false, true}) attempt(*form, order, divided);
    }

    /// Outputs of the candidates from `first` on that lose digits become those of `outputs` again.
    void give_back_digits(const std::vector<NodeId>& outputs, std::size_t first)
    {
        const bool alone = std::all_of(candidates.begin() + static_cast<std::ptrdiff_t>(first), candidates.end(),
                                       [&](const auto& candidate) { return candidate == outputs; });
        if (alone) return;
        note(undivided, factors_of(outputs));
        const RoundingProbe probe(graph, outputs);
        for (std::size_t c = first; c < candidates.size(); ++c) {
            const std::vector<bool> keeps = probe.keeps_digits(candidates[c]);
            for (std::size_t k = 0; k < outputs.size(); ++k)
                if (!keeps[k]) candidates[c][k] = outputs[k];
        }
    }

    [[nodiscard]] std::vector<NodeId> factors_of(const std::vector<NodeId>& outputs) const
    {
        std::vector<NodeId> factors = reachable(graph, outputs);
        std::erase_if(factors, [this](NodeId id) { return graph.op(id) != Op::factor; });
        return factors;
    }

    void attempt(const Form& written, Order order, bool divided)
    {
        try {
            Form form = written;
            if (divided && divide_rows(form) == 0) return;
            improve(form, order);
            std::vector<NodeId> outputs = rebuild(form, graph);
            const std::vector<NodeId> appended(outputs.begin() + static_cast<std::ptrdiff_t>(written.roots.size()),
                                               outputs.end());
            outputs.resize(written.roots.size());
            note(divided ? divisors : undivided, divided ? appended : factors_of(outputs));
            candidates.push_back(std::move(outputs));
        } catch (const FormRefused&) {      // too large in this form
        } catch (const MathematicsError&) { // a divisor vanishes identically: the outputs stay as written
        }
    }

    static void note(std::vector<NodeId>& sorted, const std::vector<NodeId>& more)
    {
        sorted.insert(sorted.end(), more.begin(), more.end());
        std::ranges::sort(sorted);
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    }
};

/// Replaces single outputs of `best` by another candidate's where that makes the whole lighter.
void mix(const Graph& graph, std::vector<NodeId>& best, double& weight,
         const std::vector<std::vector<NodeId>>& candidates)
{
    constexpr std::size_t largest_effort = 2'000'000; // nodes visited
    if (best.size() * candidates.size() * reachable(graph, best).size() > largest_effort) return;
    for (std::size_t k = 0; k < best.size(); ++k)
        for (const auto& candidate : candidates) {
            const NodeId kept = best[k];
            if (candidate[k] == kept) continue;
            best[k] = candidate[k];
            const double tried = count_operations(graph, best).weight;
            if (tried < weight)
                weight = tried;
            else
                best[k] = kept;
        }
}

} // namespace

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs)
{
    std::vector<NodeId> divisors;
    return simplify(graph, outputs, divisors);
}

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors)
{
    std::vector<NodeId> best(outputs.begin(), outputs.end());
    if (reachable(graph, outputs).size() > largest_graph) return best;
    double weight = count_operations(graph, best).weight;
    Portfolio portfolio(graph, best);
    portfolio.add_forms(best, {ExpansionMode::none, ExpansionMode::monomials, ExpansionMode::all});
    if (const auto added = add_angles(graph, outputs); added != best) portfolio.add_forms(added, {ExpansionMode::none});
    for (const auto& candidate : portfolio.candidates) {
        const double tried = count_operations(graph, candidate).weight;
        if (tried < weight) {
            weight = tried;
            best = candidate;
        }
    }
    mix(graph, best, weight, portfolio.candidates);
    if (portfolio.has_divided(best)) divisors = portfolio.divisors;
    return best;
}

} // namespace lagen
