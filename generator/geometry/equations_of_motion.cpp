// SPDX-License-Identifier: GPL-2.0-or-later
/// Rates along Lagrange's equations on the graph. Names with a space cannot clash with identifiers of a model.
#include "geometry/equations_of_motion.hpp"
#include "graph/differentiate.hpp"

#include <algorithm>

namespace lagen {
namespace {

using Seeds = std::vector<std::pair<NodeId, NodeId>>;

/// p_c C^c_ab
NodeId momentum_of_bracket(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian& hessian, std::size_t a,
                           std::size_t b)
{
    std::vector<NodeId> terms;
    for (const ColumnEntry& entry : algebroid.C(a, b))
        terms.push_back(graph.multiply(hessian.momenta[entry.index], entry.value));
    return graph.sum(terms);
}

/// rho_a(L) - p_c C^c_ab y^b
NodeId momentum_rate(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian& hessian,
                     BaseGradient& partial, std::size_t a)
{
    std::vector<NodeId> terms;
    partial.append_anchor_derivative(terms, algebroid.anchor[a], hessian.lagrangian, false);
    for (std::size_t b = 0; b < algebroid.r(); ++b) {
        const NodeId bracket = momentum_of_bracket(graph, algebroid, hessian, a, b);
        if (!graph.is_zero(bracket)) terms.push_back(graph.negate(graph.multiply(bracket, algebroid.y[b])));
    }
    return graph.sum(terms);
}

/// -dL/dt - p_c C^c_ab y^a y^b; the second sum is folded over a <= b, where C^c_ab + C^c_ba is zero at a glance.
NodeId energy_rate(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian& hessian,
                   std::optional<NodeId> time)
{
    std::vector<NodeId> terms;
    if (time) {
        const NodeId inputs[] = {*time};
        terms.push_back(graph.negate(gradient(graph, hessian.lagrangian, inputs)[0]));
    }
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a; b < algebroid.r(); ++b)
            for (std::size_t c = 0; c < algebroid.r(); ++c) {
                const NodeId forward = LoweredAlgebroid::entry(graph, algebroid.C(a, b), c);
                const NodeId backward =
                    a == b ? graph.constant(0) : LoweredAlgebroid::entry(graph, algebroid.C(b, a), c);
                const NodeId coefficient = graph.add(forward, backward);
                const NodeId factors[] = {hessian.momenta[c], coefficient, algebroid.y[a], algebroid.y[b]};
                if (!graph.is_zero(coefficient)) terms.push_back(graph.negate(graph.product(factors)));
            }
    return graph.sum(terms);
}

/// y^a p_a - L
NodeId energy_of(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian& hessian)
{
    std::vector<NodeId> terms;
    for (std::size_t a = 0; a < algebroid.r(); ++a) terms.push_back(graph.multiply(algebroid.y[a], hessian.momenta[a]));
    return graph.subtract(graph.sum(terms), hessian.lagrangian);
}

bool declares(const Model& model, const std::string& name)
{
    const std::vector<std::string> names = symbol_names(model);
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

EquationsOfMotion::EquationsOfMotion(Graph& graph, const LoweredAlgebroid& algebroid, const FibreHessian* hessian,
                                     std::optional<NodeId> time)
    : graph_(graph), algebroid_(algebroid), hessian_(hessian), time_(time)
{
    std::vector<std::vector<NodeId>> terms(algebroid.x.size());
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (const ColumnEntry& entry : algebroid.anchor[a])
            terms[entry.index].push_back(graph.multiply(entry.value, algebroid.y[a]));
    for (const std::vector<NodeId>& sum : terms) xdot_.push_back(graph.sum(sum));
    if (hessian == nullptr) return;
    Seeds seeds;
    for (std::size_t i = 0; i < xdot_.size(); ++i) seeds.emplace_back(algebroid.x[i], xdot_[i]);
    if (time) seeds.emplace_back(*time, graph.constant(1));
    const std::vector<NodeId> drift = directional(graph, hessian->momenta, seeds);
    BaseGradient partial(graph, algebroid.x);
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        pdot_.push_back(momentum_rate(graph, algebroid, *hessian, partial, a));
        force_.push_back(graph.subtract(pdot_[a], drift[a]));
        momentum_names_.push_back(graph.input("momentum " + std::to_string(a)));
    }
    energy_name_ = graph.input("energy of L");
    energy_ = energy_of(graph, algebroid, *hessian);
    energy_rate_ = energy_rate(graph, algebroid, *hessian, time);
}

Binding EquationsOfMotion::names(const Model& model) const
{
    Binding binding;
    if (hessian_ == nullptr) return binding;
    for (std::size_t a = 0; a < momentum_names_.size() && a < model.fibre.momenta.size(); ++a)
        if (!declares(model, model.fibre.momenta[a].name))
            binding.emplace(model.fibre.momenta[a].name, momentum_names_[a]);
    if (!declares(model, "energy")) binding.emplace("energy", energy_name_);
    if (!declares(model, "lagrangian")) binding.emplace("lagrangian", hessian_->lagrangian);
    return binding;
}

std::vector<NodeId> EquationsOfMotion::without_stand_ins(const std::vector<NodeId>& nodes)
{
    if (hessian_ == nullptr) return nodes;
    Seeds replacements = {{energy_name_, energy_}};
    for (std::size_t a = 0; a < momentum_names_.size(); ++a)
        replacements.emplace_back(momentum_names_[a], hessian_->momenta[a]);
    return substitute(graph_, nodes, replacements);
}

/// f_y . ydot by Cramer's rule, a block of coupled coordinates at a time.
std::optional<NodeId> EquationsOfMotion::along_accelerations(const std::vector<NodeId>& f_y, std::string& obstacle)
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

Rate EquationsOfMotion::rate(NodeId f)
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
