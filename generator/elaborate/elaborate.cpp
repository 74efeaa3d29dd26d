// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/elaborate.hpp"

#include "elaborate/bind_parameters.hpp"
#include "elaborate/build_algebroid.hpp"
#include "elaborate/build_distribution.hpp"
#include "elaborate/build_groupoid.hpp"
#include "elaborate/model_trees.hpp"
#include "elaborate/require_values.hpp"
#include "geometry/named_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/scheme.hpp"
#include "mechanics/system.hpp"
#include "proof/decide.hpp"
#include "proof/partial_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace lagen {
namespace {

// Functions that are written over t and do not depend on it: of places on a hoop that turns steadily.

/// f at t = 0 where f is proved to be that at all points and times, else f.
NodeId without_cancelled_time(Graph& graph, const System& system, NodeId f)
{
    const NodeId only[] = {f};
    if (!depends_on_any(graph, only, std::vector{system.time})) return f;
    const auto at_start = substitute_where_defined(graph, only, Replacements{{system.time, graph.constant(0)}});
    if (!at_start) return f;
    ProofSetting setting; // constraints are left out: they need not be triangular yet
    for (const auto* inputs : {&system.algebroid.x, &system.algebroid.y, &system.mu, &system.inputs, &system.states})
        setting.variables.insert(setting.variables.end(), inputs->begin(), inputs->end());
    setting.variables.push_back(system.time);
    setting.parameters = system.parameters;
    setting.domain = system.domain;
    setting.defined = {f};
    const auto decider = ZeroDecider::make(graph, setting, {});
    const bool same = decider && decider->status(graph.subtract(f, (*at_start)[0])) == ProofStatus::proved;
    return same ? (*at_start)[0] : f;
}

class Elaboration {
  public:
    explicit Elaboration(const Model& model) : model_(model), graph_(system_.graph), lower_(graph_) {}

    System run()
    {
        require_values(model_);
        system_.name = model_.name;
        system_.written = written(model_);
        bind_parameters(graph_, model_);
        declare_inputs();
        lower_structure();
        for (const Reconstruction& g : model_.reconstructions) require_group(g);
        lower_mechanics();
        if (model_.control) lower_control();
        if (model_.groupoid) lower_arrows();
        lower_base();
        apply_scheme();
        describe_algebroid();
        lower_symmetries();
        lower_hamilton_jacobi();
        find_partial_parts();
        give_parameter_values();
        if (!model_.forms.empty()) system_.forms = lower_forms(system_, lower_, model_.forms);
        return std::move(system_);
    }

  private:
    [[nodiscard]] static Written written(const Model& model)
    {
        Written result;
        result.algebroid = build_algebroid(model);
        result.invariants = model.invariants;
        for (const FirstOrderState& state : model.states)
            result.states.push_back({state.symbol.name, state.rate, state.symbol.where});
        result.phase = phase_trees(model);
        result.all = all_trees(model, result.algebroid);
        if (!is_nonholonomic(model)) return result;
        result.distribution = build_distribution(model);
        for (const auto* list : {&result.distribution->sections, &result.distribution->drift})
            for (const SectionValue& entry : *list) result.all.push_back(entry.value);
        return result;
    }

    void declare_inputs()
    {
        const std::vector<std::string> declared = symbol_names(model_);
        const bool free = std::ranges::find(declared, "t") == declared.end();
        system_.time = graph_.input(free ? "t" : "time, which this model cannot name");
        for (const Parameter& parameter : model_.parameters)
            if (!parameter.bound) system_.parameters.push_back(graph_.input(parameter.symbol.name));
        for (const Symbol& symbol : model_.base.coordinates) graph_.input(symbol.name);
    }

    void lower_structure()
    {
        system_.algebroid = lower_algebroid(graph_, lower_, system_.written.algebroid);
        if (const auto& written = system_.written.distribution)
            system_.distribution = lower_distribution(graph_, lower_, *written);
        for (const Symbol& symbol : model_.fibre.momenta) system_.mu.push_back(graph_.input(symbol.name));
    }

