// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/verify_reduction.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/discrete.hpp"
#include "mechanics/hamilton.hpp"
#include "mechanics/pontryagin.hpp"
#include "mechanics/variations.hpp"
#include "proof/rank.hpp"
#include "text/activity.hpp"
#include "verify/mapped_systems.hpp"

#include <algorithm>
#include <set>

namespace lagen {

namespace {

/// W ydot = f along xdot.
struct Accelerations {
    std::vector<NodeId> W, f, xdot;
    FibreHessian hessian; ///< W with its blocks
};

Accelerations accelerations(Graph& graph, const System& system)
{
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    LagrangeRates rates = lagrange_rates(graph, system, lagrangian, lagrange_balance(graph, system, lagrangian));
    return {lagrangian.fibre.hessian, std::move(rates.force), std::move(rates.xdot), lagrangian.fibre};
}

class Reduction {
  public:
    Reduction(const SystemMorphism& morphism, const ProofBudget& budget)
        : both_(morphism), graph_(both_.graph), from_(both_.from()), to_(both_.morphism.target), budget_(budget)
    {
        ProofSetting setting = both_.setting();
        if (from_.control && to_.control)
            setting.variables.insert(setting.variables.end(), both_.target_momenta().begin(),
                                     both_.target_momenta().end());
        std::set<std::string> taken;
        for (const NodeId free : both_.morphism.free_parameters) taken.insert(graph_.input_name(free));
        for (const auto& [letter, list] : {std::pair{"σ_", &s_}, std::pair{"σ̇_", &sdot_}})
            for (std::size_t b = 0; b < from_.r(); ++b) {
                std::string name = letter + both_.section(b);
                while (from_.declares(name) || to_.declares(name) || taken.contains(name)) name += "'";
                list->push_back(graph_.input(name));
                setting.variables.push_back(list->back());
            }
        judge_ = std::make_unique<Judge>(graph_, std::move(setting), budget);
    }

    ReductionReport run()
    {
        if (both_.is_constrained()) report_.checks = decide_carried(both_, *judge_).checks;
        const std::size_t before = report_.checks.size();
        if (from_.lagrangian && to_.lagrangian) decide_lagrange();
        if (from_.hamiltonian && to_.hamiltonian) decide_hamilton();
        if (from_.control && to_.control) decide_pontryagin();
        if (both_.morphism.of_groupoids && from_.discrete && to_.discrete) decide_discrete();
        if (report_.checks.size() == before)
            report_.note = "the two models have no form of the equations of motion in common";
        report_.verdict = verdict_of(report_);
        return {std::move(report_), std::move(paths_)};
    }

  private:
    void append(const char* form, std::string component, Decision decision)
    {
        report_.checks.push_back({"projects", {form, std::move(component)}, std::move(decision)});
    }
    void decide(const char* form, std::string component, NodeId residual)
    {
        append(form, std::move(component), judge_->decide(residual));
    }
    /// What is not compared, by name.
    void leave_open(const char* form, const char* why, std::string component = "all")
    {
        Decision open;
        open.evidence = why;
        append(form, std::move(component), std::move(open));
    }

    /// xdot'^i of the target at y' against d phi^i along xdot.
    void decide_base(const char* form, const AlongMap& along, const std::vector<NodeId>& xdot,
                     const std::vector<NodeId>& target_xdot)
    {
        const std::vector<NodeId> rates =
            directional(graph_, both_.morphism.base, replacements(from_.algebroid.x, xdot));
        const std::vector<NodeId> wanted = along(target_xdot);
        counted(std::string("base coordinates, ") + form, rates.size(),
                [&](std::size_t i) { decide(form, both_.target_coordinate(i), graph_.subtract(rates[i], wanted[i])); });
    }

