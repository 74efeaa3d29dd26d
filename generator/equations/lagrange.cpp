// SPDX-License-Identifier: GPL-2.0-or-later
/// Lagrange's equations on a Lie algebroid, symbolic, for a person to read:
///   xdot^i = rho^i_a y^a,   p_a = dL/dy^a,   d/dt p_a = rho_a(L) - p_c C^c_ab y^b + Q_a               (momentum form)
///   W_ab ydot^b = rho_a(L) - (d2L/dy^a dx^i) rho^i_b y^b - d2L/dy^a dt - p_c C^c_ab y^b + Q_a     (acceleration form)
///   Q_a = forces_a - dR/dy^a,   E_L = y^a p_a - L,   dE_L/dt = Q_a y^a - dL/dt                   [Martinez 2001]
#include "equations/derivations.hpp"

#include "equations/given_blocks.hpp"
#include "equations/shared_parts.hpp"
#include "expression/parse.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/simplify/simplify.hpp"
#include "mechanics/lagrange.hpp"
#include "model/scene_form.hpp"
#include "symbolic/shortest_form.hpp"
#include "text/activity.hpp"

#include <algorithm>
#include <fmt/core.h>

namespace lagen {
namespace {

const FormulaTerm anchor_term{"ρ_a(L)", R"(\rho_a(L))"};
const FormulaTerm drift_term{"-(∂²L/∂y^a∂x^i) ρ^i_b y^b",
                             R"(-\frac{\partial^2 L}{\partial y^a \partial x^i}\, \rho^i_b\, y^b)"};
const FormulaTerm rate_term{"-∂²L/∂y^a∂t", R"(-\frac{\partial^2 L}{\partial y^a \partial t})"};
const FormulaTerm bracket_term{"-p_c C^c_ab y^b", R"(-p_c\, C^c_{ab}\, y^b)"};
const FormulaTerm force_term{"Q_a", "Q_a"};
const FormulaTerm work_term{"Q_a y^a", R"(Q_a\, y^a)"};
const FormulaTerm loss_term{"-∂L/∂t", R"(-\frac{\partial L}{\partial t})"};

EquationBlock kinematics_block(std::vector<Equation> equations)
{
    return {"kinematics", "ẋ^i = ρ^i_a y^a", R"(\dot x^i = \rho^i_a\, y^a)", std::move(equations)};
}

EquationBlock momenta_block(std::vector<Equation> equations)
{
    return {"momenta", "p_a = ∂L/∂y^a", R"(p_a = \frac{\partial L}{\partial y^a})", std::move(equations)};
}

EquationBlock momentum_block(std::vector<Equation> equations)
{
    EquationBlock block{"equations of motion (momentum form)", "ṗ_a", R"(\dot p_a)", std::move(equations)};
    append_right_side(block, {anchor_term, bracket_term, force_term});
    return block;
}

EquationBlock acceleration_block(std::vector<Equation> equations)
{
    EquationBlock block{"equations of motion (acceleration form)", "W_ab ẏ^b", R"(W_{ab}\, \dot y^b)",
                        std::move(equations)};
    append_right_side(block, {anchor_term, drift_term, rate_term, bracket_term, force_term});
    block.formula += ",  W_ab = ∂²L/∂y^a∂y^b";
    block.latex_formula += R"(, \quad W_{ab} = \frac{\partial^2 L}{\partial y^a \partial y^b})";
    return block;
}

EquationBlock energy_block(Equation energy)
{
    return {"energy", "E = y^a p_a - L", R"(E = y^a p_a - L)", {std::move(energy)}};
}

/// No block where the energy stays as it is.
std::vector<EquationBlock> balance_block(Equation balance)
{
    if (balance.groups.empty()) return {};
    EquationBlock block{"energy balance", "Ė", R"(\dot E)", {std::move(balance)}};
    append_right_side(block, {work_term, loss_term});
    return {std::move(block)};
}

class LagrangeDerivation {
  public:
    LagrangeDerivation(const Model& model, const WrittenAlgebroid& algebroid, const DefinitionChoice& choice)
        : symbolic_(model, algebroid, {model.lagrangian, model.dissipation}, choice),
          lagrangian_(symbolic_.reduced(symbolic_.lower(model.lagrangian))), forces_(symbolic_.forces(symbolic_.y()))
    {
        for (const GiNaC::ex& y : symbolic_.y()) p_.push_back(symbolic_.derivative(lagrangian_, y));
    }

