// SPDX-License-Identifier: GPL-2.0-or-later
/// Leaves of the base: the functions that are constant on them, and steps that stay on them.
#include "analysis/leaf.hpp"

#include "analysis/equilibrium.hpp"
#include "geometry/matrix_logarithm.hpp"
#include "graph/core/evaluate.hpp"
#include "verify/checking.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;

namespace {

struct Leafed {
    System system;
    Graph graph;
    Leaves leaves;

    explicit Leafed(const std::string& text)
        : system(elaborate(read_model_text("test.toml", text + "[lagrangian]\nL = \"0\"\n", {}, choosers()))),
          graph(system.graph), leaves(leaves_of(graph, system))
    {
    }
    [[nodiscard]] std::vector<long double> casimirs_at(const std::vector<double>& x) const
    {
        std::map<std::string, long double> inputs;
        for (std::size_t i = 0; i < system.n(); ++i) inputs[graph.input_name(system.algebroid.x[i])] = x[i];
        return evaluate<long double>(graph, leaves.casimirs, inputs);
    }
    /// After a step of c, by the flow alone.
    [[nodiscard]] std::vector<double> moved(const std::vector<double>& x, const std::vector<double>& c) const
    {
        return LeafSteps(graph, system.algebroid.x, leaves.fields).moved(x, c);
    }
    /// Codimension, and how many functions that are constant there are; none of them moves along a step.
    void check(std::size_t codimension, std::size_t functions, const std::vector<double>& x) const
    {
        CHECK(leaves.codimension == codimension);
        CHECK(leaves.casimirs.size() == functions);
        std::vector<double> c;
        for (std::size_t a = 0; a < leaves.fields.size(); ++a) c.push_back(0.3 + 0.2 * static_cast<double>(a));
        const std::vector<double> there = moved(x, c);
        CHECK(there != x);
        const std::vector<long double> before = casimirs_at(x), after = casimirs_at(there);
        for (std::size_t k = 0; k < before.size(); ++k)
            CHECK(std::abs(after[k] - before[k]) <= 1e-14L * std::max(1.0L, std::abs(before[k])));
    }
};

std::string action(const std::string& base, const std::string& algebra, const std::string& anchor,
                   const std::string& fibre = "\"w[1..3]\"")
{
    return "[base]\ncoordinates = [" + base + "]\n[fibre]\ncoordinates = [" + fibre +
           "]\n[algebroid]\nkind = \"action\"\nalgebra = \"" + algebra + "\"\nanchor = { " + anchor + " }\n";
}

/// Entries of a matrix that no model would begin with.
const std::vector<double> crooked{0.9, -0.2, 0.4, 0.3, 1.1, -0.5, -0.6, 0.2, 0.8};

} // namespace

TEST_CASE("a matrix that turns from the right keeps R R^T, and one from the left R^T R")
{
    for (const bool right : {true, false}) {
        const Leafed model(action("\"R[1..3,1..3]\"", "so(3)", right ? "R = \"R*hat(w)\"" : "R = \"-hat(w)*R\""));
        model.check(6, 6, crooked);
        // Each is a combination of the entries of R R^T (R^T R): constant where R turns from the side of the anchor.
        std::vector<double> flipped(9); // R diag(1, -1, -1), or diag(1, -1, -1) R
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                flipped[3 * i + j] = crooked[3 * i + j] * ((right ? j : i) > 0 ? -1 : 1);
        const std::vector<long double> here = model.casimirs_at(crooked), there = model.casimirs_at(flipped);
        for (std::size_t k = 0; k < here.size(); ++k) CHECK(std::abs(here[k] - there[k]) < 1e-14L);
    }
}

TEST_CASE("places in space, directions, quaternions and matrices of determinant 1 have the functions of their groups")
{
    std::vector<double> pose = crooked;
    pose.insert(pose.end(), {0.1, 2, -3});
    Leafed(
        action("\"R[1..3,1..3]\", \"x[1..3]\"", "se(3)", "R = \"R*hat(w)\", x = \"R*v\"", "\"w[1..3]\", \"v[1..3]\""))
        .check(6, 6, pose);
    Leafed(action("\"g[1..3]\"", "so(3)", "g = \"cross(g, w)\"")).check(1, 1, {0.1, 0.7, -2});
    const Leafed quaternion(action("\"q[1..4]\"", "so(3)",
                                   "q = \"[-q[2]*w[1]-q[3]*w[2]-q[4]*w[3], q[1]*w[1]-q[4]*w[2]+q[3]*w[3], "
                                   "q[4]*w[1]+q[1]*w[2]-q[2]*w[3], -q[3]*w[1]+q[2]*w[2]+q[1]*w[3]]/2\""));
    quaternion.check(1, 1, {0.5, 0.1, 0.7, -2});
    Leafed("[base]\ncoordinates = [\"a\", \"b\", \"c\", \"d\"]\n[fibre]\ncoordinates = [\"h\", \"e\", \"f\"]\n"
           "[algebroid]\nkind = \"action\"\nalgebra = \"sl(2)\"\n[algebroid.anchor]\n"
           "a = \"a*h + b*f\"\nb = \"a*e - b*h\"\nc = \"c*h + d*f\"\nd = \"c*e - d*h\"\n")
        .check(1, 1, {1, 0.4, 0.3, 1.2});
}