    void decide_lagrange()
    {
        const char* form = "lagrange";
        if (!both_.is_constrained()) decide_variations();
        if (!both_.compares_forces())
            return leave_open(form, "forces that depend on first-order states are not compared");
        const std::vector<NodeId>& image = both_.moving.velocities;
        AlongMap along = both_.along;
        along.set(to_.velocities(), image);
        const Accelerations here = accelerations(graph_, from_), of_target = accelerations(to_.graph, to_);
        decide_base(form, along, here.xdot, of_target.xdot);
        const Accelerations there{along(of_target.W), along(of_target.f), {}, {}};
        Replacements motion = replacements(from_.algebroid.x, here.xdot);
        motion.emplace_back(from_.time, graph_.constant(1));
        const std::vector<NodeId> drift = directional(graph_, image, motion); // d/dt y' at fixed y
        std::vector<NodeId> rest = applied(graph_, there.W, drift.size(), drift);
        for (std::size_t a = 0; a < rest.size(); ++a) rest[a] = graph_.subtract(rest[a], there.f[a]);
        const std::size_t k = to_.velocities().size();
        const auto is_injective = [&] { // Phi^*, at every point
            const GenericRank rank =
                generic_rank(graph_, both_.moving.matrix, k, from_.velocities().size(), judge_->decider());
            return rank.surjective && rank.where.empty();
        };
        if (decide_lifts(here, there, rest) && is_injective()) {
            Decision proved;
            proved.status = ProofStatus::proved;
            proved.residual = "0";
            proved.evidence = "W = Phi^* W' Phi, f = Phi^* (f' - W' dPhi/dt y), and Phi^* is injective";
            for (std::size_t a = 0; a < k; ++a) append(form, both_.target_velocity(a), proved);
            return;
        }
        const std::vector<NodeId> ydot = graph_.solve(here.W, here.f, MatrixStructure::symmetric);
        const std::vector<NodeId> moved = applied(graph_, there.W, k, applied(graph_, both_.moving.matrix, k, ydot));
        const bool known = !is_singular(here.hessian);
        counted("accelerations", k, [&](std::size_t a) {
            if (known || graph_.is_zero(moved[a]))
                decide(form, both_.target_velocity(a), graph_.add(moved[a], rest[a]));
            else
                leave_open(form, "L of the source is degenerate: its equations do not determine the accelerations",
                           both_.target_velocity(a));
        });
    }

    /// True where W is proved to be singular everywhere, by one of its blocks.
    bool is_singular(const FibreHessian& hessian)
    {
        return std::ranges::any_of(hessian.blocks, [&](const std::vector<std::size_t>& block) {
            return block.size() <= determinant_limit &&
                   judge_->decider().status(block_determinant(graph_, hessian, block)) == ProofStatus::proved;
        });
    }

    /// True where Phi^* of the target's equations, W' Phi ydot + rest = 0, are the source's, W ydot = f, by sections of
    /// the source: nothing is divided by.
    bool decide_lifts(const Accelerations& here, const Accelerations& there, const std::vector<NodeId>& rest)
    {
        const std::size_t r = from_.velocities().size();
        const std::vector<NodeId>& Phi = both_.moving.matrix;
        const auto pulled = [&](const std::vector<NodeId>& f) { return pulled_covector(graph_, Phi, r, f); };
        std::vector<std::vector<NodeId>> residuals(r);
        const std::vector<NodeId> back = pulled(rest);
        for (std::size_t c = 0; c < r; ++c) residuals[c].push_back(graph_.add(back[c], here.f[c]));
        for (std::size_t d = 0; d < r; ++d) {
            std::vector<NodeId> column; // Phi e_d
            for (std::size_t a = 0; a < to_.velocities().size(); ++a) column.push_back(Phi[a * r + d]);
            const std::vector<NodeId> moved = pulled(applied(graph_, there.W, column.size(), column));
            for (std::size_t c = 0; c < r; ++c) residuals[c].push_back(graph_.subtract(moved[c], here.W[c * r + d]));
        }
        bool all = true;
        counted("lifts", r, [&](std::size_t c) {
            Decision decision = judge_->decide(graph_.constant(0));
            for (const NodeId residual : residuals[c])
                if (decision.status == ProofStatus::proved && !graph_.is_zero(residual))
                    decision = judge_->decide(residual);
            all = all && decision.status == ProofStatus::proved;
            paths_.push_back({"paths", {"lifts", both_.velocity(c)}, std::move(decision)});
        });
        return all;
    }

