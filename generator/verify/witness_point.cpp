// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/witness_point.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr slong precision = 256;

std::optional<Rational> rational(const std::string& text)
{
    Rational value;
    if (text.find_first_not_of("0123456789-/") != std::string::npos || value.set_str(text, 10) != 0)
        return std::nullopt;
    value.canonicalize();
    return value;
}

proof::Ball decimal(const std::string& text)
{
    proof::Ball ball;
    if (arb_set_str(ball.get(), text.c_str(), precision) != 0) {
        arb_indeterminate(ball.get());
        return ball;
    }
    proof::Ball error;
    arb_mul_2exp_si(error.get(), ball.get(), -50);
    arb_add_error(ball.get(), error.get());
    return ball;
}

} // namespace

WitnessPoint::WitnessPoint(Graph& graph, const std::vector<std::pair<std::string, std::string>>& point) : graph_(graph)
{
    for (const auto& [name, text] : point) {
        const NodeId input = graph.input(name);
        const std::optional<Rational> value = rational(text);
        if (value) exact_.emplace(input, *value);
        balls_.emplace(input, value ? proof::Ball(*value, precision) : decimal(text));
    }
}

bool WitnessPoint::may_vanish(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.is_zero(node);
    const proof::Evaluation evaluation(graph_, {node});
    effort_ += evaluation.size() + 1;
    const auto& inputs = evaluation.inputs();
    if (!std::all_of(inputs.begin(), inputs.end(), [&](NodeId input) { return balls_.contains(input); })) return true;
    return !evaluation.enclose(balls_, precision)[0].excludes_zero();
}

std::optional<Rational> WitnessPoint::exactly(NodeId node)
{
    if (graph_.is_constant(node)) return graph_.value(node);
    const proof::Evaluation evaluation(graph_, {node});
    effort_ += evaluation.size() + 1;
    const auto& inputs = evaluation.inputs();
    if (!std::all_of(inputs.begin(), inputs.end(), [&](NodeId input) { return exact_.contains(input); }))
        return std::nullopt;
    const auto values = evaluation.exactly(exact_);
    if (!values) return std::nullopt;
    return (*values)[0];
}

} // namespace lagen
