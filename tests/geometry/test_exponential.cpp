// SPDX-License-Identifier: GPL-2.0-or-later
/// exp in closed form against its series, its logarithm as conditions, and the momenta of a scheme with exp on SO(3)
/// by the formula of dexp^-1 and by differences.
#include "elaborate/build_groupoid.hpp"
#include "elaborate/elaborate.hpp"
#include "geometry/generator_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/discrete.hpp"
#include "model/read_model.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <array>
#include <cmath>

using namespace lagen;

namespace {

using Numbers = std::vector<long double>;
using Values = std::map<std::string, long double>;
using Vector = std::array<long double, 3>;

System group_system(std::size_t rank, const std::string& group)
{
    return elaborate(
        read_model_text("group.toml", fmt::format("name = \"group\"\n[fibre]\ncoordinates = [\"y[1..{}]\"]\n"
                                                  "[groupoid]\nkind = \"group\"\n{}\n",
                                                  rank, group)));
}

std::string named(const std::string& group)
{
    return "group = \"" + group + "\"";
}

struct GroupExponential {
    explicit GroupExponential(std::size_t rank, const std::string& group) : system(group_system(rank, group))
    {
        std::vector<NodeId> s;
        for (std::size_t c = 0; c < rank; ++c) {
            s.push_back(system.graph.input(fmt::format("s{}", c)));
            values[fmt::format("s{}", c)] = 0.7L * std::sin(1.3L + static_cast<long double>(c));
        }
        exp = closed_exponential(system.graph, system, s);
    }

    [[nodiscard]] Numbers at(const std::vector<NodeId>& nodes) const
    {
        return evaluate<long double>(system.graph, nodes, values);
    }

    System system;
    Exponential exp;
    Values values;
};

/// side A + (side A)^2/2! + ..
Numbers series(const Numbers& A, std::size_t n, long double side)
{
    Numbers sum(n * n, 0), term(n * n, 0);
    for (std::size_t i = 0; i < n; ++i) term[i * (n + 1)] = 1;
    for (int j = 1; j <= 40; ++j) {
        Numbers next(n * n, 0);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t k = 0; k < n; ++k)
                for (std::size_t l = 0; l < n; ++l) next[i * n + l] += side * term[i * n + k] * A[k * n + l] / j;
        term = next;
        for (std::size_t k = 0; k < n * n; ++k) sum[k] += term[k];
    }
    return sum;
}

long double distance(const Numbers& a, const Numbers& b)
{
    REQUIRE(a.size() == b.size());
    long double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

const std::vector<std::pair<std::size_t, std::string>>& groups_with_a_form()
{
    static const std::vector<std::pair<std::size_t, std::string>> groups{
        {1, named("SO(2)")},
        {3, named("SO(3)")},
        {3, named("SU(2)")},
        {3, named("SE(2)")},
        {6, named("SE(3)")},
        {3, named("SO(2,1)")},
        {3, named("SL(2)")},
        {3, named("HEIS(3)")},
        {2, named("AFF(1)")},
        {2, named("R^2")},
        {1, named("GL(1)")},
        {6, named("SO(3) + R^2 + SO(2)")},
        {1, "generators = [[[1, 0], [0, 2]]]"}, // blocks of one row
        {2, "generators = [[[0,1,0,0],[0,0,1,0],[0,0,0,1],[0,0,0,0]], [[0,0,0,1],[0,0,0,0],[0,0,0,0],[0,0,0,0]]]"}};
    return groups;
}

Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// exp(v^) by rows.
Numbers rotation(const Vector& v)
{
    Numbers R = series({0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0}, 3, 1);
    for (const std::size_t k : {0U, 4U, 8U}) R[k] += 1;
    return R;
}

/// v with exp(v^) = W, by the angle.
Vector logarithm(const Numbers& W)
{
    const long double angle = std::acos((W[0] + W[4] + W[8] - 1) / 2), f = angle / (2 * std::sin(angle));
    return {f * (W[7] - W[5]), f * (W[2] - W[6]), f * (W[3] - W[1])};
}

} // namespace

TEST_CASE("exp in closed form is its series")
{
    for (const auto& [rank, group] : groups_with_a_form()) {
        INFO(group);
        GroupExponential each(rank, group);
        REQUIRE(each.exp.block_without.empty());
        const std::size_t n = each.system.groupoid->size;
        const Numbers A = each.at(GeneratorSpan(each.system.graph, *each.system.groupoid).matrix(each.exp.s));
        CHECK(distance(each.at(each.exp.less_one), series(A, n, 1)) < 1e-17L);
        CHECK(distance(each.at(each.exp.inverse_less_one), series(A, n, -1)) < 1e-17L);
        CHECK(distance(series(A, n, 1), Numbers(n * n, 0)) > 0.1L);
    }
}