    void lower_mechanics()
    {
        for (const Input& input : model_.inputs) {
            system_.inputs.push_back(graph_.input(input.symbol.name));
            if (input.value) // a probe has none
                system_.input_values.emplace_back(system_.inputs.back(), lower_(input.value));
        }
        for (const FirstOrderState& state : model_.states) system_.states.push_back(graph_.input(state.symbol.name));
        if (model_.jacobi_field) {
            const auto sigma = system_.states.begin() + static_cast<std::ptrdiff_t>(*model_.jacobi_field);
            const auto delta = sigma + static_cast<std::ptrdiff_t>(system_.r());
            system_.jacobi_field = {{sigma, delta}, {delta, delta + static_cast<std::ptrdiff_t>(system_.r())}};
        }
        if (model_.lagrangian) system_.lagrangian = without_cancelled_time(graph_, system_, lower_(model_.lagrangian));
        for (const Tree& rate : model_.rates) system_.rates.push_back(lower_(rate));
        if (model_.hamiltonian)
            system_.hamiltonian = without_cancelled_time(graph_, system_, lower_(model_.hamiltonian));
        if (model_.forces.empty() && !model_.dissipation) return;
        system_.forces.assign(system_.r(), graph_.constant(0));
        for (const ComponentEntry& entry : model_.forces) {
            NodeId& Q = system_.forces[entry.section];
            system_.force_parts.push_back(lower_(entry.value));
            Q = graph_.add(Q, system_.force_parts.back());
        }
        if (!model_.dissipation) return;
        system_.force_parts.push_back(lower_(model_.dissipation));
        const std::vector<NodeId> dR_dy = gradient(graph_, system_.force_parts.back(), system_.algebroid.y);
        for (std::size_t a = 0; a < system_.r(); ++a) system_.forces[a] = graph_.subtract(system_.forces[a], dR_dy[a]);
    }

    /// The sections that xi lies in have the brackets of the generators: else g' = g xi is no motion of the group.
    void require_group(const Reconstruction& g)
    {
        const NamedAlgebra algebra = *algebra_of_group(g.group);
        const std::size_t m = algebra.basis.size();
        std::map<std::array<std::size_t, 3>, NodeId> wanted;
        for (const StructureConstant& C : algebra.constants) wanted[{C.a, C.b, C.c}] = graph_.constant(C.value);
        const auto section = [&](std::size_t a) { return model_.fibre.coordinates[g.first_section + a].name; };
        for (std::size_t a = 0; a < m; ++a)
            for (std::size_t b = a + 1; b < m; ++b)
                for (std::size_t c = 0; c < m; ++c) {
                    NodeId found = graph_.constant(0);
                    for (const ColumnEntry& entry : system_.algebroid.C(g.first_section + a, g.first_section + b))
                        if (entry.index == g.first_section + c) found = entry.value;
                    const auto place = wanted.find({a, b, c});
                    const NodeId value = place == wanted.end() ? graph_.constant(0) : place->second;
                    if (found == value) continue;
                    throw ModelError(fmt::format("the bracket [{}, {}] of the algebroid has the component {} on {}, "
                                                 "where that of the generators of {} has {}",
                                                 section(a), section(b), to_text(graph_, found), section(c), g.group,
                                                 to_text(graph_, value)),
                                     g.where, "g' = g xi needs the brackets of the group, in the order of its basis");
                }
    }

    void lower_arrows()
    {
        require_groupoid(model_);
        system_.groupoid = lower_groupoid(graph_, lower_, model_);
        system_.groupoid->has_cayley_map = has_cayley_map(model_);
        system_.groupoid_is_claim = model_.algebroid.kind != AlgebroidKind::groupoid;
        if (!model_.discrete) return;
        if (model_.discrete->retraction == "cayley" && !system_.groupoid->has_cayley_map)
            throw ModelError(
                "the retraction is 'cayley', which does not lead from the algebra of these generators into "
                "their group, or is not shown to",
                model_.discrete->retraction_where, "retraction = \"exp\" leads into every matrix group");
        DiscreteSystem& discrete = system_.discrete.emplace();
        discrete.step = graph_.input(model_.discrete->step.name);
        discrete.written = model_.discrete->lagrangian != nullptr;
        if (discrete.written) discrete.lagrangian = lower_(model_.discrete->lagrangian);
    }