TEST_CASE("a step along the leaf is the group's, in all digits of a double")
{
    const Leafed model(action("\"R[1..3,1..3]\"", "so(3)", "R = \"R*hat(w)\""));
    const std::vector<double> c{0.3, -2, 1.1}, found = model.moved(crooked, c);
    // R exp(hat(c)) = R (1 + sin|c|/|c| hat(c) + (1 - cos|c|)/|c|^2 hat(c)^2)  [Rodrigues]
    const long double a = std::hypot(c[0], c[1], c[2]);
    const RealMatrix hat{0, -c[2], c[1], c[2], 0, -c[0], -c[1], c[0], 0}, square = times(hat, hat, 3);
    RealMatrix turn(9);
    for (std::size_t k = 0; k < 9; ++k)
        turn[k] = (k % 4 == 0 ? 1 : 0) + std::sin(a) / a * hat[k] + (1 - std::cos(a)) / (a * a) * square[k];
    const RealMatrix wanted = times({crooked.begin(), crooked.end()}, turn, 3);
    for (std::size_t k = 0; k < 9; ++k) CHECK(found[k] == Approx(static_cast<double>(wanted[k])).margin(4e-16));
}

TEST_CASE("leaves without a function that is found are known by their fields")
{
    const auto general = [](const std::string& anchor) {
        return Leafed("[base]\ncoordinates = [\"x\", \"z\"]\n[fibre]\ncoordinates = [\"y\"]\n[algebroid]\nkind = "
                      "\"general\"\n[algebroid.anchor]\ny = {" +
                      anchor + "}\n");
    };
    general("x = \"1\", z = \"sqrt(2)\"").check(1, 0, {1, 2}); // a line that lies densely on a torus
    general("x = \"x\", z = \"z\"").check(1, 0, {1, 2});       // z/x is no polynomial
    general("x = \"x\", z = \"-z\"").check(1, 1, {1, 2});      // x z
    general("x = \"1\", z = \"cos(x)\"").check(1, 1, {1, 2});  // z - sin(x)
    general("x = \"1\", z = \"5/2\"").check(1, 1, {1, 2});
}

TEST_CASE("declared functions stand for those that would be found, and an open leaf needs none")
{
    const std::string sphere = action("\"g[1..3]\"", "so(3)", "g = \"cross(g, w)\"");
    const std::string place = "coordinates = [\"g[1..3]\"]\n";
    const auto with = [&](const std::string& line) {
        std::string text = sphere;
        return text.replace(text.find(place), place.size(), place + line);
    };
    const Leafed declared(with("casimirs = { size = \"dot(g, g)^2\" }\n"));
    CHECK(declared.leaves.casimirs == declared.system.functions.casimirs);
    const Leafed constrained(with("constraints = [\"dot(g, g) - 1\"]\n"));
    CHECK(constrained.leaves.constraints.size() == 1);
    CHECK(constrained.leaves.casimirs.empty());
    const Leafed plane("[base]\ncoordinates = [\"x\", \"z\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\n"
                       "kind = \"tangent\"\n");
    CHECK(plane.leaves.codimension == 0);
    CHECK(plane.leaves.casimirs.empty());
}

TEST_CASE("an equilibrium is on the leaf of its start, whether or not a function tells")
{
    // x' = y, z' = sqrt(2) y, y' = -(x + z) - y: all of x + z = 0 is at rest, and the line through the start meets it
    // once. The nearest point of it is another.
    Graph graph;
    const NodeId x = graph.input("x"), z = graph.input("z"), y = graph.input("y"),
                 root = graph.apply(Op::sqrt, graph.constant(2));
    MotionEquations equations;
    equations.state = {x, z, y};
    equations.rates = {y, graph.multiply(root, y), graph.negate(graph.add(graph.add(x, z), y))};
    equations.base = {x, z};
    equations.fields = {{graph.constant(1), root}};
    const Equilibrium found = equilibrium_near(graph, equations, {{{1, 2, 0}, {}, {}}});
    const double c = -3 / (1 + std::sqrt(2.0)); // x = 1 + c, z = 2 + sqrt(2) c
    CHECK(found.at.state[0] == Approx(1 + c).epsilon(1e-14));
    CHECK(found.at.state[1] == Approx(2 + std::sqrt(2.0) * c).epsilon(1e-14));
    CHECK(found.leaf_kept == LeafKept::in_floating_point);
    CHECK_FALSE(found.certified);
    REQUIRE(found.leaf.size() == 1);
    CHECK(found.leaf[0][0] == Approx(-std::sqrt(2.0) * found.leaf[0][1]));
    // With the function sqrt(2) x - z it is certified.
    equations.casimirs = {
        graph.subtract(graph.subtract(graph.multiply(root, x), z), graph.subtract(root, graph.constant(2)))};
    const Equilibrium certified = equilibrium_near(graph, equations, {{{1, 2, 0}, {}, {}}});
    CHECK(certified.certified);
    CHECK(certified.at.state[0] == Approx(1 + c).epsilon(1e-15));
}

TEST_CASE("an equilibrium that is on a smaller leaf than the start says so")
{
    Graph graph; // x' = x y, y' = -y - 1: x = 0 is a leaf of its own
    const NodeId x = graph.input("x"), y = graph.input("y");
    MotionEquations equations;
    equations.state = {x, y};
    equations.rates = {graph.multiply(x, y), graph.subtract(graph.constant(-1), y)};
    equations.base = {x};
    equations.fields = {{x}};
    const Equilibrium found = equilibrium_near(graph, equations, {{{0.5, 0}, {}, {}}});
    CHECK(found.at.state[0] == 0);
    CHECK(found.leaf_kept == LeafKept::approached);
}