    EquationSet derive(const Regularity& regularity)
    {
        EquationSet set = symbolic_.empty_set(entry_of(FormKind::lagrange).name);
        set.given = given_blocks({lagrangian_block(symbolic_, lagrangian_, "x, y"), bracket_block(symbolic_)},
                                 constraints_and_invariants(symbolic_));
        set.blocks = {kinematics_block(symbolic_.kinematics(symbolic_.y()))};
        if (EquationBlock labels = symbolic_.casimirs(); !labels.equations.empty()) set.blocks.push_back(labels);
        for (EquationBlock& block : std::vector{momenta(), momentum_form(), acceleration_form(), energy()})
            set.blocks.push_back(std::move(block));
        for (EquationBlock& block : energy_balance()) set.blocks.push_back(std::move(block));
        if (EquationBlock states = symbolic_.states(symbolic_.y()); !states.equations.empty())
            set.blocks.push_back(std::move(states));
        append_kernel(set, regularity);
        return symbolic_.closed(std::move(set));
    }

  private:
    [[nodiscard]] std::size_t r() const { return symbolic_.r(); }
    [[nodiscard]] const std::string& fibre_name(std::size_t a) const { return symbolic_.algebroid().fibre[a].name; }

    /// -(d2L/dy^a dx^i) rho^i_b y^b
    [[nodiscard]] Sum drift_terms(std::size_t a) const
    {
        Sum terms;
        for (std::size_t b = 0; b < r(); ++b)
            for (const GiNaC::ex& term : symbolic_.along_anchor(b, p_[a])) terms.push_back(-term * symbolic_.y()[b]);
        return terms;
    }

    [[nodiscard]] EquationBlock momenta() const
    {
        std::vector<Equation> equations;
        for (std::size_t a = 0; a < r(); ++a)
            equations.push_back(symbolic_.equation(LeftSide::symbol, symbolic_.momentum_name(a), {p_[a]}));
        return momenta_block(std::move(equations));
    }

    [[nodiscard]] EquationBlock momentum_form() const
    {
        std::vector<Equation> equations;
        Activity activity("momentum form", r());
        for (std::size_t a = 0; a < r(); ++a) {
            activity.next();
            Equation next{LeftSide::time_derivative, symbolic_.momentum_name(a), {}, {}};
            // Each group for itself: nothing cancels between the momenta and L.
            for (const Group& group :
                 {Group{anchor_term.label, total(symbolic_.along_anchor(a, lagrangian_))},
                  Group{bracket_term.label, total(symbolic_.bracket_terms(a, symbolic_.mu(), symbolic_.y()))},
                  Group{force_term.label, forces_[a]}})
                for (TermGroup& simple : symbolic_.simplified({group})) next.groups.push_back(std::move(simple));
            equations.push_back(std::move(next));
        }
        return momentum_block(std::move(equations));
    }

    [[nodiscard]] EquationBlock acceleration_form()
    {
        std::vector<Equation> equations;
        Activity activity("acceleration form", r());
        for (std::size_t a = 0; a < r(); ++a) {
            activity.next();
            Equation next{LeftSide::time_derivative, fibre_name(a), {}, {}};
            for (std::size_t b = 0; b < r(); ++b)
                for (TermGroup& mass :
                     symbolic_.simplified({{fibre_name(b), symbolic_.derivative(p_[a], symbolic_.y()[b])}}))
                    next.mass.push_back(std::move(mass));
            next.groups =
                symbolic_.simplified({{anchor_term.label, total(symbolic_.along_anchor(a, lagrangian_))},
                                      {drift_term.label, total(drift_terms(a))},
                                      {rate_term.label, -symbolic_.time_derivative(p_[a])},
                                      {bracket_term.label, total(symbolic_.bracket_terms(a, p_, symbolic_.y()))},
                                      {force_term.label, forces_[a]}});
            if (next.mass.empty()) next.left = LeftSide::zero;
            equations.push_back(std::move(next));
        }
        return acceleration_block(std::move(equations));
    }

    [[nodiscard]] std::string energy_name() const { return symbolic_.free_name({"E", "E_L"}); }