    /// exp where it is asked for, or where Cayley's map does not lead into the group.
    [[nodiscard]] std::optional<Exponential> exponential_of_scheme()
    {
        const Groupoid& groupoid = *system_.groupoid;
        const std::string& retraction = model_.discrete->retraction;
        if (groupoid.generators.empty() || (groupoid.has_cayley_map && retraction != "exp")) return {};
        std::vector<NodeId> s;
        for (std::size_t c = 1; c <= groupoid.generators.size(); ++c)
            s.push_back(graph_.input(fmt::format("xi({})", c)));
        return closed_exponential(graph_, system_, std::move(s));
    }

    /// The discrete Lagrangian that a scheme makes of L.
    void apply_scheme()
    {
        if (!system_.discrete || system_.discrete->written) return;
        DiscreteSystem& discrete = *system_.discrete;
        const std::optional<Exponential> exponential = exponential_of_scheme();
        if (exponential && !exponential->block_without.empty()) {
            discrete.obstacle = fmt::format("{}exp(A) of its generators has no closed form that is known here: in the "
                                            "rows {} no A^(k+2), k <= 3, is "
                                            "a multiple of A^k",
                                            system_.groupoid->has_cayley_map
                                                ? ""
                                                : "Cayley's map does not lead into the group, or is not shown to, and ",
                                            fmt::join(exponential->block_without, ", "));
            if (system_.groupoid->has_cayley_map) discrete.hint = "retraction = \"cayley\"";
        } else if (depends_on_any(graph_, system_.forces, system_.inputs)) {
            discrete.obstacle = "its forces depend on inputs, which act in continuous time";
        } else if (depends_on_any(graph_, system_.forces, system_.states)) {
            discrete.obstacle = "its forces depend on first-order states, which move in continuous time";
        }
        if (!discrete.obstacle.empty()) return;
        SchemeLagrangian made = scheme_lagrangian(graph_, system_, quadrature_rule(model_.discrete->scheme),
                                                  discrete.step, exponential ? &*exponential : nullptr);
        discrete.lagrangian = made.lagrangian;
        discrete.inner = std::move(made.inner);
        discrete.work = std::move(made.work);
        discrete.logarithm = std::move(made.logarithm);
    }

    void lower_symmetries()
    {
        for (const Symmetry& symmetry : model_.symmetries) {
            SymmetryClaim& claim = system_.symmetries.emplace_back();
            claim.name = symmetry.name;
            claim.s.assign(system_.r(), graph_.constant(0));
            for (const ComponentEntry& entry : symmetry.section) claim.s[entry.section] = lower_(entry.value);
        }
    }

    /// alpha_a as it is given, or rho_a(S).
    void lower_hamilton_jacobi()
    {
        if (!model_.hamilton_jacobi) return;
        HamiltonJacobiClaim& claim = system_.hamilton_jacobi.emplace();
        claim.alpha.assign(system_.r(), graph_.constant(0));
        for (const ComponentEntry& entry : model_.hamilton_jacobi->alpha) {
            claim.alpha[entry.section] = lower_(entry.value);
            append_parts(claim.parts, entry.value);
        }
        if (model_.hamilton_jacobi->S == nullptr) return;
        const NodeId S = lower_(model_.hamilton_jacobi->S);
        append_parts(claim.parts, model_.hamilton_jacobi->S);
        claim.parts.push_back(S);
        BaseGradient partial(graph_, system_.algebroid.x);
        for (std::size_t a = 0; a < system_.r(); ++a) claim.alpha[a] = partial.along(system_.algebroid.anchor[a], S);
    }

