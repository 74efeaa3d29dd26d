// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: several forms of the same outputs, weighed; the cheapest is kept.
#include "graph/simplify.hpp"

#include "graph/form.hpp"

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

std::optional<std::vector<NodeId>> attempt(Graph& graph, const Form& collected, Order order)
{
    try {
        Form form = collected;
        improve(form, order);
        return rebuild(form, graph);
    } catch (const FormRefused&) {
        return std::nullopt; // too large in this form
    } catch (const MathematicsError&) {
        return std::nullopt; // a divisor vanishes identically: the outputs stay as written
    }
}

std::optional<Form> collected(const Graph& graph, std::span<const NodeId> outputs, Expansion expansion)
{
    try {
        return collect(graph, outputs, expansion);
    } catch (const FormRefused&) {
        return std::nullopt;
    }
}

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
    std::vector<NodeId> best(outputs.begin(), outputs.end());
    if (reachable(graph, outputs).size() > largest_graph) return best;
    double weight = count_operations(graph, best).weight;
    std::vector<std::vector<NodeId>> candidates{best};
    for (const Expansion expansion : {Expansion::none, Expansion::monomials, Expansion::all}) {
        const auto form = collected(graph, outputs, expansion);
        if (!form) continue;
        for (const Order order : {Order::factor_then_share, Order::share_then_factor, Order::share_only})
            if (auto candidate = attempt(graph, *form, order)) candidates.push_back(std::move(*candidate));
    }
    for (const auto& candidate : candidates) {
        const double tried = count_operations(graph, candidate).weight;
        if (tried < weight) {
            weight = tried;
            best = candidate;
        }
    }
    mix(graph, best, weight, candidates);
    return best;
}

} // namespace lagen
