// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/verify_morphism.hpp"

#include "graph/calculus/differentiate.hpp"
#include "verify/arrow_decider.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {

namespace {

class MorphismClaims {
  public:
    MorphismClaims(const SystemMorphism& morphism, std::size_t points, const ProofBudget& budget)
        : morphism_(morphism), from_(morphism.source), to_(morphism.target), graph_(from_.graph), budget_(budget),
          along_(graph_, morphism)
    {
        if (morphism.of_groupoids) derived_ = derived_fibre(graph_, morphism);
        given_ = fibre_matrix(graph_, morphism);
        matrix_ = morphism.fibre.empty() && derived_ ? derived_->matrix : given_;
        judge_ = std::make_unique<Judge>(graph_, setting(), accessory_inputs(from_), points, budget);
    }

    MorphismReport run()
    {
        decide_constraints();
        decide_algebroid();
        decide_functions();
        if (morphism_.of_groupoids) decide_arrows();
        report_.rank = fibre_rank(graph_, matrix_, to_.r(), from_.r(), judge_->decider());
        conclude();
        return std::move(report_);
    }

  private:
    /// Points of the source which the map takes into the domain of the target.
    [[nodiscard]] ProofSetting setting()
    {
        ProofSetting setting = proof_setting(from_);
        const auto append = [](std::vector<NodeId>& list, const std::vector<NodeId>& more) {
            list.insert(list.end(), more.begin(), more.end());
        };
        append(setting.parameters, morphism_.free_parameters);
        append(setting.domain, along_(to_.domain));
        append(setting.defined, morphism_.base);
        append(setting.defined, matrix_);
        if (from_.hamiltonian && to_.hamiltonian) append(setting.variables, target_momenta());
        std::erase_if(setting.defined, [&](NodeId node) { return graph_.is_constant(node); });
        std::erase_if(setting.domain, [&](NodeId node) { return graph_.is_constant(node); });
        return setting;
    }

    /// mu' as inputs of their own.
    [[nodiscard]] const std::vector<NodeId>& target_momenta()
    {
        if (momenta_.empty())
            for (const NodeId mu : to_.mu) momenta_.push_back(graph_.input(to_.graph.input_name(mu) + "'"));
        return momenta_;
    }

    [[nodiscard]] std::string section(std::size_t b) const { return from_.graph.input_name(from_.algebroid.y[b]); }
    [[nodiscard]] std::string target_section(std::size_t a) const { return to_.graph.input_name(to_.algebroid.y[a]); }
    [[nodiscard]] std::string target_coordinate(std::size_t i) const
    {
        return to_.graph.input_name(to_.algebroid.x[i]);
    }

    void append(const char* name, std::vector<std::string> indices, NodeId residual)
    {
        if (graph_.is_zero(residual)) {
            ++report_.structure.trivial;
            return;
        }
        report_.structure.checks.push_back(
            {name, std::move(indices), judge_->decide(residual), {}, judge_->reevaluate(residual)});
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
            std::vector<std::string> indices{section(k[0])};
            if (k.size() == 2) indices.push_back(target_coordinate(k[1]));
            if (k.size() == 3) {
                indices.push_back(section(k[1]));
                indices.push_back(target_section(k[2]));
            }
            append(residual.name.c_str(), std::move(indices), residual.value);
        }
    }

    /// Phi^a_b w_a or Phi^a_b w^b.
    [[nodiscard]] std::vector<NodeId> pulled(const std::vector<NodeId>& covector)
    {
        std::vector<NodeId> out(from_.r(), graph_.constant(0));
        for (std::size_t a = 0; a < to_.r(); ++a)
            for (std::size_t b = 0; b < from_.r(); ++b)
                out[b] = graph_.add(out[b], graph_.multiply(matrix_[a * from_.r() + b], covector[a]));
        return out;
    }
    [[nodiscard]] std::vector<NodeId> pushed(const std::vector<NodeId>& vector)
    {
        std::vector<NodeId> out(to_.r(), graph_.constant(0));
        for (std::size_t a = 0; a < to_.r(); ++a)
            for (std::size_t b = 0; b < from_.r(); ++b)
                out[a] = graph_.add(out[a], graph_.multiply(matrix_[a * from_.r() + b], vector[b]));
        return out;
    }

    /// Functions of both sides that the map should carry into each other.
    void decide_functions()
    {
        AlongMap along = along_;
        along.set(to_.algebroid.y, pushed(from_.algebroid.y));
        if (from_.lagrangian && to_.lagrangian)
            append("invariance", {"L"}, graph_.subtract(*from_.lagrangian, along(*to_.lagrangian)));
        if (from_.lagrangian && to_.lagrangian && (!from_.forces.empty() || !to_.forces.empty())) {
            const std::vector<NodeId> here = from_.forces_or_zero(graph_);
            std::vector<NodeId> there(to_.r(), graph_.constant(0));
            if (!to_.forces.empty()) there = along(to_.forces);
            const std::vector<NodeId> back = pulled(there);
            for (std::size_t b = 0; b < from_.r(); ++b)
                append("invariance", {"force", section(b)}, graph_.subtract(here[b], back[b]));
        }
        if (from_.hamiltonian && to_.hamiltonian) {
            along.set(to_.mu, target_momenta());
            const Replacements at = replacements(from_.mu, pulled(target_momenta()));
            append("invariance", {"H"},
                   graph_.subtract(substitute(graph_, {&*from_.hamiltonian, 1}, at)[0], along(*to_.hamiltonian)));
        }
        if (from_.control && to_.control) {
            along.set(to_.control->u, morphism_.controls);
            append("invariance", {"cost"}, graph_.subtract(from_.control->cost, along(to_.control->cost)));
            const std::vector<NodeId> here = pushed(from_.control->sigma), there = along(to_.control->sigma);
            for (std::size_t a = 0; a < to_.r(); ++a)
                append("invariance", {"sigma", target_section(a)}, graph_.subtract(here[a], there[a]));
        }
    }

