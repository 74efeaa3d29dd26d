// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations on the graph. Names with a space cannot clash with identifiers of a model.
#include "mechanics/lagrange_motion.hpp"

#include "graph/calculus/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Seeds = std::vector<std::pair<NodeId, NodeId>>;

} // namespace

LagrangeMotion::LagrangeMotion(Graph& graph, const System& system, const LagrangianNodes* lagrangian)
    : graph_(graph), system_(system), lagrangian_(lagrangian)
{
    if (lagrangian == nullptr) {
        take_kinematics();
        return;
    }
    const MomentumBalance balance = lagrange_balance(graph, system, *lagrangian);
    LagrangeRates rates = lagrange_rates(graph, system, *lagrangian, balance);
    xdot_ = std::move(rates.xdot);
    pdot_ = std::move(rates.pdot);
    force_ = std::move(rates.force);
    for (std::size_t a = 0; a < pdot_.size(); ++a)
        momentum_names_.push_back(graph.input("momentum " + std::to_string(a)));
    energy_ = {graph.input("energy of L"), lagrangian->energy, lagrange_power(graph, system, *lagrangian, balance)};
    if (!lagrangian->constrained) return;
    const ConstrainedNodes& nodes = *lagrangian->constrained;
    moving_energy_ = {graph.input("moving energy of L"), moving_energy(graph, nodes),
                      moving_energy_rate(graph, system, nodes, balance)};
    ambient_ = ambient_names(system, nodes.hull.Y);
}

void LagrangeMotion::take_kinematics()
{
    if (!system_.rates.empty()) {
        xdot_ = system_.rates;
        return;
    }
    if (!system_.distribution) {
        xdot_ = base_velocity(graph_, system_.algebroid, system_.algebroid.y);
        return;
    }
    const ConstraintHull hull = constraint_hull(graph_, system_);
    xdot_ = base_velocity(graph_, hull.frame, hull.weights);
    ambient_ = ambient_names(system_, hull.Y);
}

Binding LagrangeMotion::names() const
{
    Binding binding = ambient_;
    if (lagrangian_ == nullptr) return binding;
    const auto bind = [&](const std::string& name, NodeId node) {
        if (!system_.declares(name)) binding.emplace(name, node);
    };
    for (std::size_t a = 0; a < std::min(momentum_names_.size(), system_.mu.size()); ++a)
        bind(system_.graph.input_name(system_.mu[a]), momentum_names_[a]);
    const auto shown = [](const FollowedEnergy& energy) { return energy.rate ? energy.name : energy.value; };
    bind("energy", shown(energy_));
    bind("hamiltonian", shown(lagrangian_->constrained ? moving_energy_ : energy_));
    if (lagrangian_->constrained) bind("moving_energy", shown(moving_energy_));
    bind("lagrangian", lagrangian_->fibre.lagrangian);
    return binding;
}

std::vector<NodeId> LagrangeMotion::without_stand_ins(const std::vector<NodeId>& nodes)
{
    if (lagrangian_ == nullptr) return nodes;
    Seeds replacements = {{energy_.name, energy_.value}};
    if (lagrangian_->constrained) replacements.emplace_back(moving_energy_.name, moving_energy_.value);
    for (std::size_t a = 0; a < momentum_names_.size(); ++a)
        replacements.emplace_back(momentum_names_[a], lagrangian_->fibre.momenta[a]);
    return substitute(graph_, nodes, replacements);
}

/// f_y . ydot by Cramer's rule, a block of coupled coordinates at a time.
std::optional<NodeId> LagrangeMotion::along_accelerations(const std::vector<NodeId>& f_y, Rate& rate)
{
    std::vector<NodeId> terms;
    for (const std::vector<std::size_t>& block : lagrangian_->fibre.blocks) {
        const bool used =
            std::any_of(block.begin(), block.end(), [&](std::size_t a) { return !graph_.is_zero(f_y[a]); });
        if (!used) continue;
        if (block.size() > determinant_limit) {
            rate.obstacle = "d2L/dy2 couples " + std::to_string(block.size()) + " fibre coordinates, more than the " +
                            std::to_string(determinant_limit) + " that are solved for exactly";
            return {};
        }
        std::vector<NodeId> right;
        for (const std::size_t a : block) right.push_back(force_[a]);
        const CramersRule ydot = solve_block(graph_, lagrangian_->fibre, block, std::move(right));
        if (graph_.is_zero(ydot.divisor)) {
            rate.obstacle =
                "the Lagrangian is degenerate, so that the equations of motion do not determine the accelerations";
            return {};
        }
        rate.divisors.push_back({ydot.divisor, "det(d2L/dy2)"});
        std::vector<NodeId> numerator;
        for (std::size_t k = 0; k < block.size(); ++k)
            if (!graph_.is_zero(f_y[block[k]])) numerator.push_back(graph_.multiply(f_y[block[k]], ydot.numerator(k)));
        terms.push_back(graph_.divide(graph_.sum(numerator), ydot.divisor));
    }
    return graph_.sum(terms);
}

Rate LagrangeMotion::rate(NodeId f)
{
    Seeds seeds;
    for (std::size_t i = 0; i < xdot_.size(); ++i) seeds.emplace_back(system_.algebroid.x[i], xdot_[i]);
    seeds.emplace_back(system_.time, graph_.constant(1));
    for (std::size_t a = 0; a < momentum_names_.size(); ++a) seeds.emplace_back(momentum_names_[a], pdot_[a]);
    Lowering lower(graph_, names());
    for (std::size_t k = 0; k < system_.states.size(); ++k)
        seeds.emplace_back(system_.states[k], lower(system_.written.states[k].value));
    for (const FollowedEnergy& energy : {energy_, moving_energy_})
        if (energy.rate) seeds.emplace_back(energy.name, *energy.rate);
    const NodeId outputs[] = {f};
    const NodeId known = directional(graph_, outputs, seeds)[0];
    const std::vector<NodeId> f_y = gradient(graph_, f, system_.velocities());
    const bool free = std::all_of(f_y.begin(), f_y.end(), [&](NodeId id) { return graph_.is_zero(id); });
    if (free) return {without_stand_ins({known})[0], {}};
    if (lagrangian_ == nullptr)
        return {std::nullopt, "the model has no Lagrangian, so that nothing is known of d/dt of the fibre coordinates"};
    std::vector<NodeId> plain = f_y;
    plain.push_back(known);
    plain = without_stand_ins(plain);
    Rate result;
    const std::optional<NodeId> accelerated =
        along_accelerations(std::vector<NodeId>(plain.begin(), plain.end() - 1), result);
    if (accelerated) result.value = graph_.add(plain.back(), *accelerated);
    return result;
}

} // namespace lagen
