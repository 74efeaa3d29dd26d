// SPDX-License-Identifier: GPL-2.0-or-later
#include "groupoid/algebroid_of.hpp"

#include "groupoid/generator_span.hpp"

namespace lagen {

namespace {

class AlgebroidReader {
  public:
    AlgebroidReader(Graph& graph, const Groupoid& groupoid)
        : graph_(graph), groupoid_(groupoid), partial_(graph, groupoid.coordinates()),
          one_(identity(graph, groupoid, groupoid.arrow.x)), span_(graph, groupoid)
    {
    }

    AlgebroidOfGroupoid run(std::vector<NodeId> y)
    {
        AlgebroidBuilder builder(graph_, groupoid_.arrow.x, groupoid_.r());
        const std::vector<NodeId> t = target(graph_, groupoid_, groupoid_.arrow);
        for (std::size_t a = 0; a < groupoid_.r(); ++a) {
            std::vector<NodeId> rho;
            for (const NodeId f : t) rho.push_back(partial_.along(groupoid_.left[a], f));
            rho = at(graph_, groupoid_, rho, one_);
            for (std::size_t i = 0; i < rho.size(); ++i) builder.add_anchor(i, a, rho[i]);
        }
        AlgebroidOfGroupoid result;
        for (std::size_t a = 0; a < groupoid_.r(); ++a)
            for (std::size_t b = a + 1; b < groupoid_.r(); ++b) read_bracket(builder, result.open, a, b);
        result.algebroid = builder.finish(std::move(y));
        return result;
    }

  private:
    /// [<-e_a, <-e_b] at the arrows 1, by all coordinates.
    [[nodiscard]] std::vector<NodeId> bracket_at_one(std::size_t a, std::size_t b)
    {
        const std::size_t count = groupoid_.n() + groupoid_.arrow.next.size() + groupoid_.arrow.W.size();
        std::vector<NodeId> dense(count, graph_.constant(0));
        for (const ColumnEntry& entry : bracket(partial_, groupoid_.left[a], groupoid_.left[b]))
            dense[entry.index] = entry.value;
        return at(graph_, groupoid_, dense, one_);
    }

    /// Horizontal components stand at x_next; what is left of W is Z = C^c E_c after A is added back.
    void read_bracket(AlgebroidBuilder& builder, std::vector<OpenEntry>& open, std::size_t a, std::size_t b)
    {
        const std::vector<NodeId> field = bracket_at_one(a, b);
        const auto next = field.begin() + static_cast<std::ptrdiff_t>(groupoid_.n());
        std::vector<NodeId> Z(next + static_cast<std::ptrdiff_t>(groupoid_.horizontal()), field.end());
        for (std::size_t i = 0; i < groupoid_.horizontal(); ++i) {
            const NodeId C = next[static_cast<std::ptrdiff_t>(i)];
            builder.add_bracket(i, a, b, C);
            if (groupoid_.connection.empty()) continue;
            std::vector<NodeId> A = groupoid_.connection[i];
            for (NodeId& each : A) each = graph_.negate(graph_.multiply(C, each));
            Z = span_.outside(Z, A);
        }
        const std::vector<NodeId> C = span_.components(Z);
        for (std::size_t c = 0; c < C.size(); ++c) builder.add_bracket(groupoid_.horizontal() + c, a, b, C[c]);
        for (const NodeId value : span_.outside(Z, C))
            if (!graph_.is_zero(value)) open.push_back({a, b, value});
    }

    Graph& graph_;
    const Groupoid& groupoid_;
    BaseGradient partial_;
    Arrow one_;
    GeneratorSpan span_;
};

} // namespace

AlgebroidOfGroupoid algebroid_of(Graph& graph, const Groupoid& groupoid, std::vector<NodeId> y)
{
    return AlgebroidReader(graph, groupoid).run(std::move(y));
}

} // namespace lagen
