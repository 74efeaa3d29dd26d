// SPDX-License-Identifier: GPL-2.0-or-later
/// Cartan's calculus as laws, on every kind of algebroid.
#include "random_sections.hpp"

#include "geometry/structure_equations.hpp"
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

using namespace lagen;
using testing::Dice;

namespace {

const std::vector<std::string> kinds{
    "spherical_pendulum",        // tangent
    "rigid_body",                // lie_algebra
    "heavy_top",                 // action
    "heavy_top_quasivelocities", // frame
    "satellite",                 // product
    "heavy_top_prolongation",    // prolongation
    "hyperboloids",              // subbundle
    "spherical_pendulum_tilted", // subbundle, with a constraint
    "wong",                      // atiyah of su(2)
    "charged_particle",          // atiyah of U(1)
    "half_plane",                // general
};

struct Calculus {
    System system;
    Graph& graph = system.graph;
    BaseGradient partial;

    explicit Calculus(const std::string& name)
        : system(elaborate(read_model(LAGEN_SOURCE_DIR "/models/" + name + ".toml", {}))),
          partial(system.graph, system.algebroid.x)
    {
    }

    ExteriorForm d(const ExteriorForm& w) { return differential(partial, system.algebroid, w); }
    ExteriorForm lie(const Section& s, const ExteriorForm& w)
    {
        return lie_derivative(partial, system.algebroid, s, w);
    }
    Section commutator(const Section& s, const Section& t) { return bracket(partial, system.algebroid, s, t); }
    NodeId along(const Section& s, NodeId f) { return partial.along(anchor_of(graph, system.algebroid, s), f); }
    NodeId value(const ExteriorForm& w)
    {
        return w.components.empty() ? graph.constant(0) : w.components.begin()->second;
    }
    bool is_zero(const ExteriorForm& w) { return vanishes(graph, system, w); }
    bool equal(const ExteriorForm& v, const ExteriorForm& w) { return is_zero(difference(graph, v, w)); }
};

std::size_t highest_degree(const Calculus& calculus)
{
    return std::min<std::size_t>(calculus.system.r(), 3);
}

} // namespace

TEST_CASE("d d = 0 on forms of every degree")
{
    for (const std::string& name : kinds) {
        INFO(name);
        Calculus E(name);
        Dice dice(1);
        for (std::size_t degree = 0; degree < highest_degree(E); ++degree) {
            const ExteriorForm w = random_form(E.graph, E.system, degree, dice);
            const ExteriorForm dw = E.d(w);
            CHECK(dw.degree == degree + 1);
            CHECK(E.is_zero(E.d(dw)));
        }
    }
}

TEST_CASE("d of a wedge product is an antiderivation")
{
    for (const std::string& name : kinds) {
        INFO(name);
        Calculus E(name);
        Dice dice(2);
        for (std::size_t p = 0; p < 2; ++p)
            for (std::size_t q = 0; q < 2 && p + q < E.system.r(); ++q) {
                const ExteriorForm v = random_form(E.graph, E.system, p, dice),
                                   w = random_form(E.graph, E.system, q, dice);
                const ExteriorForm second = wedge(E.graph, v, E.d(w));
                const ExteriorForm right = sum(E.graph, wedge(E.graph, E.d(v), w),
                                               product(E.graph, E.graph.constant(p % 2 == 0 ? 1 : -1), second));
                CHECK(E.equal(E.d(wedge(E.graph, v, w)), right));
            }
    }
}

TEST_CASE("d of a 1-form on two sections is rho(s) w(t) - rho(t) w(s) - w([s, t])")
{
    for (const std::string& name : kinds) {
        INFO(name);
        Calculus E(name);
        if (E.system.r() < 2) continue;
        Dice dice(3);
        const Section s = random_section(E.graph, E.system, dice), t = random_section(E.graph, E.system, dice);
        const ExteriorForm w = random_form(E.graph, E.system, 1, dice);
        const auto on = [&](const Section& u) { return E.value(contraction(E.graph, u, w)); };
        const NodeId left = E.value(contraction(E.graph, t, contraction(E.graph, s, E.d(w))));
        const NodeId right =
            E.graph.subtract(E.graph.subtract(E.along(s, on(t)), E.along(t, on(s))), on(E.commutator(s, t)));
        CHECK(E.is_zero(function_form(E.graph.subtract(left, right))));
    }
}

