// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations on the graph. Names with a space cannot clash with identifiers of a model.
#include "geometry/lagrange_motion.hpp"
#include "geometry/momentum_balance.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Seeds = std::vector<std::pair<NodeId, NodeId>>;

/// y^a p_a - L
NodeId energy_of(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian& hessian)
{
    std::vector<NodeId> terms;
    for (std::size_t a = 0; a < algebroid.r(); ++a) terms.push_back(graph.multiply(algebroid.y[a], hessian.momenta[a]));
    return graph.subtract(graph.sum(terms), hessian.lagrangian);
}

} // namespace

LagrangeMotion::LagrangeMotion(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian* hessian,
                               const std::vector<NodeId>& forces, std::optional<NodeId> time)
    : graph_(graph), algebroid_(algebroid), hessian_(hessian), time_(time)
{
    xdot_ = base_velocity(graph, algebroid, algebroid.y);
    if (hessian == nullptr) return;
    Seeds seeds;
    for (std::size_t i = 0; i < xdot_.size(); ++i) seeds.emplace_back(algebroid.x[i], xdot_[i]);
    if (time) seeds.emplace_back(*time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, hessian->momenta, seeds);
    const MomentumBalance balance{hessian->lagrangian, hessian->momenta, algebroid.y, forces};
    BaseGradient partial(graph, algebroid.x);
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        pdot_.push_back(momentum_rate(graph, algebroid, balance, partial, a));
        force_.push_back(graph.subtract(pdot_[a], drift[a]));
        momentum_names_.push_back(graph.input("momentum " + std::to_string(a)));
    }
    energy_name_ = graph.input("energy of L");
    energy_ = energy_of(graph, algebroid, *hessian);
    energy_rate_ = energy_rate(graph, algebroid, balance, time);
}

Binding LagrangeMotion::names(const Model& model) const
{
    Binding binding;
    if (hessian_ == nullptr) return binding;
    for (std::size_t a = 0; a < momentum_names_.size() && a < model.fibre.momenta.size(); ++a)
        bind_undeclared(binding, model, model.fibre.momenta[a].name, momentum_names_[a]);
    bind_undeclared(binding, model, "energy", energy_name_);
    bind_undeclared(binding, model, "hamiltonian", energy_name_);
    bind_undeclared(binding, model, "lagrangian", hessian_->lagrangian);
    return binding;
}

std::vector<NodeId> LagrangeMotion::without_stand_ins(const std::vector<NodeId>& nodes)
{
    if (hessian_ == nullptr) return nodes;
    Seeds replacements = {{energy_name_, energy_}};
    for (std::size_t a = 0; a < momentum_names_.size(); ++a)
        replacements.emplace_back(momentum_names_[a], hessian_->momenta[a]);
    return substitute(graph_, nodes, replacements);
}

/// f_y . ydot by Cramer's rule, a block of coupled coordinates at a time.
std::optional<NodeId> LagrangeMotion::along_accelerations(const std::vector<NodeId>& f_y, std::string& obstacle)
{
    std::vector<NodeId> terms;
    for (const std::vector<std::size_t>& block : hessian_->blocks) {
        const bool used =
            std::any_of(block.begin(), block.end(), [&](std::size_t a) { return !graph_.is_zero(f_y[a]); });
        if (!used) continue;
        if (block.size() > determinant_limit) {
            obstacle = "d2L/dy2 couples " + std::to_string(block.size()) + " fibre coordinates, more than the " +
                       std::to_string(determinant_limit) + " that are solved for exactly";
            return {};
        }
        const NodeId determinant = minor_determinant(graph_, *hessian_, block, block);
        if (graph_.is_zero(determinant)) {
            obstacle =
                "the Lagrangian is degenerate, so that the equations of motion do not determine the accelerations";
            return {};
        }
        std::vector<NodeId> right;
        for (const std::size_t a : block) right.push_back(force_[a]);
        std::vector<NodeId> numerator;
        for (std::size_t k = 0; k < block.size(); ++k)
            if (!graph_.is_zero(f_y[block[k]]))
                numerator.push_back(
                    graph_.multiply(f_y[block[k]], minor_determinant(graph_, *hessian_, block, block, k, right)));
        terms.push_back(graph_.divide(graph_.sum(numerator), determinant));
    }
    return graph_.sum(terms);
}

Rate LagrangeMotion::rate(NodeId f)
{
    Seeds seeds;
    for (std::size_t i = 0; i < xdot_.size(); ++i) seeds.emplace_back(algebroid_.x[i], xdot_[i]);
    if (time_) seeds.emplace_back(*time_, graph_.constant(1));
    for (std::size_t a = 0; a < momentum_names_.size(); ++a) seeds.emplace_back(momentum_names_[a], pdot_[a]);
    if (hessian_ != nullptr) seeds.emplace_back(energy_name_, energy_rate_);
    const NodeId outputs[] = {f};
    const NodeId known = directional(graph_, outputs, seeds)[0];
    const std::vector<NodeId> f_y = gradient(graph_, f, algebroid_.y);
    const bool free = std::all_of(f_y.begin(), f_y.end(), [&](NodeId id) { return graph_.is_zero(id); });
    if (free) return {without_stand_ins({known})[0], {}};
    if (hessian_ == nullptr)
        return {std::nullopt, "the model has no Lagrangian, so that nothing is known of d/dt of the fibre coordinates"};
    std::vector<NodeId> plain = f_y;
    plain.push_back(known);
    plain = without_stand_ins(plain);
    Rate result;
    const std::optional<NodeId> accelerated =
        along_accelerations(std::vector<NodeId>(plain.begin(), plain.end() - 1), result.obstacle);
    if (accelerated) result.value = graph_.add(plain.back(), *accelerated);
    return result;
}

} // namespace lagen
