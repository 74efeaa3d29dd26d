// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/algebroid_of.hpp"

#include "geometry/generator_span.hpp"

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
        std::vector<Column> rho, brackets; // of each section; of each pair a < b
        const std::vector<NodeId> t = target(graph_, groupoid_, groupoid_.arrow);
        for (std::size_t a = 0; a < groupoid_.r(); ++a) {
            Column& column = rho.emplace_back();
            for (std::size_t i = 0; i < t.size(); ++i) column.push_back({i, partial_.along(groupoid_.left[a], t[i])});
        }
        for (std::size_t a = 0; a < groupoid_.r(); ++a)
            for (std::size_t b = a + 1; b < groupoid_.r(); ++b)
                brackets.push_back(bracket(partial_, groupoid_.left[a], groupoid_.left[b]));
        move_to_one({&rho, &brackets});
        AlgebroidOfGroupoid result;
        auto pair = brackets.begin();
        for (std::size_t a = 0; a < groupoid_.r(); ++a) {
            for (const ColumnEntry& entry : rho[a]) builder.add_anchor(entry.index, a, entry.value);
            for (std::size_t b = a + 1; b < groupoid_.r(); ++b) read_bracket(builder, result.open, a, b, *pair++);
        }
        result.algebroid = builder.finish(std::move(y));
        return result;
    }

  private:
    /// The values at the arrows 1, by one substitution.
    void move_to_one(std::initializer_list<std::vector<Column>*> lists)
    {
        std::vector<ColumnEntry*> entries;
        for (std::vector<Column>* columns : lists)
            for (Column& column : *columns)
                for (ColumnEntry& entry : column) entries.push_back(&entry);
        std::vector<NodeId> values;
        for (const ColumnEntry* entry : entries) values.push_back(entry->value);
        values = at(graph_, groupoid_, values, one_);
        for (std::size_t k = 0; k < entries.size(); ++k) entries[k]->value = values[k];
    }

    /// Horizontal components stand at x_next; what is left of W is Z = C^c E_c after A is added back.
    void read_bracket(AlgebroidBuilder& builder, std::vector<OpenEntry>& open, std::size_t a, std::size_t b,
                      const Column& field)
    {
        const std::size_t next = groupoid_.n(), W = next + groupoid_.horizontal();
        std::vector<NodeId> Z(groupoid_.arrow.W.size(), graph_.constant(0));
        for (const ColumnEntry& entry : field)
            if (entry.index >= W) Z[entry.index - W] = entry.value;
        for (const ColumnEntry& entry : field) {
            if (entry.index < next || entry.index >= W) continue;
            const std::size_t i = entry.index - next;
            builder.add_bracket(i, a, b, entry.value);
            if (groupoid_.connection.empty()) continue;
            std::vector<NodeId> A = groupoid_.connection[i];
            for (NodeId& each : A) each = graph_.negate(graph_.multiply(entry.value, each));
            Z = span_.outside(std::move(Z), A);
        }
        const std::vector<NodeId> C = span_.components(Z);
        for (std::size_t c = 0; c < C.size(); ++c) builder.add_bracket(groupoid_.horizontal() + c, a, b, C[c]);
        for (const NodeId value : span_.outside(std::move(Z), C))
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
