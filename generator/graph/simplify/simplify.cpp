// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: several forms of the same outputs, weighed; the cheapest is kept.
#include "graph/simplify/simplify.hpp"

#include "graph/elimination/cut_solves.hpp"
#include "graph/simplify/form.hpp"
#include "graph/simplify/probe_rounding.hpp"

#include <algorithm>
#include <optional>

namespace lagen {
namespace {

/// Beyond this the outputs stay as they are: the passes are quadratic in places.
constexpr std::size_t largest_graph = 200'000;

/// Pairs of terms that stand in one sum of a form: the passes that look for shared ones take about a second for so
/// many. Forms with more are left out, but for the nested one, whose sums are short.
constexpr std::size_t largest_pairs = 20'000;

/// Beyond this many nodes only the nested form is made.
constexpr std::size_t largest_flattened_graph = 5'000;

/// A form that is so many times heavier as written is not simplified to be compared.
constexpr double hopeless = 4;

/// An elimination in scalar operations takes the place of a factorisation, which compares its pivots with the matrix,
/// only where it saves this part of the weight.
constexpr double least_gain = 0.05;

/// Sharing works on what factoring leaves and the other way round, so both orders compete.
enum class Order { factor_then_share, share_then_factor, share_only };

struct Pass {
    const char* name;
    void (*apply)(Form&);
};

std::vector<Pass> passes_of(Order order)
{
    std::vector<Pass> passes;
    const Pass draw{"factors drawn out", draw_out_factors};
    const Pass share_terms{"term pairs shared", share_term_pairs};
    const Pass share_factors{"factor pairs shared", share_factor_pairs};
    if (order == Order::share_then_factor) passes = {share_terms, draw};
    if (order == Order::factor_then_share) passes = {draw};
    passes.insert(passes.end(), {share_factors,
                                 share_terms,
                                 {"reciprocals shared", share_reciprocals},
                                 share_factors,
                                 {"single products put back", inline_single_products},
                                 {"signs absorbed", absorb_signs}});
    return passes;
}

const char* name_of(Order order)
{
    switch (order) {
    case Order::factor_then_share: return "factored, shared";
    case Order::share_then_factor: return "shared, factored";
    case Order::share_only: return "shared";
    }
    return "";
}

const char* name_of(ExpansionMode expansion)
{
    switch (expansion) {
    case ExpansionMode::nested: return "nested";
    case ExpansionMode::none: return "flattened";
    case ExpansionMode::monomials: return "monomials expanded";
    case ExpansionMode::all: return "expanded";
    }
    return "";
}

/// The operations of a form; in a copy of the graph, which stays as it would be without the question.
OperationCount count_of(const Form& form, const Graph& graph)
{
    Graph copy = graph;
    const std::vector<NodeId> outputs = rebuild(form, copy);
    return count_operations(copy, outputs);
}

std::size_t pairs_of(const Form& form)
{
    std::size_t pairs = 0;
    for (const Place& place : live_places(form)) {
        const std::size_t terms = at(form, place).size();
        pairs += terms * (terms - std::min<std::size_t>(terms, 1)) / 2;
    }
    return pairs;
}

std::optional<Form> collected(const Graph& graph, std::span<const NodeId> outputs, ExpansionMode expansion)
{
    std::optional<Form> form;
    try {
        form = collect(graph, outputs, expansion);
        if (expansion != ExpansionMode::nested && pairs_of(*form) > largest_pairs) return {};
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
    Portfolio(Graph& owner, const std::vector<NodeId>& written, SimplifyReport* listener)
        : graph(owner), candidates{written}, report(listener)
    {
        undivided = factors_of(written);
    }

    /// Forms of `outputs`, which have the values of the written ones, in every expansion of the list.
    void add_forms(const std::vector<NodeId>& outputs, const std::vector<ExpansionMode>& expansions,
                   bool of_added_angles)
    {
        const std::size_t known = candidates.size();
        of_added_angles_ = of_added_angles;
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
    SimplifyReport* report;        ///< may be null

  private:
    void add_forms(const std::vector<NodeId>& outputs, ExpansionMode expansion)
    {
        const auto form = collected(graph, outputs, expansion);
        if (!form) return;
        for (const Order order : {Order::factor_then_share, Order::share_then_factor, Order::share_only})
            for (const bool divided : {false, true})
                attempt(*form, order, divided,
                        std::string(of_added_angles_ ? "angles added, " : "") + name_of(expansion) +
                            (divided ? ", rows divided, " : ", ") + name_of(order));
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

    void improve(Form& form, Order order, const std::string& label)
    {
        OperationCount before;
        if (report != nullptr) before = count_of(form, graph);
        for (const Pass& pass : passes_of(order)) {
            pass.apply(form);
            if (report == nullptr) continue;
            const OperationCount after = count_of(form, graph);
            report->passes.push_back({label, pass.name, before, after, Stage::pass, of_added_angles_});
            before = after;
        }
    }

    void attempt(const Form& written, Order order, bool divided, const std::string& label)
    {
        try {
            Form form = written;
            if (divided && divide_rows(form) == 0) return;
            improve(form, order, label);
            std::vector<NodeId> outputs = rebuild(form, graph);
            const std::vector<NodeId> appended(outputs.begin() + static_cast<std::ptrdiff_t>(written.roots.size()),
                                               outputs.end());
            outputs.resize(written.roots.size());
            note(divided ? divisors : undivided, divided ? appended : factors_of(outputs));
            candidates.push_back(std::move(outputs));
        } catch (const FormRefused&) {    // too large in this form
        } catch (const DivisionByZero&) { // a divisor vanishes identically: the outputs stay as written
        }
    }

    static void note(std::vector<NodeId>& sorted, const std::vector<NodeId>& more)
    {
        sorted.insert(sorted.end(), more.begin(), more.end());
        std::ranges::sort(sorted);
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    }

    bool of_added_angles_ = false; ///< of the forms that are made now
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

std::vector<ExpansionMode> expansions_for(std::size_t nodes)
{
    if (nodes > largest_flattened_graph) return {ExpansionMode::nested};
    return {ExpansionMode::none, ExpansionMode::monomials, ExpansionMode::all, ExpansionMode::nested};
}

void tell(SimplifyReport* report, const Graph& graph, Stage stage, const OperationCount& before,
          const std::vector<NodeId>& outputs)
{
    if (report != nullptr)
        report->passes.push_back({to_text(stage), "", before, count_operations(graph, outputs), stage});
}

/// The forms of the outputs whose linear systems stay nodes.
std::vector<NodeId> simplify_pieces(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                                    SimplifyReport* report)
{
    std::vector<NodeId> best(outputs.begin(), outputs.end());
    const std::size_t size = reachable(graph, outputs).size();
    if (size > largest_graph) return best;
    const OperationCount written = count_operations(graph, best);
    double weight = written.weight;
    Portfolio portfolio(graph, best, report);
    portfolio.add_forms(best, expansions_for(size), false);
    if (const auto added = add_angles(graph, outputs); added != best) {
        tell(report, graph, Stage::angles_added, written, added);
        portfolio.add_forms(added, {ExpansionMode::none, ExpansionMode::nested}, true);
    }
    for (const auto& candidate : portfolio.candidates) {
        const double tried = count_operations(graph, candidate).weight;
        if (tried < weight) {
            weight = tried;
            best = candidate;
        }
    }
    tell(report, graph, Stage::lightest, written, best);
    mix(graph, best, weight, portfolio.candidates);
    tell(report, graph, Stage::mixed, written, best);
    if (portfolio.has_divided(best)) divisors = portfolio.divisors;
    return best;
}

/// Solved through the terms of remembered Hessians; empty where there are none.
std::vector<NodeId> eliminated(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& pivots,
                               SimplifyReport* report)
{
    const CutSolves cut(graph, outputs);
    if (cut.pieces().empty()) return {};
    const std::vector<NodeId> pieces = simplify_pieces(graph, cut.pieces(), pivots, report);
    std::vector<NodeId> joined = cut.join(pieces, pivots);
    if (!joined.empty()) tell(report, graph, Stage::eliminated, count_operations(graph, outputs), joined);
    return joined;
}

std::vector<NodeId> choose_form(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                                SimplifyReport* report)
{
    std::vector<NodeId> pivots;
    std::vector<NodeId> sparse = eliminated(graph, outputs, pivots, report);
    if (sparse.empty()) return simplify_pieces(graph, outputs, divisors, report);
    const double weight = count_operations(graph, sparse).weight;
    if (count_operations(graph, outputs).weight < hopeless * weight) {
        std::vector<NodeId> factorised = simplify_pieces(graph, outputs, divisors, report);
        if (weight >= (1 - least_gain) * count_operations(graph, factorised).weight) return factorised;
    }
    divisors = std::move(pivots);
    return sparse;
}

} // namespace

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs)
{
    std::vector<NodeId> divisors;
    return simplify(graph, outputs, divisors);
}

std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                             SimplifyReport* report)
{
    constexpr std::size_t terms_told = 10;
    std::vector<NodeId> result = choose_form(graph, outputs, divisors, report);
    if (report != nullptr) {
        report->written = count_operations(graph, outputs);
        report->kept = count_operations(graph, result);
        report->costliest = costliest_terms(graph, result, terms_told);
    }
    return result;
}

} // namespace lagen