    void lower_control()
    {
        ControlProblem& control = system_.control.emplace();
        for (const Symbol& symbol : model_.control->controls) control.u.push_back(graph_.input(symbol.name));
        control.sigma.assign(system_.r(), graph_.constant(0));
        for (const ComponentEntry& entry : model_.control->sigma) {
            control.sigma[entry.section] = graph_.add(control.sigma[entry.section], lower_(entry.value));
            append_parts(control.parts, entry.value);
        }
        control.cost = lower_(model_.control->cost);
        append_parts(control.parts, model_.control->cost);
        control.lower.resize(control.u.size());
        control.upper.resize(control.u.size());
        for (const ControlBound& bound : model_.control->bounds) {
            if (bound.lower) control.lower[bound.control] = lower_(bound.lower);
            if (bound.upper) control.upper[bound.control] = lower_(bound.upper);
            require_interval(bound);
        }
    }

    /// Bounds over parameters are compared where a scene gives them values.
    void require_interval(const ControlBound& bound)
    {
        if (!bound.lower || !bound.upper) return;
        if (!names_in(bound.lower).empty() || !names_in(bound.upper).empty()) return;
        const NodeId sides[] = {lower_(bound.lower), lower_(bound.upper)};
        const std::vector<long double> ends = evaluate<long double>(graph_, sides, {});
        if (ends[0] < ends[1]) return;
        throw ModelError(
            fmt::format("the bounds of the control '{}' are {} and {}, where the first must be the smaller",
                        model_.control->controls[bound.control].name, to_text(bound.lower), to_text(bound.upper)),
            bound.where);
    }

    void lower_base()
    {
        for (const Tree& tree : model_.base.constraints) {
            system_.functions.constraints.push_back(lower_(tree));
            system_.constraints.push_back({to_text(tree), {}});
        }
        for (const NamedTree& casimir : model_.base.casimirs) {
            system_.functions.casimirs.push_back(lower_(casimir.value));
            system_.casimirs.push_back({casimir.name, {}});
        }
        for (const Tree& tree : model_.base.domain) system_.domain.push_back(lower_(tree));
    }

    /// Entries that are computed (of a frame, of a named algebra) are no places to mend.
    void describe_algebroid()
    {
        const bool nonholonomic = is_nonholonomic(model_);
        const AlgebroidBlock& block = nonholonomic ? model_.algebroid.of[0] : model_.algebroid;
        system_.is_distribution = block.kind == AlgebroidKind::subbundle;
        system_.is_level_set = contains(block, AlgebroidKind::level_set);
        if (nonholonomic) return;
        const bool action = block.kind == AlgebroidKind::action;
        const bool given = block.kind == AlgebroidKind::general || block.kind == AlgebroidKind::lie_algebra || action;
        system_.editable.anchor = (block.kind == AlgebroidKind::general || action) && block.representation.empty();
        system_.editable.bracket = given && block.algebra.empty();
        system_.editable.constant_bracket = block.kind != AlgebroidKind::general;
    }

    void append_parts(std::vector<NodeId>& parts, const Tree& tree)
    {
        const std::vector<NodeId> more = lagen::partial_parts(graph_, lower_, tree);
        parts.insert(parts.end(), more.begin(), more.end());
    }

    void find_partial_parts()
    {
        for (const Tree& tree : structure_trees(model_, system_.written.algebroid))
            append_parts(system_.partial_parts, tree);
        for (std::size_t k = 0; k < system_.constraints.size(); ++k)
            append_parts(system_.constraints[k].parts, model_.base.constraints[k]);
        for (std::size_t k = 0; k < system_.casimirs.size(); ++k)
            append_parts(system_.casimirs[k].parts, model_.base.casimirs[k].value);
    }

    void give_parameter_values()
    {
        const Binding known = parameter_values(graph_, model_);
        for (const NodeId parameter : system_.parameters)
            system_.parameter_values.emplace_back(parameter, known.at(graph_.input_name(parameter)));
    }

    const Model& model_;
    System system_;
    Graph& graph_;
    Lowering lower_;
};

} // namespace

