// SPDX-License-Identifier: GPL-2.0-or-later
/// Reactions, projected brackets and the form on D* of nonholonomic models.
#include "equations/constrained_model.hpp"
#include "equations/derivations.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/hamilton.hpp"
#include "model/scene_form.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>

namespace lagen {

namespace {

class NonholonomicForms : ConstrainedModel {
  public:
    NonholonomicForms(const Model& model, const System& system, const DefinitionChoice& choice)
        : ConstrainedModel(model, system, choice), system_(system)
    {
    }

    EquationSet derive(const std::string& form, const std::vector<Tree>& functions)
    {
        EquationSet set = form == "reaction"    ? reactions()
                          : form == "projected" ? projected()
                          : form == "poisson"   ? poisson(functions)
                                                : hamilton();
        return symbolic_.closed(std::move(set));
    }

  private:
    EquationSet reactions()
    {
        EquationSet set = symbolic_.empty_set("reaction");
        const auto ydot = accelerations();
        if (!ydot)
            throw MathematicsError("the accelerations of model '" + symbolic_.model().name +
                                       "' are too long to be written out, and the reactions with them",
                                   "`run` observes reaction.Y, and the generated header has the kernel `reaction`");
        EquationBlock block{"reactions",
                            "λ_a = d/dt P_a - ρ_a(L) + P_c C^c_ab Y^b - Q_a",
                            R"(\lambda_a = \frac{d}{dt} P_a - \rho_a(L) + P_c\, C^c_{ab}\, Y^b - Q_a)",
                            {}};
        for (std::size_t a = 0; a < r_; ++a) {
            Sum rate = along_motion(P_[a], *ydot), force, bracket;
            for (const GiNaC::ex& term : symbolic_.along_anchor(a, lagrangian_)) force.push_back(-on_constraint(term));
            for (const GiNaC::ex& term : symbolic_.bracket_terms(a, P_, Y_)) bracket.push_back(-term);
            const GiNaC::ex lambda = total(rate) + total(force) + total(bracket) - forces_[a];
            block.equations.push_back(
                symbolic_.equation(LeftSide::symbol, "lambda_" + ambient_name(a), {as_fraction(lambda)}));
            set.symbols.push_back({"lambda_" + ambient_name(a), {}});
        }
        set.blocks = {velocities(), std::move(block)};
        return set;
    }

    EquationSet projected()
    {
        require_mechanical();
        EquationSet set = symbolic_.empty_set("projected");
        EquationBlock block{"projected brackets",
                            "[e_α, e_β]_D = G^{γδ} G(e_δ, [e_α, e_β]) e_γ",
                            R"([e_\alpha, e_\beta]_D = G^{\gamma\delta}\, G(e_\delta, [e_\alpha, e_\beta])\, e_\gamma)",
                            {}};
        const SquareMatrix G = hessian();
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            for (std::size_t beta = alpha + 1; beta < k_; ++beta) {
                const Sum V = bracket(sections_[alpha], sections_[beta]);
                Sum right(k_, 0);
                for (std::size_t delta = 0; delta < k_; ++delta)
                    for (std::size_t a = 0; a < r_; ++a)
                        for (std::size_t b = 0; b < r_; ++b)
                            right[delta] += sections_[delta][a] *
                                            symbolic_.derivative(ambient_momenta_[a], symbolic_.y()[b]) * V[b];
                for (GiNaC::ex& each : right) each = symbolic_.simpler(each);
                const auto C = solved(G, right);
                if (!C)
                    throw MathematicsError("the projected brackets of model '" + symbolic_.model().name +
                                           "' are too long to be written out");
                block.equations.push_back(section_equation(LeftSide::commutator, alpha, beta, *C, written_.y));
            }
        set.blocks = {sections(), std::move(block)};
        return set;
    }

