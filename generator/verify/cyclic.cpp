// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/cyclic.hpp"

#include "graph/calculus/differentiate.hpp"
#include "text/activity.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// Functions that must be free of a coordinate, by what they are called.
struct Functions {
    const char* name;
    std::vector<NodeId> nodes;
};

std::vector<Functions> functions_of(const System& system)
{
    std::vector<Functions> all;
    if (system.lagrangian)
        all.push_back({"L", {*system.lagrangian}});
    else
        all.push_back({"H", {*system.hamiltonian}});
    Functions rho{"rho", {}}, C{"C", {}};
    for (const Column& column : system.algebroid.anchor)
        for (const ColumnEntry& entry : column) rho.nodes.push_back(entry.value);
    for (std::size_t a = 0; a < system.r(); ++a)
        for (std::size_t b = 0; b < system.r(); ++b)
            for (const ColumnEntry& entry : system.algebroid.C(a, b)) C.nodes.push_back(entry.value);
    all.push_back(std::move(rho));
    all.push_back(std::move(C));
    all.push_back({"forces", system.forces});
    all.push_back({"constraints", system.functions.constraints});
    return all;
}

/// Their derivatives in the base coordinates, a row a function.
struct Slopes {
    const char* name;
    std::vector<std::vector<NodeId>> rows;
};

} // namespace

StructureReport cyclic_coordinates(const System& system, const ProofBudget& budget)
{
    if (system.distribution)
        throw MathematicsError(fmt::format("cyclic coordinates of nonholonomic models are not listed yet, and '{}' is "
                                           "one",
                                           system.name));
    Graph graph = system.graph;
    std::vector<Slopes> all;
    for (const Functions& each : functions_of(system))
        all.push_back({each.name, jacobian(graph, each.nodes, system.algebroid.x)});
    Judge judge(graph, proof_setting(graph, system), budget);
    StructureReport report;
    counted("coordinates", system.n(), [&](std::size_t i) {
        const std::string q = graph.input_name(system.algebroid.x[i]);
        Check check{"cyclic", {q}, {}};
        check.decision.status = ProofStatus::proved;
        check.decision.residual = "0";
        for (const Slopes& each : all)
            for (const std::vector<NodeId>& row : each.rows) {
                if (check.decision.status == ProofStatus::refuted || graph.is_zero(row[i])) continue;
                const Decision& decision = judge.decide(row[i]);
                if (decision.status == ProofStatus::proved) continue;
                check.indices = {q, each.name};
                check.decision = decision;
            }
        report.checks.push_back(std::move(check));
    });
    report.verdict = verdict_of(report);
    return report;
}

} // namespace lagen