TEST_CASE("groups of two angles or without a form are refused by the rows of their block")
{
    using Rows = std::vector<std::size_t>;
    CHECK(GroupExponential(6, named("SO(4)")).exp.block_without == Rows{1, 2, 3, 4});
    CHECK(GroupExponential(4, named("GL(2)")).exp.block_without == Rows{1, 2});
    CHECK(GroupExponential(7, named("SO(3) + GL(2)")).exp.block_without == Rows{4, 5});
    CHECK(GroupExponential(2, "generators = [[[1, 0], [0, 2]], [[0, 1], [0, 0]]]").exp.block_without == Rows{1, 2});
}

TEST_CASE("the conditions of a logarithm vanish at exp(A), with the derivatives 1 along W E_c and -D moved back by W")
{
    for (const auto& [rank, group] : groups_with_a_form()) {
        INFO(group);
        GroupExponential each(rank, group);
        Graph& graph = each.system.graph;
        const Groupoid& groupoid = *each.system.groupoid;
        const std::vector<NodeId> f = logarithm_conditions(graph, groupoid, each.exp);
        const std::vector<NodeId> D = right_differential(graph, groupoid, each.exp);
        Numbers W = each.at(each.exp.less_one);
        for (std::size_t k = 0; k < groupoid.size; ++k) W[k * (groupoid.size + 1)] += 1;
        for (std::size_t k = 0; k < W.size(); ++k) each.values[graph.input_name(groupoid.arrow.W[k])] = W[k];
        CHECK(distance(each.at(f), Numbers(rank, 0)) < 1e-17L);
        const std::vector<NodeId> coordinates = groupoid.coordinates();
        for (std::size_t b = 0; b < rank; ++b) {
            // f is 0 at (s, exp(A)): moved along s and along the field D^a_b ->e_a together it stays so.
            std::vector<std::pair<NodeId, NodeId>> left, both{{each.exp.s[b], graph.constant(1)}};
            std::map<NodeId, NodeId> moved;
            for (const ColumnEntry& entry : groupoid.left[b]) left.emplace_back(coordinates[entry.index], entry.value);
            for (std::size_t a = 0; a < rank; ++a)
                for (const ColumnEntry& entry : groupoid.right[a]) {
                    const NodeId term = graph.multiply(D[a * rank + b], entry.value);
                    const auto [place, fresh] = moved.emplace(coordinates[entry.index], term);
                    if (!fresh) place->second = graph.add(place->second, term);
                }
            both.insert(both.end(), moved.begin(), moved.end());
            Numbers unit(rank, 0);
            unit[b] = 1;
            CHECK(distance(each.at(directional(graph, f, left)), unit) < 1e-17L);
            CHECK(distance(each.at(directional(graph, f, both)), Numbers(rank, 0)) < 1e-17L);
        }
    }
}

TEST_CASE("the momenta of the midpoint with exp on SO(3) are dexp^-T of I xi/h, and the slopes of L(log W)")
{
    const Vector I{1.2L, 2.1L, 2.9L}, xi{0.4L, -0.9L, 1.3L};
    const long double h = 0.3L, square = xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2], angle = std::sqrt(square);
    System system = elaborate(read_model_text("body.toml", R"toml(
name = "body"
[fibre]
coordinates = ["w1", "w2", "w3"]
[groupoid]
kind = "group"
group = "SO(3)"
[lagrangian]
L = "(1.2*w1^2 + 2.1*w2^2 + 2.9*w3^2)/2"
[discrete]
step = "h"
scheme = "midpoint"
retraction = "exp"
)toml"));
    REQUIRE(system.discrete->logarithm);
    const ArrowEquations equations = arrow_equations(system.graph, system);
    REQUIRE(equations.unknowns() == 6);
    Values values{{"h", h}};
    const Numbers W = rotation(xi);
    for (std::size_t k = 0; k < 9; ++k) values[system.graph.input_name(system.groupoid->arrow.W[k])] = W[k];
    for (std::size_t c = 0; c < 3; ++c) values[system.graph.input_name(system.discrete->inner[c])] = xi[c];
    const Numbers found = evaluate<long double>(system.graph, equations.momenta, values);
    CHECK(distance(evaluate<long double>(system.graph, equations.stationary, values), Numbers(3, 0)) < 1e-17L);

    Vector p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = I[c] * xi[c] / h;
    const Vector once = cross(xi, p), twice = cross(xi, once);
    const long double f = 1 / square - (1 + std::cos(angle)) / (2 * angle * std::sin(angle));
    const auto lagrangian = [&](std::size_t a, long double s) {
        Vector v{};
        v[a] = s;
        const Numbers R = rotation(v);
        Numbers moved(9, 0);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k) moved[i * 3 + j] += R[i * 3 + k] * W[k * 3 + j];
        const Vector log = logarithm(moved);
        long double sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += I[c] * log[c] * log[c] / (2 * h);
        return sum;
    };
    const long double step = 1e-6L;
    for (std::size_t a = 0; a < 3; ++a) {
        CHECK(std::abs(p[a]) > 1);
        CHECK(std::abs(found[a] - (p[a] + once[a] / 2 + f * twice[a])) < 1e-16L);
        CHECK(std::abs(found[a] - (lagrangian(a, step) - lagrangian(a, -step)) / (2 * step)) < tolerance::difference);
    }
}