    void decide_arrows()
    {
        const Groupoid &from = *from_.groupoid, &to = *to_.groupoid;
        const Arrow& g = from.arrow;
        const Arrow h{target(graph_, from, g), primed(graph_, g.next), primed(graph_, g.W)}; // s(h) = t(g)
        std::vector<std::vector<NodeId>> points{g.x};
        for (const auto* more : {&g.next, &h.next})
            if (!more->empty()) points.push_back(*more);
        ProofSetting setting = arrow_setting(graph_, from_, points);
        setting.parameters.insert(setting.parameters.end(), morphism_.free_parameters.begin(),
                                  morphism_.free_parameters.end());
        if (from_.discrete) append_step(setting, from_);
        setting.variables.push_back(from_.time);
        std::vector<std::vector<NodeId>> elements;
        if (!g.W.empty()) elements = {g.W, h.W};
        ArrowDecider decider(graph_, std::move(setting), from, std::move(elements), budget_);
        const auto entry = [&](std::size_t k) {
            return std::vector{std::to_string(k / to.size + 1), std::to_string(k % to.size + 1)};
        };
        const auto equate = [&](const char* name, std::vector<std::string> indices, NodeId a, NodeId b) {
            const NodeId residual = graph_.subtract(a, b);
            if (graph_.is_zero(residual))
                ++report_.structure.trivial;
            else
                report_.structure.checks.push_back({name, std::move(indices), decider.decide(residual), {}, {}});
        };

        const Arrow image = image_of(graph_, morphism_, g);
        AlongMap along = along_;
        along.set(to.arrow.next, image.next);
        along.set(to.arrow.W, image.W);
        if (!to.action.empty()) {
            const std::vector<NodeId> found = along(to.action);
            const std::vector<NodeId> wanted = substitute(graph_, morphism_.base, replacements(from_.algebroid.x, h.x));
            for (std::size_t i = 0; i < found.size(); ++i)
                equate("target", {target_coordinate(i)}, found[i], wanted[i]);
        }
        const std::vector<NodeId> both = at(graph_, from, morphism_.element, product(graph_, from, g, h));
        const std::vector<NodeId> each =
            matrix_product(graph_, image.W, at(graph_, from, morphism_.element, h), to.size);
        for (std::size_t k = 0; k < both.size(); ++k) equate("product", entry(k), both[k], each[k]);
        const std::vector<NodeId> unit = at(graph_, from, morphism_.element, identity(graph_, from, g.x));
        const std::vector<NodeId> one = matrix_one(graph_, to.size);
        for (std::size_t k = 0; k < unit.size(); ++k) equate("unit", entry(k), unit[k], one[k]);
        for (const NodeId value : derived_->outside) equate("element", {}, value, graph_.constant(0));
        if (!given_.empty())
            for (std::size_t a = 0; a < to_.r(); ++a)
                for (std::size_t b = 0; b < from_.r(); ++b)
                    equate("fibre", {target_section(a), section(b)}, given_[a * from_.r() + b],
                           derived_->matrix[a * from_.r() + b]);
        if (from_.discrete && to_.discrete) decide_discrete(along, equate);
    }

    template <class Equate>
    void decide_discrete(AlongMap along, const Equate& equate)
    {
        const DiscreteSystem &here = *from_.discrete, &there = *to_.discrete;
        const bool whole = here.lagrangian && there.lagrangian && here.inner.empty() && there.inner.empty();
        if (!whole) {
            Decision open;
            open.evidence = "a discrete Lagrangian with unknowns inside of a step, or none, is not compared";
            report_.structure.checks.push_back({"invariance", {"discrete L"}, open, {}, {}});
            return;
        }
        if (!morphism_.parameters.contains(there.step)) along.set({&there.step, 1}, {&here.step, 1});
        equate("invariance", {"discrete L"}, *here.lagrangian, along(*there.lagrangian));
    }

    void conclude()
    {
        StructureReport& structure = report_.structure;
        for (const Check& check : structure.checks) require_confirmed(check);
        structure.verdict = verdict_of(structure);
        if (structure.verdict != Verdict::valid) return;
        const bool both = from_.lagrangian && to_.lagrangian;
        const bool surjective = report_.rank.surjective && report_.rank.where.empty(); // at every point
        report_.theorems.reduction = both && surjective;
        report_.theorems.reconstruction = both && surjective && report_.rank.injective;
        report_.theorems.discrete = morphism_.of_groupoids && from_.discrete && to_.discrete && surjective;
    }

    const SystemMorphism& morphism_;
    const System &from_, &to_;
    Graph graph_; ///< the source's, and what is derived here
    ProofBudget budget_;
    AlongMap along_;
    std::optional<DerivedFibre> derived_;
    std::vector<NodeId> given_, matrix_, momenta_;
    std::unique_ptr<Judge> judge_;
    MorphismReport report_;
};

} // namespace

Verdict worse(Verdict a, Verdict b)
{
    for (const Verdict verdict : {Verdict::invalid, Verdict::undecided})
        if (a == verdict || b == verdict) return verdict;
    return Verdict::valid;
}

MorphismReport verify(const SystemMorphism& morphism, std::size_t points, const ProofBudget& budget)
{
    return MorphismClaims(morphism, points, budget).run();
}

} // namespace lagen
