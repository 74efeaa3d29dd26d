// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/velocity_map.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/nonholonomic.hpp"

namespace lagen {

namespace {

/// All components of a section.
std::vector<NodeId> entries_of(Graph& graph, const Section& section, std::size_t r)
{
    std::vector<NodeId> out(r, graph.constant(0));
    for (const ColumnEntry& entry : section) out[entry.index] = entry.value;
    return out;
}

/// The orthogonal projection of vectors of E' to the span of independent sections, by normal equations.
class Span {
  public:
    Span(Graph& graph, std::vector<std::vector<NodeId>> sections) : graph_(graph), sections_(std::move(sections))
    {
        for (const std::vector<NodeId>& a : sections_)
            for (const std::vector<NodeId>& b : sections_) gram_.push_back(contraction(graph, a, b));
    }
    [[nodiscard]] std::vector<NodeId> weights(const std::vector<NodeId>& v) const
    {
        std::vector<NodeId> right;
        for (const std::vector<NodeId>& a : sections_) right.push_back(contraction(graph_, a, v));
        return graph_.solve(gram_, right, MatrixStructure::symmetric);
    }
    [[nodiscard]] std::vector<NodeId> outside(std::vector<NodeId> v) const
    {
        const std::vector<NodeId> w = weights(v);
        for (std::size_t beta = 0; beta < w.size(); ++beta)
            for (std::size_t a = 0; a < v.size(); ++a)
                v[a] = graph_.subtract(v[a], graph_.multiply(w[beta], sections_[beta][a]));
        return v;
    }

  private:
    Graph& graph_;
    std::vector<std::vector<NodeId>> sections_;
    std::vector<NodeId> gram_;
};

} // namespace

VelocityMap velocity_map(Graph& graph, const SystemMorphism& morphism, const std::vector<NodeId>& matrix)
{
    const System &from = morphism.source, &to = morphism.target;
    VelocityMap map{applied(graph, matrix, to.r(), from.algebroid.y), matrix, {}, {}};
    if (!from.distribution && !to.distribution) return map;
    std::vector<Section> sections;
    for (std::size_t b = 0; b < from.r(); ++b) sections.push_back(basis_section(graph, b));
    Section drift;
    if (from.distribution) {
        map.velocities = applied(graph, matrix, to.r(), constraint_hull(graph, from).Y);
        sections = from.distribution->sections;
        drift = from.distribution->drift;
    }
    if (to.distribution) {
        const AlongMap along(graph, morphism);
        const auto along_map = [&](const Section& section) {
            std::vector<NodeId> out(to.r(), graph.constant(0));
            for (const ColumnEntry& entry : section) out[entry.index] = along(entry.value);
            return out;
        };
        std::vector<std::vector<NodeId>> basis;
        for (const Section& section : to.distribution->sections) {
            basis.push_back(along_map(section));
            map.basis.insert(map.basis.end(), basis.back().begin(), basis.back().end());
        }
        const Span span(graph, std::move(basis));
        const std::vector<NodeId> target_drift = along_map(to.distribution->drift);
        const auto less = [&](std::vector<NodeId> v) {
            for (std::size_t a = 0; a < v.size(); ++a) v[a] = graph.subtract(v[a], target_drift[a]);
            return v;
        };
        const auto image = [&](const Section& section) {
            return applied(graph, matrix, to.r(), entries_of(graph, section, from.r()));
        };
        for (const Section& section : sections) map.outside.push_back(span.outside(image(section)));
        map.outside.push_back(span.outside(less(image(drift))));
        map.velocities = span.weights(less(std::move(map.velocities)));
    }
    map.matrix.clear();
    for (const NodeId each : map.velocities) {
        const std::vector<NodeId> row = gradient(graph, each, from.velocities());
        map.matrix.insert(map.matrix.end(), row.begin(), row.end());
    }
    return map;
}

} // namespace lagen
