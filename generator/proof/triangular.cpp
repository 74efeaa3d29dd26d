// SPDX-License-Identifier: GPL-2.0-or-later
/// Which coordinate each constraint solves for: a short search that prefers constant leading coefficients and late
/// coordinates.
#include "proof/triangular.hpp"

#include "graph/core/operators.hpp"
#include "proof/print_fraction.hpp"

#include <algorithm>
#include <set>

namespace lagen::proof {

namespace {

constexpr std::size_t most_assignments = 20'000;

struct Candidate {
    NodeId variable = 0;
    unsigned degree = 1;
    bool pure = true;
    int cost = 0; ///< 0 linear, 1 monic power, 2 linear with a variable coefficient, 3 power with one
};

struct Analysed {
    std::vector<Candidate> candidates; ///< best first
    std::set<NodeId> variables;        ///< every input of the constraint
};

/// Inputs that stand under a function or in a divisor.
std::set<NodeId> entangled(const Graph& graph, NodeId root)
{
    std::vector<NodeId> arguments;
    for (const NodeId node : reachable(graph, std::vector<NodeId>{root})) {
        const auto operands = graph.operands(node);
        const Op op = graph.op(node);
        if (kind_of(op) == OpKind::quotient) {
            arguments.push_back(operands[1]);
        } else if (!is_rational(op) || domain_of(graph, node) != Sense::always) {
            arguments.insert(arguments.end(), operands.begin(), operands.end());
        }
    }
    const std::vector<NodeId> below = reachable(graph, arguments);
    return {below.begin(), below.end()};
}

Candidate candidate_for(NodeId variable, GeneratorId id, const Polynomial& h, Work& work)
{
    Candidate candidate{variable, 0, true, 0};
    for (const Term& term : h) candidate.degree = std::max(candidate.degree, term.monomial.exponent_of(id));
    Polynomial leading;
    for (const Term& term : h) {
        const unsigned exponent = term.monomial.exponent_of(id);
        if (exponent == candidate.degree) leading.push_back({term.monomial.without(id), term.coefficient});
        if (exponent > 0 && exponent < candidate.degree) candidate.pure = false;
    }
    leading = collect(std::move(leading), work);
    candidate.cost = (candidate.degree > 1 ? 1 : 0) + (is_constant(leading) ? 0 : 2);
    const bool monic = is_constant(leading) && abs(leading[0].coefficient) == 1;
    if (!candidate.pure && (candidate.degree > 2 || !monic)) candidate.degree = 0; // not a form that can be solved
    return candidate;
}

Analysed analyse(const Graph& graph, const ProofSetting& setting, std::size_t index)
{
    const NodeId constraint = setting.constraints[index];
    const std::vector<SolvedConstraint> none;
    NormalForm forms(graph, setting, none, constraint, {}, {20'000, 20'000'000});
    const Polynomial h = forms.of(constraint).num;
    const std::set<NodeId> excluded = entangled(graph, constraint);
    Analysed result;
    for (const NodeId node : reachable(graph, std::vector<NodeId>{constraint}))
        if (graph.op(node) == Op::input) result.variables.insert(node);
    for (std::size_t k = setting.variables.size(); k-- > 0;) {
        const NodeId variable = setting.variables[k];
        if (result.variables.count(variable) == 0 || excluded.count(variable) > 0) continue;
        const Candidate candidate = candidate_for(variable, forms.generator_of(variable), h, forms.ring().work());
        if (candidate.degree > 0) result.candidates.push_back(candidate);
    }
    std::stable_sort(result.candidates.begin(), result.candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
    return result;
}

/// An order in which every constraint comes after those whose coordinates it needs; empty where they wait for each
/// other.
std::vector<std::size_t> solving_order(const std::vector<Analysed>& all, const std::vector<Candidate>& chosen)
{
    std::vector<std::size_t> order;
    std::vector<bool> placed(all.size(), false);
    for (bool progress = true; progress && order.size() < all.size();) {
        progress = false;
        for (std::size_t i = 0; i < all.size(); ++i) {
            bool ready = !placed[i];
            for (std::size_t j = 0; ready && j < all.size(); ++j)
                ready = j == i || placed[j] || all[i].variables.count(chosen[j].variable) == 0;
            if (!ready) continue;
            placed[i] = progress = true;
            order.push_back(i);
        }
    }
    return order.size() == all.size() ? order : std::vector<std::size_t>();
}

/// Chooses candidates for constraints k, k + 1, ...; the depth is the number of constraints.
bool assign(const std::vector<Analysed>& all, std::vector<Candidate>& chosen, std::size_t& budget)
{
    if (budget == 0) return false;
    --budget;
    const std::size_t k = chosen.size();
    if (k == all.size()) return k == 0 || !solving_order(all, chosen).empty();
    for (const Candidate& candidate : all[k].candidates) {
        const bool taken = std::any_of(chosen.begin(), chosen.end(),
                                       [&](const Candidate& other) { return other.variable == candidate.variable; });
        if (taken) continue;
        chosen.push_back(candidate);
        if (assign(all, chosen, budget)) return true;
        chosen.pop_back();
    }
    return false;
}

} // namespace

std::vector<SolvedConstraint> triangular_constraints(const Graph& graph, const ProofSetting& setting)
{
    std::vector<Analysed> all;
    std::vector<Candidate> chosen;
    for (std::size_t k = 0; k < setting.constraints.size(); ++k) {
        const std::string what =
            "base constraint " + std::to_string(k + 1) + ", " + to_text(graph, setting.constraints[k], 120);
        const auto refuse = [&](const std::runtime_error& reason) {
            throw TriangularityError(what + ", cannot be brought to a polynomial form: " + reason.what(), k);
        };
        try {
            all.push_back(analyse(graph, setting, k));
        } catch (const BudgetExhausted& error) {
            refuse(error);
        } catch (const VanishingDivisor& error) {
            refuse(error);
        }
        std::size_t budget = most_assignments;
        chosen.clear();
        if (!assign(all, chosen, budget))
            throw TriangularityError(
                what + ", is not triangular: it must solve for a base coordinate that no other constraint "
                       "solves for, linearly or as a power with a constant coefficient",
                k);
    }
    std::vector<SolvedConstraint> solved;
    for (const std::size_t k : solving_order(all, chosen))
        solved.push_back({k, chosen[k].variable, chosen[k].degree, chosen[k].pure, chosen[k].cost < 2});
    return solved;
}

bool keep_triangular(const Graph& graph, ProofSetting& setting)
{
    ProofSetting growing = setting;
    growing.constraints.clear();
    for (const NodeId constraint : setting.constraints) {
        growing.constraints.push_back(constraint);
        try {
            (void)triangular_constraints(graph, growing);
        } catch (const TriangularityError&) {
            growing.constraints.pop_back();
        }
    }
    const bool complete = growing.constraints.size() == setting.constraints.size();
    setting.constraints = std::move(growing.constraints);
    return !complete;
}

} // namespace lagen::proof

namespace lagen {

std::unique_ptr<ZeroDecider> ZeroDecider::make(const Graph& graph, ProofSetting setting, ProofBudget budget)
{
    try {
        return std::make_unique<ZeroDecider>(graph, std::move(setting), budget);
    } catch (const TriangularityError&) {
        return nullptr;
    }
}

} // namespace lagen