    [[nodiscard]] EquationBlock energy() const
    {
        return energy_block(symbolic_.equation(LeftSide::symbol, energy_name(), energy_terms()));
    }

    /// y^a p_a - L term by term of L: one that is homogeneous of degree k in y, k - 1 times as it is.
    [[nodiscard]] Sum energy_terms() const
    {
        Sum terms;
        const auto append = [&](const GiNaC::ex& term) {
            const GiNaC::ex rate = symbolic_.along_fibre(term);
            for (const int degree : {0, 1, 2})
                if (expanded_length(rate - degree * term) == std::optional<std::size_t>(0)) {
                    if (degree != 1) terms.push_back((degree - 1) * term);
                    return;
                }
            terms.push_back(rate);
            terms.push_back(-term);
        };
        if (GiNaC::is_a<GiNaC::add>(lagrangian_))
            for (const GiNaC::ex& term : lagrangian_) append(term);
        else
            append(lagrangian_);
        return terms;
    }

    [[nodiscard]] std::vector<EquationBlock> energy_balance()
    {
        Sum power;
        for (std::size_t a = 0; a < r(); ++a) power.push_back(forces_[a] * symbolic_.y()[a]);
        return balance_block({LeftSide::time_derivative,
                              energy_name(),
                              {},
                              symbolic_.simplified({{work_term.label, total(power)},
                                                    {loss_term.label, -symbolic_.time_derivative(lagrangian_)}})});
    }

    /// The accelerations are free along these.
    void append_kernel(EquationSet& set, const Regularity& regularity)
    {
        for (std::size_t k = 0; k < regularity.kernel.size(); ++k) {
            EquationBlock block{"L is degenerate: kernel of W", "W_ab k^b = 0", R"(W_{ab}\, k^b = 0)", {}};
            if (regularity.kernel.size() > 1)
                block.title += fmt::format(", vector {} of {}", k + 1, regularity.kernel.size());
            for (const auto& [coordinate, component] : regularity.kernel[k]) {
                block.equations.push_back(
                    symbolic_.equation(LeftSide::symbol, "k_" + coordinate, {symbolic_.lower(component)}));
            }
            set.blocks.push_back(std::move(block));
        }
    }

    SymbolicModel symbolic_;
    GiNaC::ex lagrangian_;
    Sum p_;      ///< p_a, shape (r)
    Sum forces_; ///< Q_a, shape (r)
};

/// The same for an L whose equations are too long to be written out: they are made and simplified on the graph, and
/// parts that they share have names.
class LongLagrange {
  public:
    LongLagrange(const Model& model, const System& system)
        : model_(model), system_(system), graph_(system.graph), lower_(graph_),
          lagrangian_(lagrangian_nodes(graph_, system)), zeros_(system.r(), graph_.constant(0)),
          y_(system.written.algebroid.fibre), p_(model.fibre.momenta)
    {
        const MomentumBalance balance = lagrange_balance(graph_, system, lagrangian_);
        rates_ = lagrange_rates(graph_, system, lagrangian_, balance);
        forces_ = balance.forces;
        power_ = contraction(graph_, forces_, balance.y);
        const Algebroid& E = system.algebroid;
        const std::vector<NodeId> flat(system.n(), graph_.constant(0));
        anchored_ = momentum_rates(graph_, E, {lagrangian_.dL_dx, 0, zeros_, E.y, zeros_});
        turned_ = momentum_rates(graph_, E, {flat, 0, system.mu, E.y, zeros_});
        turned_at_p_ = momentum_rates(graph_, E, {flat, 0, lagrangian_.fibre.momenta, E.y, zeros_});
        drift_ = directional(graph_, lagrangian_.fibre.momenta, replacements(E.x, rates_.xdot));
        const std::pair<NodeId, NodeId> along_time[] = {{system.time, graph_.constant(1)}};
        in_time_ = directional(graph_, lagrangian_.fibre.momenta, along_time);
    }

    /// True of equations that would be very long, and are not with names for what they share. Those of few nodes are
    /// short with the names of definitions alone.
    [[nodiscard]] bool is_long() const
    {
        std::vector<NodeId> roots = lagrangian_.fibre.hessian;
        roots.insert(roots.end(), rates_.force.begin(), rates_.force.end());
        const PartCount count = count_parts(graph_, roots);
        return count.nodes > few_nodes && count.written > most_written &&
               count.written > least_sharing * static_cast<double>(count.nodes);
    }