    EquationSet hamilton()
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::hamilton).name);
        take_momenta();
        // l is quadratic in y: with p = W y + c, h = (p - c) y/2 - l at y = 0.
        GiNaC::exmap rest;
        for (const GiNaC::ex& y : y_) rest[y] = 0;
        Sum terms{-l_.subs(rest, GiNaC::subs_options::no_pattern)};
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            terms.push_back((symbolic_.mu()[alpha] - p_[alpha].subs(rest, GiNaC::subs_options::no_pattern)) *
                            at_momenta(y_[alpha]) / 2);
        Sum Y;
        for (const GiNaC::ex& each : Y_) Y.push_back(at_momenta(each));
        EquationBlock velocities{
            "velocities", "y^α = ∂h/∂p_α", R"(y^\alpha = \frac{\partial h}{\partial p_\alpha})", {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha)
            velocities.equations.push_back(
                symbolic_.equation(LeftSide::symbol, written_.y[alpha].name, {at_momenta(y_[alpha])}));
        const std::string h = symbolic_.free_name({"h", "h_D"});
        set.blocks = {
            {"Hamiltonian",
             "h = y^α p_α - l",
             R"(h = y^\alpha p_\alpha - l)",
             {symbolic_.equation(LeftSide::symbol, h, terms)}},
            std::move(velocities),
            {"kinematics", "ẋ^i = ρ^i_a Y^a", R"(\dot x^i = \rho^i_a\, Y^a)", symbolic_.kinematics(Y)},
            momentum_equations(),
        };
        if (has_drift()) return set;
        set.blocks.push_back(almost_poisson());
        append_jacobiator(set);
        return set;
    }

    /// `functions`: F, G of each pair whose bracket is asked for, over x and p.
    EquationSet poisson(const std::vector<Tree>& functions)
    {
        if (has_drift())
            throw MathematicsError("the almost Poisson brackets of model '" + symbolic_.model().name +
                                       "' do not make its motion: the constraint has a drift",
                                   "--form hamilton shows its equations on D*");
        EquationSet set = symbolic_.empty_set("poisson");
        take_momenta();
        set.blocks = {almost_poisson()};
        if (!functions.empty()) set.blocks.push_back(brackets_of(functions));
        append_jacobiator(set);
        return set;
    }

    /// L = G(Y, Y)/2 - V and no drift: only then the projected bracket gives the equations of motion.
    void require_mechanical()
    {
        const auto refuse = [&](const char* why) {
            throw MathematicsError("the brackets of model '" + symbolic_.model().name + "' have no projection: " + why,
                                   "derive without --form shows equations that hold for every L");
        };
        if (has_drift()) refuse("the constraint has a drift");
        GiNaC::exmap rest;
        for (const GiNaC::ex& Y : symbolic_.y()) rest[Y] = 0;
        for (const GiNaC::ex& P : ambient_momenta_) {
            if (!symbolic_.simpler(P.subs(rest, GiNaC::subs_options::no_pattern)).is_zero())
                refuse("L has terms that are linear in the velocities, or is not smooth");
            for (const GiNaC::ex& Y : symbolic_.y())
                for (const GiNaC::ex& Z : symbolic_.y())
                    if (!symbolic_.simpler(symbolic_.derivative(symbolic_.derivative(P, Y), Z)).is_zero())
                        refuse("L is not quadratic in the velocities");
        }
    }

    /// y(x, p), of momenta that are affine in y.
    void take_momenta()
    {
        GiNaC::exmap rest;
        for (const GiNaC::ex& y : y_) rest[y] = 0;
        Sum right;
        bool affine = true;
        for (std::size_t alpha = 0; alpha < k_; ++alpha) {
            right.push_back(symbolic_.mu()[alpha] - p_[alpha].subs(rest, GiNaC::subs_options::no_pattern));
            for (const GiNaC::ex& y : y_)
                for (const GiNaC::ex& z : y_)
                    affine = affine &&
                             symbolic_.simpler(symbolic_.derivative(symbolic_.derivative(p_[alpha], y), z)).is_zero();
        }
        const auto y = affine ? solved(hessian(), right) : std::nullopt;
        if (!y)
            throw MathematicsError("the velocities of model '" + symbolic_.model().name +
                                       "' as functions of the momenta are too long to be written out",
                                   "`run --form hamilton` and `generate --form hamilton` solve for them");
        for (std::size_t alpha = 0; alpha < k_; ++alpha) momenta_[y_[alpha]] = (*y)[alpha];
    }

    [[nodiscard]] GiNaC::ex at_momenta(const GiNaC::ex& f) const
    {
        return f.subs(momenta_, GiNaC::subs_options::no_pattern);
    }

