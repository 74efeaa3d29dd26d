// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/mapped_systems.hpp"

#include "graph/calculus/differentiate.hpp"
#include "proof/rank.hpp"
#include "verify/distribution_rows.hpp"
#include "verify/proof_setting.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

MappedSystems::MappedSystems(const SystemMorphism& of) : morphism(of), graph(of.source.graph), along(graph, morphism)
{
    if (morphism.of_groupoids) derived = derived_fibre(graph, morphism);
    given = fibre_matrix(graph, morphism);
    matrix = morphism.fibre.empty() && derived ? derived->matrix : given;
    moving = velocity_map(graph, morphism, matrix);
}

bool MappedSystems::compares_forces() const
{
    const auto carries_states = [](const System& system) {
        return !system.forces.empty() && !system.states.empty() &&
               depends_on_any(system.graph, system.forces, system.states);
    };
    return !carries_states(from()) && !carries_states(to());
}

std::vector<NodeId> MappedSystems::pulled(const std::vector<NodeId>& covector)
{
    return pulled_covector(graph, matrix, from().r(), covector);
}

std::vector<NodeId> MappedSystems::pushed(const std::vector<NodeId>& vector)
{
    return applied(graph, matrix, to().r(), vector);
}

const std::vector<NodeId>& MappedSystems::target_momenta()
{
    if (momenta_.empty())
        for (const NodeId mu : to().mu) momenta_.push_back(graph.input(to().graph.input_name(mu) + "'"));
    return momenta_;
}

ProofSetting MappedSystems::setting()
{
    ProofSetting setting = proof_setting(graph, from());
    const auto append = [](std::vector<NodeId>& list, const std::vector<NodeId>& more) {
        list.insert(list.end(), more.begin(), more.end());
    };
    append(setting.parameters, morphism.free_parameters);
    append(setting.domain, along(to().domain));
    append(setting.defined, morphism.base);
    append(setting.defined, matrix);
    append(setting.defined, moving.basis);
    if (from().distribution)
        for (const NodeId Y : from().algebroid.y)
            if (std::ranges::find(setting.variables, Y) == setting.variables.end()) setting.variables.push_back(Y);
    if (from().hamiltonian && to().hamiltonian) append(setting.variables, target_momenta());
    std::erase_if(setting.defined, [&](NodeId node) { return graph.is_constant(node); });
    std::erase_if(setting.domain, [&](NodeId node) { return graph.is_constant(node); });
    return setting;
}

MappedSystems::Arrows MappedSystems::arrows()
{
    const Groupoid& groupoid = *from().groupoid;
    const Arrow& g = groupoid.arrow;
    return {g, {target(graph, groupoid, g), primed(graph, g.next), primed(graph, g.W)}};
}

ArrowDecider MappedSystems::arrow_decider(const Arrows& pair, const ProofBudget& budget)
{
    std::vector<std::vector<NodeId>> points{pair.g.x};
    for (const Arrow* arrow : {&pair.g, &pair.h})
        if (!arrow->next.empty()) points.push_back(arrow->next);
    ProofSetting setting = arrow_setting(graph, from(), points);
    setting.parameters.insert(setting.parameters.end(), morphism.free_parameters.begin(),
                              morphism.free_parameters.end());
    if (from().discrete) append_step(setting, from());
    setting.variables.push_back(from().time);
    std::vector<std::vector<NodeId>> elements;
    if (!pair.g.W.empty()) elements = {pair.g.W, pair.h.W};
    return ArrowDecider(graph, std::move(setting), *from().groupoid, std::move(elements), budget);
}

namespace {

/// Are the sections of D' independent along phi? Least squares, and the rank of Phi on D, tell nothing where they are
/// not.
bool is_independent(MappedSystems& both, Judge& judge)
{
    if (both.moving.basis.empty()) return true;
    std::vector<std::string> names;
    for (std::size_t beta = 0; beta < both.to().velocities().size(); ++beta)
        names.push_back(both.target_velocity(beta));
    const Check check = independence(both.graph, both.moving.basis, std::move(names), judge);
    return check.decision.status == ProofStatus::proved && check.where.empty();
}

Check decide_onto(MappedSystems& both, Judge& judge)
{
    Check onto{"constraint", {"Phi(D)"}, {}};
    if (!is_independent(both, judge)) {
        onto.decision.evidence =
            "the sections of the target are not shown to be independent at every point of the image";
        return onto;
    }
    const std::size_t wanted = both.to().velocities().size();
    const GenericRank rank =
        generic_rank(both.graph, both.moving.matrix, wanted, both.from().velocities().size(), judge.decider());
    if (rank.surjective && rank.where.empty()) {
        onto.decision = judge.decide(both.graph.constant(0));
    } else if (rank.rank && *rank.rank < wanted) {
        onto.decision.status = ProofStatus::refuted;
        onto.decision.residual = std::to_string(wanted - *rank.rank);
        onto.decision.evidence = fmt::format("Phi(D) has the rank {}, and D' has {}", *rank.rank, wanted);
    } else {
        onto.decision.evidence = "the rank of Phi on D is not decided at every point";
    }
    return onto;
}

} // namespace

CarriedDistribution decide_carried(MappedSystems& both, Judge& judge)
{
    CarriedDistribution carried;
    const std::vector<std::vector<NodeId>>& outside = both.moving.outside;
    for (std::size_t alpha = 0; alpha < outside.size(); ++alpha)
        for (std::size_t a = 0; a < outside[alpha].size(); ++a) {
            const NodeId residual = outside[alpha][a];
            if (both.graph.is_zero(residual)) continue;
            const std::string of = alpha + 1 < outside.size() ? both.velocity(alpha) : "drift";
            carried.checks.push_back(
                {"constraint", {"Phi(" + of + ")", both.target_section(a)}, judge.decide(residual)});
        }
    carried.checks.push_back(decide_onto(both, judge));
    carried.onto = carried.checks.back().decision.status == ProofStatus::proved;
    return carried;
}

} // namespace lagen