    /// delta_s of E-paths goes to delta_s' of their images, s' = Phi s.
    void decide_variations()
    {
        const std::vector<NodeId>& y = from_.algebroid.y;
        const Variation delta = variation(graph_, from_.algebroid, s_, sdot_);
        const std::vector<NodeId> pushed = both_.pushed(s_);
        Replacements motion = replacements(from_.algebroid.x, base_velocity(graph_, from_.algebroid, y));
        const Replacements more = replacements(s_, sdot_);
        motion.insert(motion.end(), more.begin(), more.end());
        std::vector<NodeId> t, tdot; // of the target, for sections and their rates
        for (std::size_t a = 0; a < to_.r(); ++a) t.push_back(to_.graph.input("σ_ " + both_.target_section(a)));
        for (std::size_t a = 0; a < to_.r(); ++a) tdot.push_back(to_.graph.input("σ̇_ " + both_.target_section(a)));
        const Variation target = variation(to_.graph, to_.algebroid, t, tdot);
        AlongMap along = both_.along;
        along.set(to_.algebroid.y, both_.pushed(y));
        along.set(t, pushed);
        along.set(tdot, directional(graph_, pushed, motion));
        const auto compare = [&](const std::vector<NodeId>& moved, const std::vector<NodeId>& wanted, auto name_of) {
            counted("variations", moved.size(), [&](std::size_t k) {
                Decision decision = judge_->decide(graph_.subtract(moved[k], wanted[k]));
                paths_.push_back({"paths", {"variations", name_of(k)}, std::move(decision)});
            });
        };
        compare(varied(graph_, from_.algebroid, delta, both_.morphism.base), along(target.x),
                [&](std::size_t i) { return both_.target_coordinate(i); });
        compare(varied(graph_, from_.algebroid, delta, both_.pushed(y)), along(target.y),
                [&](std::size_t a) { return both_.target_section(a); });
    }

    void decide_hamilton()
    {
        const char* form = "hamilton";
        if (!both_.compares_forces())
            return leave_open(form, "forces that depend on first-order states are not compared");
        const PhaseSystem here = hamilton_system(graph_, from_, given_hamiltonian(graph_, from_));
        const PhaseSystem there = hamilton_system(to_.graph, to_, given_hamiltonian(to_.graph, to_));
        AlongMap along = both_.along;
        along.set(to_.mu, both_.target_momenta());
        decide_momenta(form, along, at_pulled(here.xdot), at_pulled(here.mudot), there, {});
    }

    /// At mu = Phi^* mu'.
    [[nodiscard]] std::vector<NodeId> at_pulled(const std::vector<NodeId>& nodes)
    {
        return substitute(graph_, nodes, replacements(from_.mu, both_.pulled(both_.target_momenta())));
    }

    /// `extra`: what vanishes along the motions of the target, one a section; empty: nothing.
    void decide_momenta(const char* form, const AlongMap& along, const std::vector<NodeId>& xdot,
                        const std::vector<NodeId>& mudot, const PhaseSystem& there, const std::vector<NodeId>& extra)
    {
        decide_base(form, along, xdot, there.xdot);
        const std::vector<NodeId> drift =
            directional(graph_, both_.pulled(both_.target_momenta()), replacements(from_.algebroid.x, xdot));
        const std::vector<NodeId> moved = both_.pulled(along(there.mudot));
        counted(std::string("momenta, ") + form, from_.r(), [&](std::size_t b) {
            NodeId residual = graph_.subtract(graph_.add(drift[b], moved[b]), mudot[b]);
            if (!extra.empty()) residual = graph_.subtract(residual, extra[b]);
            decide(form, graph_.input_name(from_.mu[b]), residual);
        });
    }