    [[nodiscard]] EquationBlock momentum_equations()
    {
        EquationBlock block{"equations of motion",
                            "ṗ_α = -ρ(e_α)(h) - P_a [e_α, Y]^a" + std::string(symbolic_.has_forces() ? " + Q_α" : ""),
                            R"(\dot p_\alpha = -\rho(e_\alpha)(h) - P_a\, [e_\alpha, Y]^a)" +
                                std::string(symbolic_.has_forces() ? R"( + Q_\alpha)" : ""),
                            {}};
        for (std::size_t alpha = 0; alpha < k_; ++alpha) {
            std::vector<Group> groups = balance(alpha);
            groups[0].label = "-ρ_α(h)";
            for (Group& group : groups) group.value = at_momenta(group.value);
            block.equations.push_back(
                {LeftSide::time_derivative, momentum_name(alpha), {}, symbolic_.simplified(std::move(groups))});
        }
        return block;
    }

    /// Neither forces nor sections that move by themselves: h alone makes the motion.
    [[nodiscard]] bool is_free()
    {
        bool free = !symbolic_.has_forces();
        for (const Sum& section : sections_)
            for (const GiNaC::ex& entry : section) free = free && symbolic_.time_derivative(entry).is_zero();
        return free;
    }

    /// Skew and a derivation in each argument; Jacobi's identity fails where D is not integrable.
    [[nodiscard]] EquationBlock almost_poisson()
    {
        EquationBlock block{
            is_free() ? "almost Poisson brackets (Jacobi's identity may fail), df/dt = {h, f}"
                      : "almost Poisson brackets (Jacobi's identity may fail)",
            "{p_α, x^i} = ρ(e_α)^i,  {p_α, p_β} = P_a [e_α, e_β]^a",
            R"(\{p_\alpha, x^i\} = \rho(e_\alpha)^i, \quad \{p_\alpha, p_\beta\} = P_a\, [e_\alpha, e_\beta]^a)",
            {}};
        const auto append = [&](const std::string& f, const std::string& g, const GiNaC::ex& value) {
            Equation next = symbolic_.equation(LeftSide::bracket, f, {at_momenta(value)});
            next.other = g;
            if (!next.groups.empty()) block.equations.push_back(std::move(next));
        };
        for (std::size_t alpha = 0; alpha < k_; ++alpha) {
            for (std::size_t i = 0; i < symbolic_.n(); ++i)
                append(momentum_name(alpha), symbolic_.algebroid().base[i].name,
                       total(along(sections_[alpha], symbolic_.x()[i])));
            for (std::size_t beta = alpha + 1; beta < k_; ++beta)
                append(momentum_name(alpha), momentum_name(beta), bracket_of_momenta(alpha, beta));
        }
        return block;
    }

    /// P_a [e_alpha, e_beta]^a at y(x, p)
    [[nodiscard]] GiNaC::ex bracket_of_momenta(std::size_t alpha, std::size_t beta) const
    {
        const Sum V = bracket(sections_[alpha], sections_[beta]);
        GiNaC::ex value;
        for (std::size_t a = 0; a < r_; ++a) value += P_[a] * V[a];
        return at_momenta(value);
    }

    /// {f, g} of functions of x and p
    [[nodiscard]] GiNaC::ex almost_bracket(const GiNaC::ex& f, const GiNaC::ex& g) const
    {
        GiNaC::ex value;
        for (std::size_t alpha = 0; alpha < k_; ++alpha) {
            const GiNaC::ex f_p = symbolic_.derivative(f, symbolic_.mu()[alpha]),
                            g_p = symbolic_.derivative(g, symbolic_.mu()[alpha]);
            value += f_p * total(along(sections_[alpha], g)) - g_p * total(along(sections_[alpha], f));
            for (std::size_t beta = 0; beta < k_; ++beta)
                value += f_p * symbolic_.derivative(g, symbolic_.mu()[beta]) * bracket_of_momenta(alpha, beta);
        }
        return value;
    }