    EquationSet derive()
    {
        const SymbolicModel symbolic(model_, system_.written.algebroid, {});
        const std::vector<std::pair<std::string, NodeId>> definitions = definition_nodes();
        std::vector<NodeId> roots;
        (void)written(symbolic, [&](NodeId node) {
            roots.push_back(node);
            return number(1);
        });
        const std::vector<NodeId> asked = roots;
        std::ranges::replace(roots, *system_.lagrangian, graph_.constant(0)); // stays as it is written
        for (const auto& [name, node] : definitions) roots.push_back(node);
        std::vector<NodeId> simple = simplify(graph_, roots);
        std::map<NodeId, std::string> known;
        Replacements in_names;
        for (std::size_t k = 0; k < definitions.size(); ++k) {
            known.try_emplace(simple[asked.size() + k], definitions[k].first);
            in_names.emplace_back(definitions[k].second, simple[asked.size() + k]);
        }
        const NodeId L = substitute(graph_, std::span(&*system_.lagrangian, 1), in_names)[0];
        for (std::size_t k = 0; k < asked.size(); ++k)
            if (asked[k] == *system_.lagrangian) simple[k] = L;
        simple.resize(asked.size());
        const SharedParts parts = shared_parts(graph_, simple, known, [this](const std::string& name) {
            return model_.columns.has_symbol(name) || model_.columns.has_definition(name) || system_.declares(name);
        });
        std::size_t next = 0;
        EquationSet set = written(symbolic, [&](NodeId) { return parts.values[next++]; });
        set.where = parts.where;
        for (const WhereEntry& entry : set.where) {
            const auto note = std::ranges::find(model_.notes, entry.symbol, &Symbol::name);
            if (entry.symbol.find('[') == std::string::npos)
                set.symbols.push_back({entry.symbol, note == model_.notes.end() ? "" : note->latex});
        }
        return set;
    }

  private:
    static constexpr double most_written = 100'000;
    static constexpr double least_sharing = 10;
    static constexpr std::size_t few_nodes = 1000;

    [[nodiscard]] std::vector<std::pair<std::string, NodeId>> definition_nodes()
    {
        std::vector<std::pair<std::string, NodeId>> definitions;
        for (const Definition& definition : model_.definitions) {
            if (!definition.parameters.empty()) continue;
            const ArrayValue value = model_.columns.close_array(name(definition.name, definition.where), true);
            for (std::size_t k = 0; k < value.entries.size(); ++k)
                definitions.emplace_back(entry_name(definition.name, value.shape, k), lower_(value.entries[k]));
        }
        return definitions;
    }

    /// The group of terms that `write_` makes of a function; none where that is 0.
    [[nodiscard]] std::vector<TermGroup> group(const std::string& label, NodeId node, bool negative = false)
    {
        const Tree value = graph_.is_zero(node) ? number(0) : write_(negative ? graph_.negate(node) : node);
        if (value->kind == TreeKind::number && value->number == 0) return {};
        return {{label, value}};
    }

    [[nodiscard]] static std::vector<TermGroup> joined(std::initializer_list<std::vector<TermGroup>> groups)
    {
        std::vector<TermGroup> terms;
        for (const std::vector<TermGroup>& each : groups) terms.insert(terms.end(), each.begin(), each.end());
        return terms;
    }

    /// left = node, one an equation
    [[nodiscard]] std::vector<Equation> equations(LeftSide left, const std::vector<Symbol>& symbols,
                                                  const std::vector<NodeId>& nodes)
    {
        std::vector<Equation> result;
        for (std::size_t k = 0; k < symbols.size(); ++k)
            result.push_back({left, symbols[k].name, {}, group("", nodes[k])});
        return result;
    }

    [[nodiscard]] std::vector<Equation> momentum_form()
    {
        std::vector<Equation> result;
        for (std::size_t a = 0; a < p_.size(); ++a)
            result.push_back({LeftSide::time_derivative,
                              p_[a].name,
                              {},
                              joined({group(anchor_term.label, anchored_[a]), group(bracket_term.label, turned_[a]),
                                      group(force_term.label, forces_[a])})});
        return result;
    }

