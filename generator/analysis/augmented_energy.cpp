// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/augmented_energy.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/symplectic.hpp"

namespace lagen {

using proof::Ball;
using proof::BallMatrix;

Doubles middles(const BallMatrix& column)
{
    Doubles out;
    for (const Ball& entry : column.entries) out.push_back(entry.middle());
    return out;
}

Ball exact_ball(double value)
{
    return Ball(Rational(value), AugmentedEnergy::precision);
}

std::vector<Ball> exact_balls(const Doubles& values)
{
    std::vector<Ball> out;
    for (const double value : values) out.push_back(exact_ball(value));
    return out;
}

AugmentedEnergy::AugmentedEnergy(Graph& graph, const System& system, NodeId H, const std::vector<NodeId>& F,
                                 std::vector<NodeId> z)
    : z_(std::move(z))
{
    std::vector<NodeId> roots, first;
    const auto put = [](std::vector<NodeId>& list, const std::vector<NodeId>& more) {
        list.insert(list.end(), more.begin(), more.end());
    };
    std::vector<NodeId> values{H};
    put(values, F);
    for (const NodeId f : values) {
        Nodes nodes{f, gradient(graph, f, z_), {}, {}, {}, {}};
        nodes.curvature = joined_rows(jacobian(graph, nodes.slope, z_));
        for (const NodeId z_k : z_) nodes.flow.push_back(poisson_bracket(graph, system, f, z_k));
        for (const NodeId flow : nodes.flow) nodes.moves.push_back(!graph.is_zero(flow));
        nodes.flow_slope = joined_rows(jacobian(graph, nodes.flow, z_));
        for (std::vector<NodeId>* list : {&roots, &first}) {
            list->push_back(f);
            put(*list, nodes.slope);
        }
        put(roots, nodes.curvature);
        put(roots, nodes.flow);
        put(roots, nodes.flow_slope);
        functions_.push_back(std::move(nodes));
    }
    all_.emplace(graph, roots);
    slopes_.emplace(graph, first);
}

NodeId AugmentedEnergy::slope_node(std::optional<std::size_t> i, std::size_t k) const
{
    return functions_[i ? *i + 1 : 0].slope[k];
}

std::vector<FunctionJet> AugmentedEnergy::at(const std::vector<Ball>& z, slong bits) const
{
    proof::BallInputs inputs;
    for (std::size_t k = 0; k < n(); ++k) inputs.emplace(z_[k], z[k]);
    const std::vector<Ball> values = all_->enclose(inputs, bits);
    std::size_t next = 0;
    const auto take = [&](std::size_t rows, std::size_t columns) {
        BallMatrix out(rows, columns);
        for (Ball& entry : out.entries) entry = values[next++];
        return out;
    };
    std::vector<FunctionJet> jets;
    for (std::size_t f = 0; f < functions_.size(); ++f) {
        const Ball value = values[next++];
        BallMatrix slope = take(n(), 1), curvature = take(n(), n()), flow = take(n(), 1), flow_slope = take(n(), n());
        jets.push_back({value, std::move(slope), std::move(curvature), std::move(flow), std::move(flow_slope)});
    }
    return jets;
}

std::optional<std::vector<std::vector<Rational>>> AugmentedEnergy::exactly_at(const std::vector<Rational>& z) const
{
    proof::ExactInputs inputs;
    for (std::size_t k = 0; k < n(); ++k) inputs.emplace(z_[k], z[k]);
    const std::optional<std::vector<Rational>> values = slopes_->exactly(inputs);
    if (!values) return std::nullopt;
    std::vector<std::vector<Rational>> out;
    for (auto next = values->begin(); next != values->end(); next += static_cast<std::ptrdiff_t>(n() + 1))
        out.emplace_back(next, next + static_cast<std::ptrdiff_t>(n() + 1));
    return out;
}

} // namespace lagen
