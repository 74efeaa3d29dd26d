// SPDX-License-Identifier: GPL-2.0-or-later
/// The setting in which the claims of a system are decided, and what is refused before.
#include "verify/claims.hpp"

#include "expression/find_part.hpp"
#include "graph/core/lower.hpp"
#include "verify/discrete_regularity.hpp"
#include "verify/judge.hpp"
#include "verify/legendre_obstacle.hpp"
#include "verify/proof_setting.hpp"
#include "verify/regularity.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace lagen {

namespace {

// Divisions by an expression that is zero everywhere, also where algebra or the base constraints are needed to see it.

/// Looks through trees, in the order in which they are given; a divisor is looked at once.
class ZeroDivisors {
  public:
    /// `setting`: variables, parameters, constraints and domain; what must be `defined` is left out, since nothing is
    /// where a divisor vanishes.
    ZeroDivisors(Graph& graph, ProofSetting setting, const ProofBudget& budget);

    using Lower = std::function<NodeId(const Tree&)>;
    /// Throws ModelError at the first divisor (b of a / b, a of a^-n) that is proved to be zero.
    void refuse(const Tree& tree, const Lower& lower);

  private:
    [[nodiscard]] bool is_zero(NodeId node);

    Graph& graph_;
    ProofSetting setting_;
    ZeroDecider decider_;
    std::optional<WitnessPoint> point_; ///< where most divisors are seen not to vanish
    PartSearch seen_;
    std::set<NodeId> nonzero_; ///< looked at before
};

bool is_negative_number(const Tree& tree)
{
    if (tree->kind == TreeKind::negate)
        return tree->arguments[0]->kind == TreeKind::number && tree->arguments[0]->number > 0;
    return tree->kind == TreeKind::number && tree->number < 0;
}

/// The divisor at the root of a tree, or null.
Tree divisor_of(const Tree& tree)
{
    if (tree->kind == TreeKind::divide) return tree->arguments[1];
    if (tree->kind == TreeKind::power && is_negative_number(tree->arguments[1])) return tree->arguments[0];
    return nullptr;
}

ProofSetting without_definedness(ProofSetting setting)
{
    setting.defined.clear();
    return setting;
}

ZeroDivisors::ZeroDivisors(Graph& graph, ProofSetting setting, const ProofBudget& budget)
    : graph_(graph), setting_(without_definedness(std::move(setting))), decider_(graph, setting_, budget)
{
    const auto point = decider_.sample_point();
    if (point) point_.emplace(graph, *point);
}

bool ZeroDivisors::is_zero(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.is_zero(node);
    if (!nonzero_.insert(node).second || (point_ && !point_->may_vanish(node))) return false;
    return decider_.status(node) == ProofStatus::proved;
}

void ZeroDivisors::refuse(const Tree& root, const Lower& lower)
{
    const auto divides_by_zero = [&](const Tree& part) {
        const Tree divisor = divisor_of(part);
        return divisor != nullptr && is_zero(lower(divisor));
    };
    const Tree quotient = seen_(root, divides_by_zero);
    if (quotient == nullptr) return;
    const Tree divisor = divisor_of(quotient);
    throw ModelError("division by " + to_text(divisor) + ", which is zero everywhere", divisor->where,
                     "a divisor must be nonzero somewhere on the domain");
}

} // namespace

Claims::Claims(const System& system, const ProofBudget& budget)
    : system_(system), graph_(system.graph), partial_(graph_, system.algebroid.x),
      setting_(proof_setting(graph_, system))
{
    if (system.lagrangian) lagrangian_ = lagrangian_nodes(graph_, system);
    if (system.hamiltonian) hamiltonian_hessian_ = fibre_hessian(graph_, *system.hamiltonian, system.mu);
    require_triangular_constraints();
    refuse_zero_divisors(budget);
    judge_ = std::make_unique<Judge>(graph_, setting_, budget);
    if (!judge_->decider().sample_point())
        note_ = "no point was found where everything in the model is defined and every condition of [base] holds";
}

