// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/morphism.hpp"

#include "geometry/generator_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/transplant.hpp"

namespace lagen {

namespace {

/// (<-e_a f) at the arrows 1, for every section a of the source.
class AtUnits {
  public:
    AtUnits(Graph& graph, const Groupoid& groupoid)
        : graph_(graph), groupoid_(groupoid), partial_(graph, groupoid.coordinates()),
          one_(identity(graph, groupoid, groupoid.arrow.x))
    {
    }
    [[nodiscard]] std::vector<NodeId> along(std::size_t a, const std::vector<NodeId>& functions)
    {
        std::vector<NodeId> rates;
        for (const NodeId f : functions) rates.push_back(partial_.along(groupoid_.left[a], f));
        return at(graph_, groupoid_, rates, one_);
    }

  private:
    Graph& graph_;
    const Groupoid& groupoid_;
    BaseGradient partial_;
    Arrow one_;
};

std::vector<std::vector<NodeId>> moved(const AlongMap& along, std::vector<std::vector<NodeId>> lists)
{
    for (std::vector<NodeId>& list : lists) list = along(list);
    return lists;
}

} // namespace

AlongMap::AlongMap(Graph& graph, const SystemMorphism& morphism)
    : graph_(graph), target_(morphism.target), inputs_(morphism.parameters)
{
    inputs_[morphism.target.time] = morphism.source.time;
    set(morphism.target.algebroid.x, morphism.base);
}

void AlongMap::set(std::span<const NodeId> inputs, std::span<const NodeId> values)
{
    for (std::size_t k = 0; k < inputs.size(); ++k) inputs_[inputs[k]] = values[k];
}

std::vector<NodeId> AlongMap::operator()(std::span<const NodeId> functions) const
{
    try {
        return transplant(graph_, target_.graph, functions, inputs_);
    } catch (const DivisionByZero&) {
        throw MathematicsError("along the map a divisor of model '" + target_.name + "' is zero everywhere",
                               "nothing of the target is defined there: change `base` or `parameters`");
    }
}

std::vector<NodeId> fibre_matrix(Graph& graph, const SystemMorphism& morphism)
{
    std::vector<NodeId> matrix;
    for (const NodeId each : morphism.fibre) {
        const std::vector<NodeId> row = gradient(graph, each, morphism.source.algebroid.y);
        matrix.insert(matrix.end(), row.begin(), row.end());
    }
    return matrix;
}

std::vector<NodeId> pulled_covector(Graph& graph, const std::vector<NodeId>& matrix, std::size_t r,
                                    const std::vector<NodeId>& f)
{
    std::vector<NodeId> out(r, graph.constant(0));
    for (std::size_t a = 0; a < f.size(); ++a)
        for (std::size_t b = 0; b < r; ++b) out[b] = graph.add(out[b], graph.multiply(matrix[a * r + b], f[a]));
    return out;
}

std::vector<NodeId> applied(Graph& graph, const std::vector<NodeId>& A, std::size_t rows, const std::vector<NodeId>& v)
{
    std::vector<NodeId> out;
    for (std::size_t a = 0; a < rows; ++a) {
        NodeId sum = graph.constant(0);
        for (std::size_t b = 0; b < v.size(); ++b) sum = graph.add(sum, graph.multiply(A[a * v.size() + b], v[b]));
        out.push_back(sum);
    }
    return out;
}

ResidualList morphism_equations(Graph& graph, const SystemMorphism& morphism, const std::vector<NodeId>& matrix)
{
    const Algebroid &from = morphism.source.algebroid, &to = morphism.target.algebroid;
    const std::size_t r = from.r();
    const AlongMap along(graph, morphism);
    BaseGradient partial(graph, from.x);
    const auto Phi = [&](std::size_t a, std::size_t b) { return matrix[a * r + b]; };
    ResidualList list;
    const auto append = [&](const char* name, std::vector<std::size_t> indices, NodeId value) {
        if (graph.is_zero(value))
            ++list.trivial;
        else
            list.residuals.push_back({name, std::move(indices), value});
    };
    for (std::size_t b = 0; b < r; ++b) {
        std::vector<NodeId> moved(to.n(), graph.constant(0)); // rho'(Phi e_b)
        for (std::size_t c = 0; c < to.r(); ++c)
            for (const ColumnEntry& entry : to.anchor[c])
                moved[entry.index] = graph.add(moved[entry.index], graph.multiply(along(entry.value), Phi(c, b)));
        for (std::size_t i = 0; i < to.n(); ++i)
            append("admissible", {b, i}, graph.subtract(moved[i], partial.along(from.anchor[b], morphism.base[i])));
    }
    for (std::size_t b = 0; b < r; ++b)
        for (std::size_t c = b + 1; c < r; ++c) {
            std::vector<NodeId> image(to.r(), graph.constant(0)); // C'(Phi e_b, Phi e_c)
            for (std::size_t d = 0; d < to.r(); ++d)
                for (std::size_t e = 0; e < to.r(); ++e)
                    for (const ColumnEntry& entry : to.C(d, e))
                        image[entry.index] =
                            graph.add(image[entry.index],
                                      graph.multiply(along(entry.value), graph.multiply(Phi(d, b), Phi(e, c))));
            for (std::size_t a = 0; a < to.r(); ++a) {
                NodeId value =
                    graph.subtract(partial.along(from.anchor[b], Phi(a, c)), partial.along(from.anchor[c], Phi(a, b)));
                for (const ColumnEntry& entry : from.C(b, c))
                    value = graph.subtract(value, graph.multiply(Phi(a, entry.index), entry.value));
                append("morphism", {b, c, a}, graph.add(value, image[a]));
            }
        }
    return list;
}

Arrow image_of(Graph& graph, const SystemMorphism& morphism, const Arrow& g)
{
    const Groupoid& from = *morphism.source.groupoid;
    const auto over = [&](const std::vector<NodeId>& x) {
        return substitute(graph, morphism.base, replacements(morphism.source.algebroid.x, x));
    };
    Arrow image;
    image.x = over(g.x);
    if (!morphism.target.groupoid->arrow.next.empty()) image.next = over(target(graph, from, g));
    image.W = at(graph, from, morphism.element, g);
    return image;
}

DerivedFibre derived_fibre(Graph& graph, const SystemMorphism& morphism)
{
    const Groupoid &from = *morphism.source.groupoid, &to = *morphism.target.groupoid;
    const AlongMap along(graph, morphism);
    GroupoidParts parts;
    parts.size = to.size;
    parts.rows = to.rows;
    parts.generators = moved(along, to.generators);
    const std::vector<std::vector<NodeId>> connection = moved(along, to.connection);
    GeneratorSpan span(graph, parts);
    AtUnits units(graph, from);
    const Arrow image = image_of(graph, morphism, from.arrow);

    DerivedFibre result;
    result.matrix.assign(to.r() * from.r(), graph.constant(0));
    for (std::size_t b = 0; b < from.r(); ++b) {
        const std::vector<NodeId> v = units.along(b, image.next);
        for (std::size_t i = 0; i < v.size(); ++i) result.matrix[i * from.r() + b] = v[i];
        if (to.generators.empty()) continue;
        const std::vector<NodeId> Z = units.along(b, image.W); // (xi^c - A_i^c v^i) E_c
        std::vector<NodeId> xi = span.components(Z);
        for (const NodeId value : span.outside(Z, xi))
            if (!graph.is_zero(value)) result.outside.push_back(value);
        for (std::size_t i = 0; i < connection.size(); ++i)
            for (std::size_t c = 0; c < xi.size(); ++c)
                xi[c] = graph.add(xi[c], graph.multiply(connection[i][c], v[i]));
        for (std::size_t c = 0; c < xi.size(); ++c) result.matrix[(to.horizontal() + c) * from.r() + b] = xi[c];
    }
    return result;
}

namespace {

/// y' over x and y, also where the map of arrows alone says it.
std::vector<NodeId> fibre_of(Graph& graph, const SystemMorphism& morphism)
{
    if (!morphism.fibre.empty() || !morphism.of_groupoids) return morphism.fibre;
    return applied(graph, derived_fibre(graph, morphism).matrix, morphism.target.r(), morphism.source.algebroid.y);
}

} // namespace

SystemMorphism composition(const SystemMorphism& first, const SystemMorphism& second)
{
    SystemMorphism both;
    both.source = first.source;
    both.target = second.target;
    Graph& graph = both.source.graph;
    const System &middle = first.target, &start = second.source;
    std::map<NodeId, NodeId> inputs; // of `start`, which is `middle` read a second time
    const auto set = [&](const std::vector<NodeId>& from, const std::vector<NodeId>& to) {
        for (std::size_t k = 0; k < from.size() && k < to.size(); ++k) inputs[from[k]] = to[k];
    };
    set({start.time}, {both.source.time});
    for (std::size_t k = 0; k < start.parameters.size(); ++k)
        inputs[start.parameters[k]] = first.parameters.at(middle.parameters[k]);
    for (std::size_t k = 0; k < start.inputs.size(); ++k)
        inputs[start.inputs[k]] = first.parameters.at(middle.inputs[k]);
    set(start.algebroid.x, first.base);
    both.of_groupoids = first.of_groupoids && second.of_groupoids;
    set(start.algebroid.y, both.of_groupoids ? first.fibre : fibre_of(graph, first));
    if (start.control && !first.controls.empty()) set(start.control->u, first.controls);
    const auto along = [&](const std::vector<NodeId>& nodes) { return transplant(graph, start.graph, nodes, inputs); };
    both.base = along(second.base);
    if (!both.of_groupoids) {
        Graph of_second = start.graph;
        const std::vector<NodeId> fibre = fibre_of(of_second, second);
        both.fibre = transplant(graph, of_second, fibre, inputs);
    } else if (!first.fibre.empty() || middle.r() == 0) {
        both.fibre = along(second.fibre);
    }
    if (!first.controls.empty()) both.controls = along(second.controls);
    for (const auto& [parameter, value] : second.parameters) both.parameters[parameter] = along({value})[0];
    both.free_parameters = first.free_parameters;
    for (const NodeId each : along(second.free_parameters)) both.free_parameters.push_back(each);
    if (!both.of_groupoids) return both;
    const Arrow image = image_of(graph, first, first.source.groupoid->arrow);
    set(start.groupoid->arrow.next, image.next);
    set(start.groupoid->arrow.W, image.W);
    both.element = along(second.element);
    return both;
}

} // namespace lagen
