// SPDX-License-Identifier: GPL-2.0-or-later
#include "advice/advise.hpp"

#include "advice/repair_search.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace lagen {

namespace {

/// To a Casimir for which no repair was found: it may be no Casimir at all, but a joint.
constexpr const char* casimir_hint =
    "a Casimir is constant along all motions of the algebroid, whatever L is: rho(e) of it is 0 for each section e. "
    "What holds on M alone, as a joint of a linkage does, is one of [base] constraints; kind = \"level_set\" takes any";

/// "R" of R[2,3], with the place; nothing of a name that is no entry of a matrix.
struct MatrixPlace {
    std::string family;
    std::size_t row = 0, column = 0;
};
std::optional<MatrixPlace> matrix_entry(const std::string& name)
{
    MatrixPlace entry;
    const std::size_t open = name.find('['), comma = name.find(','), close = name.find(']');
    if (open == std::string::npos || comma == std::string::npos || close != name.size() - 1) return std::nullopt;
    entry.family = name.substr(0, open);
    entry.row = std::strtoul(name.c_str() + open + 1, nullptr, 10);
    entry.column = std::strtoul(name.c_str() + comma + 1, nullptr, 10);
    if (entry.row == 0 || entry.column == 0) return std::nullopt;
    return entry;
}

/// The square matrices among the base coordinates, by rows.
std::map<std::string, std::vector<NodeId>> square_matrices(const Graph& graph, const std::vector<NodeId>& x)
{
    std::map<std::string, std::vector<NodeId>> matrices;
    std::map<std::string, std::size_t> orders;
    for (const NodeId input : x)
        if (const auto entry = matrix_entry(graph.input_name(input))) {
            matrices[entry->family].push_back(input);
            std::size_t& order = orders[entry->family];
            order = std::max({order, entry->row, entry->column});
        }
    std::erase_if(matrices, [&](const auto& each) {
        const std::size_t order = orders[each.first];
        return each.second.size() != order * order;
    });
    return matrices;
}

/// "R*transpose(R)" where the anchor turns R from the right, "transpose(R)*R" where it does from the left: the product
/// that every motion keeps, in the place of the other one that was claimed; empty where there is none.
std::string kept_product(const System& system, Judge& judge, Graph& graph, BaseGradient& partial)
{
    for (const auto& [name, R] : square_matrices(graph, system.algebroid.x)) {
        const auto order = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(R.size()))));
        std::vector<NodeId> turned; // R^T
        for (std::size_t k = 0; k < R.size(); ++k) turned.push_back(R[k % order * order + k / order]);
        const auto is_kept = [&](NodeId f) {
            return std::ranges::all_of(system.algebroid.anchor, [&](const VectorField& rho) {
                const NodeId rate = partial.along(rho, f);
                return graph.is_zero(rate) || judge.decide(rate).status == ProofStatus::proved;
            });
        };
        if (std::ranges::all_of(R, is_kept)) continue; // nothing moves it
        if (std::ranges::all_of(matrix_product(graph, R, turned, order), is_kept))
            return name + "*transpose(" + name + ")";
        if (std::ranges::all_of(matrix_product(graph, turned, R, order), is_kept))
            return "transpose(" + name + ")*" + name;
    }
    return {};
}

/// To what claims a matrix of functions to be constant, which its rates refute.
void advise_of_products(const System& system, Report& report, Judge& judge, Graph& graph, BaseGradient& partial)
{
    const auto claims_matrix = [](const Check& check) {
        return (check.name == "casimir" || check.name == "invariant") &&
               check.decision.status == ProofStatus::refuted && matrix_entry(check.indices.back());
    };
    if (std::ranges::none_of(report.structure.checks, claims_matrix)) return;
    const std::string product = kept_product(system, judge, graph, partial);
    if (product.empty()) return;
    for (Check& check : report.structure.checks)
        if (claims_matrix(check))
            check.hint = product + " is constant along all motions of the algebroid: rho(e) of each of its entries is "
                                   "0 for each section e";
}

} // namespace

void advise(const System& system, Report& report, const ProofBudget& budget)
{
    if (system.written.algebroid.r() != system.r()) return;
    if (std::ranges::none_of(report.structure.checks,
                             [](const Check& check) { return check.decision.status == ProofStatus::refuted; }))
        return;
    Graph graph = system.graph;
    BaseGradient partial(graph, system.algebroid.x);
    const ResidualList list = structure_equations(partial, system.algebroid, system.functions);
    // The checks of the report begin with these equations, in their order.
    if (report.structure.checks.size() < list.residuals.size()) throw InternalError("a report of another system");
    Judge judge(graph, proof_setting(graph, system), 0, budget);
    for (std::size_t k = 0; k < list.residuals.size(); ++k)
        judge.remember(list.residuals[k].value, report.structure.checks[k].decision);
    RepairSearch search(graph, partial, judge, system.written.algebroid, system.algebroid, system.functions,
                        system.editable);
    const std::vector<std::string> hints = search.hints(list);
    for (std::size_t k = 0; k < hints.size(); ++k) {
        Check& check = report.structure.checks[k];
        const bool casimir = check.name == "casimir" && check.decision.status == ProofStatus::refuted;
        check.hint = hints[k].empty() && casimir ? casimir_hint : hints[k];
    }
    advise_of_products(system, report, judge, graph, partial);
}

} // namespace lagen
