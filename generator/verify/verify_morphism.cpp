// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/verify_morphism.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/transplant.hpp"
#include "verify/mapped_systems.hpp"
#include "verify/proof_setting.hpp"
#include "verify/where_constant.hpp"

#include <algorithm>

namespace lagen {

namespace {

class MorphismClaims {
  public:
    MorphismClaims(const SystemMorphism& morphism, const ProofBudget& budget)
        : both_(morphism), morphism_(both_.morphism), from_(both_.from()), to_(both_.to()), graph_(both_.graph),
          budget_(budget), along_(both_.along), matrix_(both_.matrix),
          judge_(std::make_unique<Judge>(graph_, both_.setting(), budget))
    {
    }

    MorphismReport run()
    {
        decide_constraints();
        decide_algebroid();
        if (both_.is_constrained()) {
            CarriedDistribution carried = decide_carried(both_, *judge_);
            reaches_all_ = carried.onto;
            for (Check& check : carried.checks) report_.structure.checks.push_back(std::move(check));
        }
        decide_functions();
        if (morphism_.of_groupoids) decide_arrows();
        find_reach();
        report_.rank = generic_rank(graph_, matrix_, to_.r(), from_.r(), judge_->decider());
        conclude();
        return std::move(report_);
    }

  private:
    void append(const char* name, std::vector<std::string> indices, NodeId residual)
    {
        report_.structure.append(graph_, name, std::move(indices), residual, *judge_);
    }

    void decide_constraints()
    {
        const std::vector<NodeId> moved = along_(to_.functions.constraints);
        for (std::size_t k = 0; k < moved.size(); ++k) append("constraint", {to_.constraints[k].name}, moved[k]);
    }

    void decide_algebroid()
    {
        const ResidualList list = morphism_equations(graph_, morphism_, matrix_);
        report_.structure.trivial += list.trivial;
        for (const Residual& residual : list.residuals) {
            const std::vector<std::size_t>& k = residual.indices;
            std::vector<std::string> indices{both_.section(k[0])};
            if (k.size() == 2) indices.push_back(both_.target_coordinate(k[1]));
            if (k.size() == 3) {
                indices.push_back(both_.section(k[1]));
                indices.push_back(both_.target_section(k[2]));
            }
            append(residual.name.c_str(), std::move(indices), residual.value);
        }
    }

    /// Functions of both sides that the map should carry into each other.
    void decide_functions()
    {
        AlongMap along = along_;
        along.set(to_.algebroid.y, both_.pushed(from_.algebroid.y));
        if (from_.lagrangian && to_.lagrangian)
            append("invariance", {"L"}, graph_.subtract(*from_.lagrangian, along(*to_.lagrangian)));
        decide_forces(along);
        if (from_.hamiltonian && to_.hamiltonian) {
            along.set(to_.mu, both_.target_momenta());
            const Replacements at = replacements(from_.mu, both_.pulled(both_.target_momenta()));
            append("invariance", {"H"},
                   graph_.subtract(substitute(graph_, {&*from_.hamiltonian, 1}, at)[0], along(*to_.hamiltonian)));
        }
        if (from_.control && to_.control) {
            along.set(to_.control->u, morphism_.controls);
            append("invariance", {"cost"}, graph_.subtract(from_.control->cost, along(to_.control->cost)));
            const std::vector<NodeId> here = both_.pushed(from_.control->sigma), there = along(to_.control->sigma);
            for (std::size_t a = 0; a < to_.r(); ++a)
                append("invariance", {"sigma", both_.target_section(a)}, graph_.subtract(here[a], there[a]));
            decide_bounds(along);
        }
    }

    /// Q_b = Phi^a_b Q'_a where both sides have motions of the same form.
    void decide_forces(const AlongMap& along)
    {
        const bool comparable = (from_.lagrangian && to_.lagrangian) || (from_.hamiltonian && to_.hamiltonian);
        report_.compares_motions =
            comparable || (!from_.lagrangian && !from_.hamiltonian) || (!to_.lagrangian && !to_.hamiltonian);
        if (!comparable || (from_.forces.empty() && to_.forces.empty())) return;
        if (!both_.compares_forces())
            return leave_open({"force"}, "forces that depend on first-order states are not compared");
        const std::vector<NodeId> here = from_.forces_or_zero(graph_);
        std::vector<NodeId> there(to_.r(), graph_.constant(0));
        if (!to_.forces.empty()) there = along(to_.forces);
        const std::vector<NodeId> back = both_.pulled(there);
        for (std::size_t b = 0; b < from_.r(); ++b)
            append("invariance", {"force", both_.section(b)}, graph_.subtract(here[b], back[b]));
    }