    [[nodiscard]] std::vector<Equation> acceleration_form()
    {
        std::vector<Equation> result;
        for (std::size_t a = 0; a < y_.size(); ++a) {
            Equation next{LeftSide::time_derivative, y_[a].name, {}, {}};
            for (std::size_t b = 0; b < y_.size(); ++b)
                for (TermGroup& mass : group(y_[b].name, lagrangian_.fibre.W(a, b)))
                    next.mass.push_back(std::move(mass));
            next.groups = joined({group(anchor_term.label, anchored_[a]), group(drift_term.label, drift_[a], true),
                                  group(rate_term.label, in_time_[a], true), group(bracket_term.label, turned_at_p_[a]),
                                  group(force_term.label, forces_[a])});
            if (next.mass.empty()) next.left = LeftSide::zero;
            result.push_back(std::move(next));
        }
        return result;
    }

    [[nodiscard]] EquationBlock energy(const std::string& E, const std::string& L) const
    {
        std::vector<Tree> terms;
        for (std::size_t a = 0; a < y_.size(); ++a) terms.push_back(multiply({name(y_[a].name), name(p_[a].name)}));
        terms.push_back(negate(name(L)));
        return energy_block({LeftSide::symbol, E, {}, {{"", add(std::move(terms))}}});
    }

    /// The set with what `write` makes of each function; it is asked in one order.
    EquationSet written(const SymbolicModel& symbolic, const std::function<Tree(NodeId)>& write)
    {
        write_ = write;
        const WrittenAlgebroid& algebroid = symbolic.algebroid();
        const std::string L = symbolic.free_name({"L", "L_E"}), E = symbolic.free_name({"E", "E_L"});
        EquationSet set = symbolic.empty_set(entry_of(FormKind::lagrange).name);
        const EquationBlock given = lagrangian_block({LeftSide::symbol, L, {}, group("", *system_.lagrangian)}, "x, y");
        const auto write_tree = [&](const Tree& tree) { return group("", lower_(tree)); };
        set.given =
            given_blocks({given, bracket_block(symbolic)}, constraints_and_invariants(model_, algebroid, write_tree));
        set.blocks = {kinematics_block(equations(LeftSide::time_derivative, algebroid.base, rates_.xdot)),
                      momenta_block(equations(LeftSide::symbol, p_, lagrangian_.fibre.momenta)),
                      momentum_block(momentum_form()), acceleration_block(acceleration_form()), energy(E, L)};
        const auto work = group(work_term.label, power_), loss = group(loss_term.label, lagrangian_.dL_dt, true);
        for (EquationBlock& block : balance_block({LeftSide::time_derivative, E, {}, joined({work, loss})}))
            set.blocks.push_back(std::move(block));
        std::vector<Equation> states;
        for (const FirstOrderState& state : model_.states)
            states.push_back({LeftSide::time_derivative, state.symbol.name, {}, group("", lower_(state.rate))});
        if (!states.empty()) set.blocks.push_back(states_block(std::move(states)));
        return set;
    }

    const Model& model_;
    const System& system_;
    Graph graph_;
    Lowering lower_;
    LagrangianNodes lagrangian_;
    LagrangeRates rates_;
    std::vector<NodeId> zeros_, forces_, anchored_, turned_, turned_at_p_, drift_, in_time_; ///< shapes (r)
    NodeId power_ = 0;
    const std::vector<Symbol>&y_, &p_;
    std::function<Tree(NodeId)> write_;
};

} // namespace

EquationSet derive_lagrange(const Model& model, const WrittenAlgebroid& algebroid, const Regularity& regularity,
                            Definitions definitions)
{
    if (!model.lagrangian)
        throw MathematicsError("model '" + model.name +
                               "' has no Lagrangian; Lagrange's equations need [lagrangian] L");
    return derived(model, "Lagrange's equations", definitions, [&](const DefinitionChoice& choice) {
        return LagrangeDerivation(model, algebroid, choice).derive(regularity);
    });
}

std::optional<EquationSet> derive_long_lagrange(const Model& model, const System& system, const Regularity& regularity)
{
    if (!system.lagrangian || !regularity.kernel.empty() || !model.base.casimirs.empty()) return std::nullopt;
    LongLagrange derivation(model, system);
    if (!derivation.is_long()) return std::nullopt;
    return derived(model, "Lagrange's equations", [&] { return derivation.derive(); });
}

} // namespace lagen
