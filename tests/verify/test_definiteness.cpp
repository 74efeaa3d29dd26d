// SPDX-License-Identifier: GPL-2.0-or-later
/// Definiteness by the sign rule.
#include "expression/parse.hpp"
#include "graph/core/lower.hpp"
#include "verify/definiteness.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// A chain of n links of unit length with masses m: sum_k m_k |sum_(j <= k) v_j (cos th_j, sin th_j)|^2/2 - potential.
std::string chain(int n, const std::string& sign)
{
    std::string text = "-cos(th1)", x, y;
    for (int k = 1; k <= n; ++k) {
        const std::string j = std::to_string(k);
        x += (k > 1 ? " + " : "") + ("cos(th" + j + ")*v" + j);
        y += (k > 1 ? " + " : "") + ("sin(th" + j + ")*v" + j);
        text += " + " + (k == n ? sign : "") + "m" + j + "/2*((" + x + ")^2 + (" + y + ")^2)";
    }
    return text;
}

bool definite(const std::string& lagrangian, int n)
{
    Graph graph;
    ProofSetting setting;
    std::vector<NodeId> velocities;
    for (int k = 1; k <= n; ++k) setting.variables.push_back(graph.input("th" + std::to_string(k)));
    for (int k = 1; k <= n; ++k) velocities.push_back(graph.input("v" + std::to_string(k)));
    setting.variables.insert(setting.variables.end(), velocities.begin(), velocities.end());
    Lowering lower(graph);
    for (int k = 1; k <= n; ++k) {
        const std::string mass = "m" + std::to_string(k);
        setting.parameters.push_back(graph.input(mass));
        setting.domain.push_back(lower(parse_comparison(whole_text("<domain>", mass + " > 0"))));
    }
    const NodeId L = lower(parse_expression(whole_text("<test>", lagrangian)));
    const FibreHessian hessian = fibre_hessian(graph, L, velocities);
    const ZeroDecider decider(graph, setting);
    return proves_definite_by_parts(graph, hessian, decider);
}

} // namespace

TEST_CASE("the mass matrix of a chain of links is positive definite for all positive masses")
{
    CHECK(definite(chain(2, ""), 2));
    CHECK(definite(chain(8, ""), 8));
    CHECK(definite("(m1*v1^2 + m2*(v1 + th1*v2)^2)/2 + v2^2/(1 + th1^2) + v1*th2", 2));
}

TEST_CASE("a square with a negative or a vanishing coefficient, and an indefinite form, show nothing")
{
    CHECK_FALSE(definite(chain(3, "-"), 3));
    CHECK_FALSE(definite("m1*(v1 + v2)^2", 2));
    CHECK_FALSE(definite("m1*v1^2 + th1^2*v2^2", 2));
    CHECK_FALSE(definite("v1*v2", 2));
    CHECK_FALSE(definite("2*v1*v2 + v1^2 + v2^2", 2));
    CHECK_FALSE(definite("3*v1*v2 + v1^2 + v2^2 + v1^4", 2));
    CHECK_FALSE(definite("v1*v2 + v1^2 + v2^2 - v1^4", 2));
    CHECK_FALSE(definite("v1^2 + v2^4", 2));
}

TEST_CASE("products of affine functions make quadratic forms, which count where they are definite")
{
    CHECK(definite("v1*v2 + v1^2 + v2^2", 2));
    CHECK(definite("v1*(2*v1 + v2) + v2*(v1 + 3*v2) + th1*v1 + (v1^2 + v2^2)^2", 2));
    CHECK_FALSE(definite("v1*(2*v1 + v2) + v2*(v1 + 1/3*v2) + (v1^2 + v2^2)^2", 2));
    CHECK(definite("m1*v1^2 + m1*v1*v2 + (m1 + m2)*v2^2", 2));
    CHECK_FALSE(definite("m1*v1^2 + m2*v1*v2 + m1*v2^2", 2));
    // A square in two factors, and the full inertia of a body: w^T J w of w = (v1, v1 th1 + v2)
    CHECK(definite("(cos(th1)*v1 + v2)*(m1*(cos(th1)*v1 + v2)/2) + m2*v1^2", 2));
    CHECK(definite("v1*(2*v1 + (v1*th1 + v2)) + (v1*th1 + v2)*(v1 + 3*(v1*th1 + v2))", 2));
    CHECK(definite("3/4*v1^2/2 + log(3 + th1^2)*v2^2/2 + 1/10*v1*v2", 2));
    CHECK_FALSE(definite("1/10*v1^2/2 + log(3 + th1^2)*v2^2/2 + v1*v2", 2));
}

TEST_CASE("functions of one variable with the right slopes are definite, and those of the wrong sign show nothing")
{
    // -m sqrt(f): W = m/(2 sqrt(f)) (-d2f) + m/(4 sqrt(f)^3) df df^T
    CHECK(definite("-m1*sqrt(1 - v1^2 - v2^2)", 2));
    CHECK(definite("-m1*sqrt(th1 - v1^2 - (v1 + th2*v2)^2/m2) - m2*sqrt(1 - v2^2)", 2));
    CHECK(definite("m1*exp(v1 + v2) + m2*exp(v1 - v2)", 2) == false); // no row with one coordinate
    CHECK(definite("m1*exp(v1 + v2) + m2*v1^2", 2));
    CHECK(definite("(v1^2 + v2^2)^2 + m1*v1^2 + m2*v2^2", 2));
    CHECK(definite("v1^4 + v2^2 + m1/(2 + v1^2)", 2) == false);
    CHECK_FALSE(definite("m1*sqrt(1 - v1^2 - v2^2)", 2));
    CHECK_FALSE(definite("v1^4 + v2^4", 2));
    CHECK_FALSE(definite("v1^2 + v2^2 + v1^2*v2^2", 2));
    CHECK_FALSE(definite("v1^2 + v2^2 - m1*v1^4", 2));
}
