// SPDX-License-Identifier: GPL-2.0-or-later
#include "advice/advise.hpp"

#include "advice/repair.hpp"
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

/// Products of a matrix with its transpose, in the one order and in the other.
class MatrixProducts {
  public:
    MatrixProducts(const System& system, Judge& judge, Graph& graph, BaseGradient& partial)
        : system_(system), judge_(judge), graph_(graph), partial_(partial)
    {
    }

    /// "R*transpose(R)", which the anchor keeps, where `f` is this entry of transpose(R)*R up to a constant, and the
    /// other way round; "" where nothing is known.
    [[nodiscard]] std::string other_than(NodeId f, const MatrixPlace& place)
    {
        for (const auto& [name, R] : square_matrices(graph_, system_.algebroid.x)) {
            const auto order = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(R.size()))));
            if (std::max(place.row, place.column) > order) continue;
            std::vector<NodeId> turned; // R^T
            for (std::size_t k = 0; k < R.size(); ++k) turned.push_back(R[k % order * order + k / order]);
            const std::vector<NodeId> rows = matrix_product(graph_, R, turned, order);
            const std::vector<NodeId> columns = matrix_product(graph_, turned, R, order);
            const std::size_t entry = (place.row - 1) * order + place.column - 1;
            if (is_constant(graph_.subtract(f, columns[entry])) && are_kept(rows))
                return name + "*transpose(" + name + ")";
            if (is_constant(graph_.subtract(f, rows[entry])) && are_kept(columns))
                return "transpose(" + name + ")*" + name;
        }
        return {};
    }

  private:
    [[nodiscard]] bool is_zero(NodeId f) { return graph_.is_zero(f) || judge_.decide(f).status == ProofStatus::proved; }
    [[nodiscard]] bool is_constant(NodeId f)
    {
        return std::ranges::all_of(Column(partial_.of(f)),
                                   [this](const ColumnEntry& slope) { return is_zero(slope.value); });
    }
    [[nodiscard]] bool are_kept(const std::vector<NodeId>& functions)
    {
        return std::ranges::all_of(functions, [this](NodeId f) {
            return std::ranges::all_of(system_.algebroid.anchor,
                                       [&](const VectorField& rho) { return is_zero(partial_.along(rho, f)); });
        });
    }

    const System& system_;
    Judge& judge_;
    Graph& graph_;
    BaseGradient& partial_;
};

/// To matrices of Casimirs that are refuted: R*transpose(R) for transpose(R)*R.
void advise_of_products(const System& system, Report& report, Judge& judge, Graph& graph, BaseGradient& partial)
{
    MatrixProducts products(system, judge, graph, partial);
    std::map<std::string, std::string> of_claim;
    for (Check& check : report.structure.checks) {
        if (check.name != "casimir" || check.decision.status != ProofStatus::refuted) continue;
        const auto place = matrix_entry(check.indices.back());
        const auto casimir = std::ranges::find(system.casimirs, check.indices.back(), &BaseFunctionText::name);
        if (!place || casimir == system.casimirs.end()) continue;
        const auto [hint, first] = of_claim.try_emplace(place->family);
        const NodeId f = system.functions.casimirs[static_cast<std::size_t>(casimir - system.casimirs.begin())];
        if (first) hint->second = products.other_than(f, *place);
        if (!hint->second.empty())
            check.hint = hint->second +
                         " is constant along all motions of the algebroid: rho(e) of each of its entries is "
                         "0 for each section e";
    }
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
    Judge judge(graph, proof_setting(graph, system), budget);
    for (std::size_t k = 0; k < list.residuals.size(); ++k)
        judge.remember(list.residuals[k].value, report.structure.checks[k].decision);
    const std::vector<std::string> hints = repair_hints(judge, partial, system.algebroid, system.written.algebroid,
                                                        system.functions, system.editable, list);
    for (std::size_t k = 0; k < hints.size(); ++k) {
        Check& check = report.structure.checks[k];
        const bool casimir = check.name == "casimir" && check.decision.status == ProofStatus::refuted;
        check.hint = hints[k].empty() && casimir ? casimir_hint : hints[k];
    }
    advise_of_products(system, report, judge, graph, partial);
}

} // namespace lagen
