// SPDX-License-Identifier: GPL-2.0-or-later
#include "verify/sloped_functions.hpp"

#include "graph/calculus/differentiate.hpp"

namespace lagen {

namespace {

/// x/|x| as sign(x), which has bounds at 0.
std::vector<NodeId> with_signs(Graph& graph, const std::vector<NodeId>& roots)
{
    std::vector<std::pair<NodeId, NodeId>> signs;
    for (const NodeId id : reachable(graph, roots)) {
        if (graph.op(id) != Op::divide) continue;
        const NodeId x = graph.operands(id)[0], modulus = graph.operands(id)[1];
        if (graph.op(modulus) == Op::abs && graph.operands(modulus)[0] == x)
            signs.emplace_back(id, graph.apply(Op::sign, x));
    }
    return signs.empty() ? roots : substitute(graph, roots, signs);
}

} // namespace

SlopedFunctions::SlopedFunctions(Graph& graph, std::vector<NodeId> functions, const std::vector<NodeId>& z)
    : count_(functions.size()), z_(z)
{
    std::vector<std::pair<NodeId, NodeId>> seeds;
    for (const NodeId each : z) {
        along_.push_back(graph.input("along " + graph.input_name(each)));
        seeds.emplace_back(each, along_.back());
    }
    const std::vector<NodeId> slopes = directional(graph, functions, seeds);
    functions.insert(functions.end(), slopes.begin(), slopes.end());
    values_.emplace(graph, with_signs(graph, functions));
}

proof::NewtonEquations SlopedFunctions::at(const std::vector<proof::Ball>& z, slong bits) const
{
    proof::NewtonEquations out{proof::BallMatrix(count_, 1), proof::BallMatrix(count_, z_.size())};
    proof::BallInputs inputs;
    for (std::size_t k = 0; k < z_.size(); ++k) {
        inputs.emplace(z_[k], z[k]);
        inputs.emplace(along_[k], proof::Ball());
    }
    if (z_.empty()) out.value.entries = values_->enclose(inputs, bits);
    for (std::size_t column = 0; column < z_.size(); ++column) {
        inputs.at(along_[column]) = proof::Ball(Rational(1), bits);
        const std::vector<proof::Ball> values = values_->enclose(inputs, bits);
        inputs.at(along_[column]) = proof::Ball();
        for (std::size_t row = 0; row < count_; ++row) {
            out.value.at(row, 0) = values[row];
            out.slope.at(row, column) = values[count_ + row];
        }
    }
    return out;
}

} // namespace lagen