    /// The bounds of controls that are taken over as they are; others are not compared.
    void decide_bounds(const AlongMap& along)
    {
        const ControlProblem &here = *from_.control, &there = *to_.control;
        if (!here.bounded() && !there.bounded()) return;
        const auto same = [&](const std::optional<NodeId>& mine, const std::optional<NodeId>& theirs) {
            return mine.has_value() == theirs.has_value() &&
                   (!mine || judge_->decide(graph_.subtract(*mine, along(*theirs))).status == ProofStatus::proved);
        };
        std::vector<NodeId> reached = morphism_.controls;
        std::ranges::sort(reached);
        bool all = reached.size() == here.u.size() && std::ranges::adjacent_find(reached) == reached.end();
        for (std::size_t B = 0; all && B < there.u.size(); ++B) {
            const auto A = static_cast<std::size_t>(std::ranges::find(here.u, morphism_.controls[B]) - here.u.begin());
            all = A < here.u.size() && same(here.lower[A], there.lower[B]) && same(here.upper[A], there.upper[B]);
        }
        if (all)
            ++report_.structure.trivial;
        else
            leave_open({"bounds"}, "bounds are compared of controls that are the same on both sides");
    }

    void leave_open(std::vector<std::string> indices, const char* why)
    {
        Decision open;
        open.evidence = why;
        report_.structure.checks.push_back({"invariance", std::move(indices), std::move(open)});
    }

    void find_reach()
    {
        ProofSetting setting = proof_setting(graph_, from_);
        setting.parameters.insert(setting.parameters.end(), morphism_.free_parameters.begin(),
                                  morphism_.free_parameters.end());
        std::vector<NodeId> map = morphism_.base;
        map.insert(map.end(), matrix_.begin(), matrix_.end());
        WhereConstant reach(graph_, setting, budget_, [](NodeId) { return false; });
        const WhereConstant::Conditions found = reach.reaching(map, along_(to_.domain));
        report_.reach = {found.texts, found.obstacle};
    }

    void decide_arrows()
    {
        const Groupoid &from = *from_.groupoid, &to = *to_.groupoid;
        const MappedSystems::Arrows pair = both_.arrows();
        const Arrow &g = pair.g, &h = pair.h;
        ArrowDecider decider = both_.arrow_decider(pair, budget_);
        const auto entry = [&](std::size_t k) {
            return std::vector{std::to_string(k / to.size + 1), std::to_string(k % to.size + 1)};
        };
        const auto equate = [&](const char* name, std::vector<std::string> indices, NodeId a, NodeId b) {
            report_.structure.append(graph_, name, std::move(indices), graph_.subtract(a, b), decider);
        };

        const Arrow image = image_of(graph_, morphism_, g);
        AlongMap along = along_;
        along.set(to.arrow.next, image.next);
        along.set(to.arrow.W, image.W);
        if (!to.action.empty()) {
            const std::vector<NodeId> found = along(to.action);
            const std::vector<NodeId> wanted = substitute(graph_, morphism_.base, replacements(from_.algebroid.x, h.x));
            for (std::size_t i = 0; i < found.size(); ++i)
                equate("target", {both_.target_coordinate(i)}, found[i], wanted[i]);
        }
        const std::vector<NodeId> both = at(graph_, from, morphism_.element, product(graph_, from, g, h));
        const std::vector<NodeId> each =
            matrix_product(graph_, image.W, at(graph_, from, morphism_.element, h), to.size);
        for (std::size_t k = 0; k < both.size(); ++k) equate("product", entry(k), both[k], each[k]);
        const std::vector<NodeId> unit = at(graph_, from, morphism_.element, identity(graph_, from, g.x));
        const std::vector<NodeId> one = matrix_one(graph_, to.size);
        for (std::size_t k = 0; k < unit.size(); ++k) equate("unit", entry(k), unit[k], one[k]);
        for (const NodeId value : both_.derived->outside) equate("element", {}, value, graph_.constant(0));
        if (!both_.given.empty())
            for (std::size_t a = 0; a < to_.r(); ++a)
                for (std::size_t b = 0; b < from_.r(); ++b)
                    equate("fibre", {both_.target_section(a), both_.section(b)}, both_.given[a * from_.r() + b],
                           both_.derived->matrix[a * from_.r() + b]);
        if (from_.discrete && to_.discrete) decide_discrete(along, equate);
    }