System elaborate(const Model& model)
{
    return Elaboration(model).run();
}

namespace {

class FormLowering {
  public:
    FormLowering(System& system, Lowering& lower)
        : graph_(system.graph), algebroid_(system.algebroid), lower_(lower), partial_(system.graph, system.algebroid.x)
    {
    }

    std::vector<FormClaim> run(const std::vector<NamedForm>& forms)
    {
        std::vector<FormClaim> claims;
        for (const NamedForm& named : forms) {
            FormClaim& claim = claims.emplace_back();
            claim.name = named.name;
            claim.closed = named.closed;
            claim.form = value_of(named, claim.partial_parts);
        }
        for (std::size_t k = 0; k < forms.size(); ++k)
            if (forms[k].equals) claims[k].equals = value_of(*forms[k].equals, claims, claims[k].equals_parts);
        return claims;
    }

  private:
    /// Each component is given once.
    ExteriorForm value_of(const NamedForm& named, std::vector<NodeId>& parts)
    {
        ExteriorForm form{named.degree, {}};
        for (const FormComponent& component : named.components) {
            ExteriorForm term = function_form(lower_(component.value));
            for (const std::size_t a : component.indices) term = wedge(graph_, term, basis_form(graph_, a));
            for (const auto& [index, value] : term.components)
                if (!graph_.is_zero(value)) form.components.emplace(index, value);
            const std::vector<NodeId> more = partial_parts(graph_, lower_, component.value);
            parts.insert(parts.end(), more.begin(), more.end());
        }
        return form;
    }

    /// `used`: what must be defined where the expression is.
    ExteriorForm value_of(const FormExpression& expression, const std::vector<FormClaim>& claims,
                          std::vector<NodeId>& used)
    {
        std::vector<ExteriorForm> parts;
        for (const FormExpression& part : expression.parts) parts.push_back(value_of(part, claims, used));
        switch (expression.kind) {
        case FormExpression::Kind::form: {
            const FormClaim& named = claims[expression.form];
            for (const auto& [index, value] : named.form.components)
                if (!graph_.is_constant(value)) used.push_back(value);
            used.insert(used.end(), named.partial_parts.begin(), named.partial_parts.end());
            return named.form;
        }
        case FormExpression::Kind::function: return function_form(lowered(expression.function, used));
        case FormExpression::Kind::negative: return product(graph_, graph_.constant(-1), parts[0]);
        case FormExpression::Kind::differential: return differential(partial_, algebroid_, parts[0]);
        case FormExpression::Kind::contraction: return contraction(graph_, section_of(expression, used), parts[0]);
        case FormExpression::Kind::sum:
        case FormExpression::Kind::wedge: break;
        }
        ExteriorForm result = parts[0];
        for (std::size_t k = 1; k < parts.size(); ++k)
            result = expression.kind == FormExpression::Kind::sum ? sum(graph_, result, parts[k])
                                                                  : wedge(graph_, result, parts[k]);
        return result;
    }

    NodeId lowered(const Tree& function, std::vector<NodeId>& used)
    {
        const std::vector<NodeId> parts = partial_parts(graph_, lower_, function);
        used.insert(used.end(), parts.begin(), parts.end());
        const NodeId node = lower_(function);
        if (!graph_.is_constant(node)) used.push_back(node);
        return node;
    }

    Section section_of(const FormExpression& expression, std::vector<NodeId>& used)
    {
        Section section;
        for (std::size_t a = 0; a < expression.section.size(); ++a)
            if (const NodeId value = lowered(expression.section[a], used); !graph_.is_zero(value))
                section.push_back({a, value});
        return section;
    }

    Graph& graph_;
    const Algebroid& algebroid_;
    Lowering& lower_;
    BaseGradient partial_;
};

} // namespace

std::vector<FormClaim> lower_forms(System& system, Lowering& lower, const std::vector<NamedForm>& forms)
{
    return FormLowering(system, lower).run(forms);
}

} // namespace lagen