TEST_CASE("the Lie derivative is a derivation of contraction: [L_s, i_t] = i_[s, t]")
{
    for (const std::string& name : kinds) {
        INFO(name);
        Calculus E(name);
        Dice dice(4);
        const Section s = random_section(E.graph, E.system, dice), t = random_section(E.graph, E.system, dice);
        for (std::size_t degree = 1; degree <= std::min<std::size_t>(2, E.system.r()); ++degree) {
            const ExteriorForm w = random_form(E.graph, E.system, degree, dice);
            const ExteriorForm left =
                difference(E.graph, E.lie(s, contraction(E.graph, t, w)), contraction(E.graph, t, E.lie(s, w)));
            CHECK(E.equal(left, contraction(E.graph, E.commutator(s, t), w)));
        }
    }
}

TEST_CASE("the Lie derivative commutes with d, and along a bracket it is the commutator: [L_s, L_t] = L_[s, t]")
{
    for (const std::string name : {"rigid_body", "heavy_top", "half_plane", "charged_particle"}) {
        INFO(name);
        Calculus E(name);
        Dice dice(5);
        const Section s = random_section(E.graph, E.system, dice), t = random_section(E.graph, E.system, dice);
        for (std::size_t degree = 0; degree < 2; ++degree) {
            const ExteriorForm w = random_form(E.graph, E.system, degree, dice);
            CHECK(E.equal(E.lie(s, E.d(w)), E.d(E.lie(s, w))));
            const ExteriorForm left = difference(E.graph, E.lie(s, E.lie(t, w)), E.lie(t, E.lie(s, w)));
            CHECK(E.equal(left, E.lie(E.commutator(s, t), w)));
        }
    }
}

TEST_CASE("contraction twice with one section is zero, and is an antiderivation of the wedge product")
{
    Calculus E("heavy_top_prolongation");
    Dice dice(6);
    const Section s = random_section(E.graph, E.system, dice);
    const ExteriorForm v = random_form(E.graph, E.system, 1, dice), w = random_form(E.graph, E.system, 2, dice);
    CHECK(E.is_zero(contraction(E.graph, s, contraction(E.graph, s, w))));
    const ExteriorForm left = contraction(E.graph, s, wedge(E.graph, v, w));
    const ExteriorForm right = difference(E.graph, wedge(E.graph, contraction(E.graph, s, v), w),
                                          wedge(E.graph, v, contraction(E.graph, s, w)));
    CHECK(E.equal(left, right));
    CHECK_FALSE(E.is_zero(left));
}

TEST_CASE("the bracket obeys Leibniz' rule [s, f t] = f [s, t] + rho(s)(f) t and Jacobi's identity")
{
    for (const std::string& name : kinds) {
        INFO(name);
        Calculus E(name);
        Dice dice(7);
        const Section s = random_section(E.graph, E.system, dice), t = random_section(E.graph, E.system, dice);
        const NodeId f = random_function(E.graph, E.system, dice);
        const auto times = [&](NodeId factor, Section section) {
            for (ColumnEntry& entry : section) entry.value = E.graph.multiply(factor, entry.value);
            return section;
        };
        const Column left = E.commutator(s, times(f, t));
        const Column right = sum(E.graph, times(f, E.commutator(s, t)), times(E.along(s, f), t));
        for (const ColumnEntry& entry : difference(E.graph, left, right)) CHECK(E.is_zero(function_form(entry.value)));
    }
    Calculus E("heavy_top");
    Dice dice(8);
    Section s[3];
    for (Section& section : s) section = random_section(E.graph, E.system, dice);
    Column cyclic;
    for (std::size_t k = 0; k < 3; ++k)
        cyclic = sum(E.graph, cyclic, E.commutator(s[k], E.commutator(s[(k + 1) % 3], s[(k + 2) % 3])));
    REQUIRE(cyclic.size() == 3);
    for (const ColumnEntry& entry : cyclic) CHECK(E.is_zero(function_form(entry.value)));
}

TEST_CASE("on so(3) de^3 = -e^1 ^ e^2")
{
    Calculus E("rigid_body");
    const ExteriorForm de3 = E.d(basis_form(E.graph, 2));
    REQUIRE(de3.components.size() == 1);
    CHECK(de3.components.begin()->first == FormIndex{0, 1});
    CHECK(E.graph.value(de3.components.begin()->second) == -1);
}