    template <class Equate>
    void decide_discrete(AlongMap along, const Equate& equate)
    {
        const DiscreteSystem &here = *from_.discrete, &there = *to_.discrete;
        const bool whole = here.lagrangian && there.lagrangian && here.inner.empty() && there.inner.empty();
        if (!whole)
            return leave_open({"discrete L"},
                              "a discrete Lagrangian with unknowns inside of a step, or none, is not compared");
        if (!morphism_.parameters.contains(there.step)) along.set({&there.step, 1}, {&here.step, 1});
        equate("invariance", {"discrete L"}, *here.lagrangian, along(*there.lagrangian));
    }

    void conclude()
    {
        StructureReport& structure = report_.structure;
        structure.verdict = verdict_of(structure);
        if (structure.verdict != Verdict::valid) return;
        const bool both = from_.lagrangian && to_.lagrangian;
        const bool on_duals =
            !both && !both_.is_constrained() &&
            ((from_.hamiltonian && to_.hamiltonian) || (from_.control && to_.control && is_submersive()));
        const bool everywhere = report_.rank.surjective && report_.rank.where.empty(); // at every point
        const bool surjective = both_.is_constrained() ? reaches_all_ : everywhere;
        report_.theorems.reduction = (both || on_duals) && surjective;
        report_.theorems.reconstruction = (both || on_duals) && everywhere && report_.rank.injective;
        report_.theorems.of_pulled_momenta = on_duals && !report_.theorems.reconstruction;
        report_.theorems.discrete = morphism_.of_groupoids && from_.discrete && to_.discrete && surjective;
    }

    /// True where psi reaches all rates of the target's controls, so that dH'/du' vanishes where dH/du does.
    [[nodiscard]] bool is_submersive()
    {
        const std::vector<NodeId>& u = from_.control->u;
        std::vector<NodeId> slopes;
        for (const std::vector<NodeId>& row : jacobian(graph_, morphism_.controls, u))
            slopes.insert(slopes.end(), row.begin(), row.end());
        const GenericRank rank = generic_rank(graph_, slopes, morphism_.controls.size(), u.size(), judge_->decider());
        return rank.surjective && rank.where.empty();
    }

    MappedSystems both_;
    const SystemMorphism& morphism_;
    const System &from_, &to_;
    Graph& graph_;
    ProofBudget budget_;
    const AlongMap& along_;
    const std::vector<NodeId>& matrix_;
    std::unique_ptr<Judge> judge_;
    bool reaches_all_ = false; ///< Phi(D) = D' at every point
    MorphismReport report_;
};

} // namespace

Verdict worse(Verdict a, Verdict b)
{
    for (const Verdict verdict : {Verdict::invalid, Verdict::undecided})
        if (a == verdict || b == verdict) return verdict;
    return Verdict::valid;
}

MorphismReport verify(const SystemMorphism& morphism, const ProofBudget& budget)
{
    return MorphismClaims(morphism, budget).run();
}

void append_equality(StructureReport& structure, const SystemMorphism& morphism, const SystemMorphism& other,
                     const ProofBudget& budget)
{
    MappedSystems both(morphism);
    Judge judge(both.graph, both.setting(), budget);
    const auto compare = [&](const std::vector<NodeId>& mine, const std::vector<NodeId>& theirs, const auto& name_of) {
        if (mine.size() != theirs.size()) return;
        const std::vector<NodeId> moved = transplant(both.graph, other.source.graph, theirs, {});
        for (std::size_t k = 0; k < mine.size(); ++k)
            structure.append(both.graph, "equals", {name_of(k)}, both.graph.subtract(mine[k], moved[k]), judge);
    };
    const System& to = both.to();
    const auto names_of = [&](const std::vector<NodeId>& inputs) {
        return [&](std::size_t k) { return to.graph.input_name(inputs[k]); };
    };
    compare(morphism.base, other.base, names_of(to.algebroid.x));
    compare(morphism.fibre, other.fibre, names_of(to.algebroid.y));
    if (to.control) compare(morphism.controls, other.controls, names_of(to.control->u));
    if (to.groupoid) compare(morphism.element, other.element, names_of(to.groupoid->arrow.W));
    std::vector<NodeId> mine, theirs;
    std::vector<NodeId> asked;
    for (const NodeId parameter : to.parameters) {
        const auto here = morphism.parameters.find(parameter), there = other.parameters.find(parameter);
        if (here == morphism.parameters.end() || there == other.parameters.end()) continue;
        asked.push_back(parameter);
        mine.push_back(here->second);
        theirs.push_back(there->second);
    }
    compare(mine, theirs, names_of(asked));
    structure.verdict = verdict_of(structure);
}

} // namespace lagen
