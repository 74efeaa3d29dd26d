// SPDX-License-Identifier: GPL-2.0-or-later
/// Lowering of a model for its proofs, and the setting in which they are decided.
#include "geometry/claims.hpp"
#include "geometry/lagrange_motion.hpp"
#include "geometry/legendre_obstacle.hpp"
#include "geometry/model_trees.hpp"
#include "geometry/regularity.hpp"
#include "geometry/zero_divisors.hpp"
#include "proof/partial_parts.hpp"

#include <algorithm>
#include <set>

namespace lagen {

Claims::Claims(const Model& model, const Algebroid& algebroid, std::size_t points, const ProofBudget& budget)
    : model_(model), algebroid_(algebroid), points_(points)
{
    lower_model();
    make_setting();
    require_triangular_constraints();
    refuse_zero_divisors(budget);
    judge_ = std::make_unique<Judge>(graph_, setting_, accessory(), points_, budget);
    if (!judge_->decider().sample_point())
        note_ = "no point was found where everything in the model is defined and every condition of [base] holds";
}

void Claims::lower_model()
{
    const std::vector<std::string> names = symbol_names(model_);
    const auto declared = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    for (const Symbol& symbol : algebroid_.base) graph_.input(symbol.name);
    Lowering plain(graph_);
    for (const NamedTree& casimir : model_.base.casimirs)
        if (!declared(casimir.name)) binding_.emplace(casimir.name, plain(casimir.value));
    lower_ = std::make_unique<Lowering>(graph_, binding_);
    lowered_ = lower_algebroid(graph_, *lower_, algebroid_);
    partial_ = std::make_unique<BaseGradient>(graph_, lowered_.x);
    if (!declared("t")) time_ = graph_.input("t");
    for (const Tree& tree : algebroid_.constraints) functions_.constraints.push_back((*lower_)(tree));
    for (const NamedTree& casimir : model_.base.casimirs) functions_.casimirs.push_back((*lower_)(casimir.value));
    lower_mechanics();
}

void Claims::lower_mechanics()
{
    if (model_.lagrangian) hessian_ = fibre_hessian(graph_, (*lower_)(model_.lagrangian), lowered_.y);
    forces_ = generalized_forces(graph_, *lower_, model_, lowered_.y);
    if (!model_.hamiltonian && !model_.control) return;
    for (const Symbol& symbol : model_.fibre.momenta) mu_.push_back(graph_.input(symbol.name));
    if (model_.hamiltonian) hamiltonian_hessian_ = fibre_hessian(graph_, (*lower_)(model_.hamiltonian), mu_);
    if (!model_.control) return;
    ControlNodes& control = control_.emplace();
    for (const Symbol& symbol : model_.control->controls) control.u.push_back(graph_.input(symbol.name));
    control.sigma.assign(lowered_.r(), graph_.constant(0));
    for (const ComponentEntry& entry : model_.control->sigma) control.sigma[entry.section] = (*lower_)(entry.value);
    control.cost = (*lower_)(model_.control->cost);
    control.lower.resize(control.u.size());
    control.upper.resize(control.u.size());
    for (const ControlBound& bound : model_.control->bounds) {
        if (bound.lower) control.lower[bound.control] = (*lower_)(bound.lower);
        if (bound.upper) control.upper[bound.control] = (*lower_)(bound.upper);
    }
}

/// What H, forces and the control problem are made of: they count where they are defined.
void Claims::append_mechanics(std::vector<NodeId>& nodes) const
{
    const auto append = [&](NodeId node) {
        if (!graph_.is_constant(node)) nodes.push_back(node);
    };
    if (hessian_) append(hessian_->lagrangian);
    if (hamiltonian_hessian_) append(hamiltonian_hessian_->lagrangian);
    for (const NodeId force : forces_) append(force);
    if (!control_) return;
    for (const NodeId component : control_->sigma) append(component);
    append(control_->cost);
}

/// Those of the model's default form.
std::unique_ptr<EquationsOfMotion> Claims::equations_of_motion()
{
    if (control_)
        return std::make_unique<PhaseMotion>(graph_, lowered_,
                                             pontryagin_system(graph_, lowered_, *control_, mu_, time_), time_);
    if (hamiltonian_hessian_ && !hessian_)
        return std::make_unique<PhaseMotion>(
            graph_, lowered_, hamilton_system(graph_, lowered_, hamiltonian_hessian_->lagrangian, mu_, forces_, time_),
            time_);
    return std::make_unique<LagrangeMotion>(graph_, lowered_, hessian_ ? &*hessian_ : nullptr, forces_, time_);
}

/// Where nothing else is defined than these nodes: what is claimed to be constant may be undefined at points of a
/// motion.
ProofSetting Claims::setting_of(std::vector<NodeId> defined) const
{
    ProofSetting setting = setting_;
    std::erase_if(defined, [&](NodeId node) { return graph_.is_constant(node); });
    setting.defined = std::move(defined);
    return setting;
}

Continuity Claims::along_anchor()
{
    return {graph_, setting_of(lowered_.entries()), judge_->decider().budget(), {}};
}

/// What the equations of the model's default form are made of, as it is written.
Continuity Claims::along_motions(EquationsOfMotion& motion)
{
    std::vector<NodeId> defined = lowered_.entries();
    if (control_) {
        defined.insert(defined.end(), control_->sigma.begin(), control_->sigma.end());
        defined.push_back(control_->cost);
    } else {
        if (hessian_ || hamiltonian_hessian_)
            defined.push_back(hessian_ ? hessian_->lagrangian : hamiltonian_hessian_->lagrangian);
        for (const ComponentEntry& force : model_.forces) defined.push_back((*lower_)(force.value));
        if (model_.dissipation) defined.push_back((*lower_)(model_.dissipation));
    }
    const auto conserved = [this, &motion](NodeId f) {
        const Rate rate = motion.rate(f);
        return rate.value && judge_->decider().decide(*rate.value).status == ProofStatus::proved;
    };
    Continuity continuity(graph_, setting_of(std::move(defined)), judge_->decider().budget(), conserved);
    if (hessian_ && !control_) continuity.divisors().keep_momenta_finite(hessian_->lagrangian, lowered_.y);
    return continuity;
}

void Claims::make_setting()
{
    setting_.variables = lowered_.x;
    setting_.variables.insert(setting_.variables.end(), lowered_.y.begin(), lowered_.y.end());
    setting_.variables.insert(setting_.variables.end(), mu_.begin(), mu_.end());
    if (control_) setting_.variables.insert(setting_.variables.end(), control_->u.begin(), control_->u.end());
    if (time_) setting_.variables.push_back(*time_);
    for (const std::string& name : algebroid_.parameters) setting_.parameters.push_back(graph_.input(name));
    setting_.constraints = functions_.constraints;
    for (const Tree& tree : algebroid_.domain) setting_.domain.push_back((*lower_)(tree));
    for (const NodeId entry : lowered_.entries())
        if (!graph_.is_constant(entry)) setting_.defined.push_back(entry);
    append_mechanics(setting_.defined);
    setting_.defined.insert(setting_.defined.end(), functions_.casimirs.begin(), functions_.casimirs.end());
    // 0*log(-1 - x^2) folds to 0, but is defined nowhere; sqrt(x)^2 folds to x, and is defined for x >= 0 only.
    const std::vector<NodeId> whole = reachable(graph_, setting_.defined);
    std::set<NodeId> parts;
    for (const Tree& tree : structure_trees(model_, algebroid_))
        for (const NodeId node : partial_parts(graph_, *lower_, tree)) parts.insert(node);
    for (const NodeId node : whole) parts.erase(node);
    setting_.defined.insert(setting_.defined.end(), parts.begin(), parts.end());
    std::sort(setting_.defined.begin(), setting_.defined.end());
    setting_.defined.erase(std::unique(setting_.defined.begin(), setting_.defined.end()), setting_.defined.end());
}

void Claims::require_triangular_constraints()
{
    // One constraint more each time, so that the one that is refused is known by its place.
    ProofSetting growing;
    growing.variables = lowered_.x;
    growing.parameters = setting_.parameters;
    for (std::size_t k = 0; k < algebroid_.constraints.size(); ++k) {
        growing.constraints.push_back(functions_.constraints[k]);
        try {
            ZeroDecider(graph_, growing);
        } catch (const MathematicsError& error) {
            throw ModelError(error.what(), algebroid_.constraints[k]->where,
                             "each constraint must solve for a base coordinate that no earlier one uses up, linearly "
                             "or as a monic power");
        }
    }
}

void Claims::refuse_zero_divisors(const ProofBudget& budget)
{
    const std::unique_ptr<EquationsOfMotion> motion = equations_of_motion();
    Binding names = motion->names(model_);
    names.insert(binding_.begin(), binding_.end());
    Lowering lower(graph_, names);
    ZeroDivisors divisors(graph_, setting_, budget);
    for (const Tree& tree : phase_trees(model_))
        divisors.refuse(tree, [&](const Tree& divisor) { return (*lower_)(divisor); });
    for (const Tree& tree : all_trees(model_, algebroid_))
        divisors.refuse(tree, [&](const Tree& divisor) { return motion->in_states(lower(divisor)); });
}

/// Inputs that only some claims are about.
std::set<std::string> Claims::accessory() const
{
    std::set<std::string> names;
    for (const std::vector<NodeId>* inputs : {&lowered_.y, &mu_})
        for (const NodeId input : *inputs) names.insert(graph_.input_name(input));
    if (control_)
        for (const NodeId u : control_->u) names.insert(graph_.input_name(u));
    if (time_) names.insert(graph_.input_name(*time_));
    return names;
}

/// Parameter inputs with their values as nodes; empty where one of them cannot be lowered.
std::vector<std::pair<NodeId, NodeId>> Claims::parameter_values()
{
    Binding known;
    std::vector<std::pair<NodeId, NodeId>> values;
    for (std::size_t pass = 0; pass < model_.parameters.size() && values.size() < model_.parameters.size(); ++pass)
        for (const Parameter& parameter : model_.parameters) {
            if (known.contains(parameter.symbol.name) || !parameter.value) continue;
            const std::vector<std::string> names = names_in(parameter.value);
            if (!std::all_of(names.begin(), names.end(), [&](const std::string& name) { return known.contains(name); }))
                continue;
            const NodeId value = Lowering(graph_, known)(parameter.value);
            known.emplace(parameter.symbol.name, value);
            values.emplace_back(graph_.input(parameter.symbol.name), value);
        }
    return values.size() == model_.parameters.size() ? values : std::vector<std::pair<NodeId, NodeId>>{};
}

void Claims::decide_regularity(VerifiedAlgebroid& verified)
{
    const bool of_hamiltonian = !hessian_ && hamiltonian_hessian_;
    const std::optional<FibreHessian>& hessian = of_hamiltonian ? hamiltonian_hessian_ : hessian_;
    if (!hessian) return;
    verified.regularity = lagen::decide_regularity(graph_, *hessian, setting_, judge_->decider(), parameter_values());
    verified.regularity.of_hamiltonian = of_hamiltonian;
    decide_legendre_transform(graph_, *hessian, setting_, judge_->decider().budget(), verified.regularity);
}

} // namespace lagen