    [[nodiscard]] EquationBlock brackets_of(const std::vector<Tree>& functions)
    {
        EquationBlock block{
            "brackets of functions",
            "{F, G} = F^α ρ(e_α)(G) - G^α ρ(e_α)(F) + {p_α, p_β} F^α G^β,  F^α = ∂F/∂p_α",
            R"(\{F, G\} = F^\alpha\, \rho(e_\alpha)(G) - G^\alpha\, \rho(e_\alpha)(F) + \{p_\alpha, p_\beta\}\, F^\alpha )"
            R"(G^\beta,\quad F^\alpha = \frac{\partial F}{\partial p_\alpha})",
            {}};
        for (std::size_t k = 0; k + 1 < functions.size(); k += 2) {
            const GiNaC::ex F = symbolic_.lower(functions[k]), G = symbolic_.lower(functions[k + 1]);
            const std::string number = k == 0 ? "" : std::to_string(k / 2 + 1);
            const std::string f = symbolic_.free_name({"F" + number, "F_" + number});
            const std::string g = symbolic_.free_name({"G" + number, "G_" + number});
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, f, {F}));
            block.equations.push_back(symbolic_.equation(LeftSide::symbol, g, {G}));
            Equation value = symbolic_.equation(LeftSide::bracket, f, {almost_bracket(F, G)});
            value.other = g;
            block.equations.push_back(std::move(value));
        }
        return block;
    }

    void append_jacobiator(EquationSet& set)
    {
        Graph graph = system_.graph;
        const auto h = closed_hamiltonian(graph, system_, {});
        if (!h || !h->constrained) { // the graph does not see that the momenta are affine
            DecidedStatement statement{"J(f, g, h) = 0", "J(f, g, h) = 0", "undecided"};
            statement.evidence = "L has terms that cancel";
            set.statements.push_back(std::move(statement));
            return;
        }
        if (EquationBlock failure = jacobiator(graph, *h->constrained); !failure.equations.empty())
            set.blocks.push_back(std::move(failure));
    }

    /// The triples are a coordinate of the base or a momentum and two momenta: the first that certainly does not
    /// vanish, else the first that is not shown to vanish; no equations where all are.
    [[nodiscard]] EquationBlock jacobiator(Graph& graph, const ConstrainedNodes& constrained)
    {
        EquationBlock block{"Jacobiator, the first that does not vanish",
                            "J(f, g, h) = {f, {g, h}} + {g, {h, f}} + {h, {f, g}}",
                            R"(J(f, g, h) = \{f, \{g, h\}\} + \{g, \{h, f\}\} + \{h, \{f, g\}\})",
                            {}};
        ProofSetting setting = proof_setting(graph, system_);
        setting.variables.insert(setting.variables.end(), system_.mu.begin(), system_.mu.end());
        const auto decider = ZeroDecider::make(graph, setting);
        const auto bracket_of = [&](NodeId f, NodeId g) {
            return almost_poisson_bracket(graph, system_, constrained, f, g);
        };
        std::vector<NodeId> z = system_.algebroid.x;
        z.insert(z.end(), system_.mu.begin(), system_.mu.end());
        const std::size_t n = system_.n();
        for (std::size_t i = 0; i < z.size(); ++i)
            for (std::size_t j = std::max(i + 1, n); j < z.size(); ++j)
                for (std::size_t l = j + 1; l < z.size(); ++l) {
                    const NodeId terms[] = {bracket_of(z[i], bracket_of(z[j], z[l])),
                                            bracket_of(z[j], bracket_of(z[l], z[i])),
                                            bracket_of(z[l], bracket_of(z[i], z[j]))};
                    const NodeId J = graph.sum(terms);
                    const ProofStatus status = graph.is_zero(J) ? ProofStatus::proved
                                               : decider        ? decider->status(J)
                                                                : ProofStatus::undecided;
                    if (status == ProofStatus::proved) continue;
                    if (status == ProofStatus::undecided && !block.equations.empty()) continue;
                    Equation failure =
                        symbolic_.equation(LeftSide::component, "J", {symbolic_.lower(to_tree(graph, J))});
                    for (const NodeId each : {z[i], z[j], z[l]}) failure.arguments.push_back(graph.input_name(each));
                    block.equations = {std::move(failure)};
                    if (status == ProofStatus::refuted) {
                        block.title = "Jacobiator, the first that does not vanish";
                        return block;
                    }
                    block.title = "Jacobiator, the first that is not shown to vanish";
                }
        return block;
    }

    const System& system_;
    GiNaC::exmap momenta_; ///< y(x, p)
};

} // namespace

EquationSet derive_nonholonomic_form(const std::string& form, const Model& model, const System& system,
                                     const std::vector<Tree>& functions, Definitions definitions)
{
    require_lagrangian(model);
    return derived(model, "the nonholonomic equations", definitions, [&](const DefinitionChoice& choice) {
        return NonholonomicForms(model, system, choice).derive(form, functions);
    });
}

} // namespace lagen