    /// mudot_b has the term -rho_b(psi^B) dH'/du'^B more than the target's: it vanishes where the controls are chosen.
    void decide_pontryagin()
    {
        const char* form = "pontryagin";
        if (from_.control->bounded() || to_.control->bounded())
            return leave_open(form, "bounded controls are not compared");
        const ControlHamiltonian H = control_hamiltonian(graph_, *from_.control, from_.mu);
        const ControlHamiltonian target_H = control_hamiltonian(to_.graph, *to_.control, to_.mu);
        const PhaseSystem here = pontryagin_system(graph_, from_, H.value, {});
        const PhaseSystem there = pontryagin_system(to_.graph, to_, target_H.value, {});
        AlongMap along = both_.along;
        along.set(to_.mu, both_.target_momenta());
        along.set(to_.control->u, both_.morphism.controls);
        const std::vector<NodeId> slopes = along(target_H.dH_du);
        BaseGradient partial(graph_, from_.algebroid.x);
        std::vector<NodeId> extra(from_.r(), graph_.constant(0));
        for (std::size_t b = 0; b < from_.r(); ++b)
            for (std::size_t B = 0; B < slopes.size(); ++B) {
                const NodeId rate = partial.along(from_.algebroid.anchor[b], both_.morphism.controls[B]);
                extra[b] = graph_.add(extra[b], graph_.multiply(slopes[B], rate));
            }
        const std::vector<NodeId> sections = both_.pushed(from_.control->sigma), image = along(to_.control->sigma);
        for (std::size_t a = 0; a < to_.r(); ++a)
            decide(form, both_.target_section(a), graph_.subtract(sections[a], image[a]));
        decide_momenta(form, along, at_pulled(here.xdot), at_pulled(here.mudot), there, extra);
        const std::vector<NodeId> wanted = at_pulled(H.dH_du);
        counted("controls", wanted.size(), [&](std::size_t A) {
            const NodeId u = from_.control->u[A];
            const std::vector<NodeId> rates =
                directional(graph_, both_.morphism.controls, std::vector{std::pair{u, graph_.constant(1)}});
            decide(form, graph_.input_name(u), graph_.subtract(wanted[A], contraction(graph_, slopes, rates)));
        });
    }

    void decide_discrete()
    {
        const char* form = "discrete";
        const DiscreteSystem &here = *from_.discrete, &there = *to_.discrete;
        if (!here.lagrangian || !there.lagrangian || !here.inner.empty() || !there.inner.empty())
            return leave_open(form, "a discrete Lagrangian with unknowns inside of a step, or none, is not compared");
        if (!here.work.source.empty() || !there.work.source.empty())
            return leave_open(form, "the work of forces in a step is not compared");
        const Groupoid &groupoid = *from_.groupoid, &target_groupoid = *to_.groupoid;
        const MappedSystems::Arrows pair = both_.arrows();
        const std::vector<NodeId> DEL = discrete_euler_lagrange(
            graph_, groupoid, discrete_legendre(graph_, groupoid, *here.lagrangian), pair.g, pair.h);
        const DiscreteLegendre legendre = discrete_legendre(to_.graph, target_groupoid, *there.lagrangian);
        const std::vector<NodeId> plus = at_image(legendre.plus, pair.g), minus = at_image(legendre.minus, pair.h);
        const std::vector<NodeId> matrix =
            substitute(graph_, both_.matrix, replacements(from_.algebroid.x, pair.h.x)); // at t(g) = s(h)
        ArrowDecider decider = both_.arrow_decider(pair, budget_);
        const std::size_t r = from_.r();
        counted("steps", r, [&](std::size_t b) {
            NodeId residual = DEL[b];
            for (std::size_t c = 0; c < to_.r(); ++c)
                residual =
                    graph_.subtract(residual, graph_.multiply(matrix[c * r + b], graph_.subtract(plus[c], minus[c])));
            append(form, both_.section(b), decider.decide(residual));
        });
    }

    /// Functions on the target's arrows at the image of an arrow of the source.
    [[nodiscard]] std::vector<NodeId> at_image(const std::vector<NodeId>& functions, const Arrow& arrow)
    {
        const Arrow image = image_of(graph_, both_.morphism, arrow);
        AlongMap along = both_.along;
        along.set(to_.algebroid.x, image.x);
        along.set(to_.groupoid->arrow.next, image.next);
        along.set(to_.groupoid->arrow.W, image.W);
        const NodeId step = to_.discrete->step;
        if (to_.graph.op(step) == Op::input && !both_.morphism.parameters.contains(step))
            along.set({&step, 1}, {&from_.discrete->step, 1});
        return along(functions);
    }

    MappedSystems both_;
    Graph& graph_;
    const System& from_;
    System& to_; ///< functions of the target are derived on its own graph first
    ProofBudget budget_;
    std::vector<NodeId> s_, sdot_; ///< a section of the source and its rate along a path, inputs
    std::unique_ptr<Judge> judge_;
    StructureReport report_;
    std::vector<Check> paths_;
};

} // namespace

ReductionReport verify_reduction(const SystemMorphism& morphism, const ProofBudget& budget)
{
    return Reduction(morphism, budget).run();
}

} // namespace lagen