/// The equations of motion in the system's default form.
std::unique_ptr<EquationsOfMotion> Claims::equations_of_motion()
{
    if (system_.control)
        return std::make_unique<PhaseMotion>(graph_, system_, solved_pontryagin_system(graph_, system_));
    if (system_.hamiltonian && !system_.lagrangian)
        return std::make_unique<PhaseMotion>(graph_, system_,
                                             hamilton_system(graph_, system_, given_hamiltonian(graph_, system_)));
    return std::make_unique<LagrangeMotion>(graph_, system_, lagrangian_ ? &*lagrangian_ : nullptr);
}

WhereConstant Claims::along_anchor()
{
    const auto conserved = [this](NodeId f) { return !depends_on_any(graph_, std::vector{f}, setting_.variables); };
    return {graph_, setting_, judge_->decider().budget(), conserved};
}

WhereConstant Claims::along_motions(EquationsOfMotion& motion, const Regularity& regularity)
{
    const auto conserved = [this, &motion, &regularity](NodeId f) {
        const Rate rate = motion.rate(f);
        return rate.value && !rate.for_every_control && divisors_of(rate, regularity).empty() &&
               judge_->decider().status(*rate.value) == ProofStatus::proved;
    };
    return {graph_, setting_, judge_->decider().budget(), conserved};
}

/// The divisors of a rate at whose zeros a motion may arrive.
std::vector<NamedNode> Claims::divisors_of(const Rate& rate, const Regularity& regularity) const
{
    const bool regular = regularity.kind == Regularity::Kind::regular && !regularity.for_given_parameters;
    if (regular && lagrangian_ && !system_.control) return {};
    std::vector<NamedNode> divisors = rate.divisors;
    std::erase_if(divisors, [this](const NamedNode& each) {
        return !depends_on_any(graph_, std::vector{each.node}, setting_.variables) ||
               judge_->decider().proves_nonzero(each.node);
    });
    return divisors;
}

void Claims::require_triangular_constraints()
{
    if (system_.is_level_set) return; // what is not triangular is left out of the setting
    // One constraint more each time, so that the one that is refused is known by its place.
    ProofSetting growing;
    growing.variables = system_.algebroid.x;
    growing.parameters = setting_.parameters;
    const std::vector<Tree>& written = system_.written.algebroid.constraints;
    for (std::size_t k = 0; k < system_.functions.constraints.size(); ++k) {
        growing.constraints.push_back(system_.functions.constraints[k]);
        try {
            ZeroDecider(graph_, growing);
        } catch (const TriangularityError& error) {
            throw ModelError(error.message(), k < written.size() ? written[k]->where : SourceRange{},
                             "each constraint must solve for a base coordinate that no earlier one uses up, linearly "
                             "or as a monic power");
        }
    }
}

void Claims::refuse_zero_divisors(const ProofBudget& budget)
{
    const std::unique_ptr<EquationsOfMotion> motion = equations_of_motion();
    Lowering plain(graph_), named(graph_, motion->names());
    ZeroDivisors divisors(graph_, setting_, budget);
    for (const Tree& tree : system_.written.phase)
        divisors.refuse(tree, [&](const Tree& divisor) { return plain(divisor); });
    for (const Tree& tree : system_.written.all)
        divisors.refuse(tree, [&](const Tree& divisor) { return motion->in_states(named(divisor)); });
}

Regularity Claims::decide_regularity()
{
    const bool of_hamiltonian = !lagrangian_ && hamiltonian_hessian_;
    if (!lagrangian_ && !hamiltonian_hessian_) return {};
    const FibreHessian& hessian = of_hamiltonian ? *hamiltonian_hessian_ : lagrangian_->fibre;
    const Replacements& values = system_.parameter_values;
    Regularity regularity = lagen::decide_regularity(graph_, hessian, setting_, judge_->decider(), values);
    if (of_hamiltonian) regularity.of = Regularity::Matrix::hamiltonian;
    if (system_.distribution) regularity.of = Regularity::Matrix::constrained;
    decide_legendre_transform(graph_, hessian, setting_, judge_->decider().budget(), values, regularity);
    if (system_.distribution) add_singular_minor(regularity);
    return regularity;
}

Regularity Claims::decide_discrete_regularity()
{
    return lagen::decide_discrete_regularity(graph_, system_, judge_->decider().budget());
}

} // namespace lagen
