// SPDX-License-Identifier: GPL-2.0-or-later
/// Variations of E-paths and of the action: what is printed, what is proved of several kinds of algebroids, and what is
/// refuted where the brackets are none of an algebroid.
#include "equations/derive.hpp"
#include "model/read_model.hpp"
#include "support/model_equations.hpp"
#include "typeset/print_equations.hpp"
#include "verify/verify.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

EquationSet variations_of(const std::string& text)
{
    const Model model = read_model_text("test.toml", text);
    const System system = elaborate(model);
    return derive("variations", model, system, verify(system));
}

std::string statuses_of(const EquationSet& equations)
{
    std::string list;
    for (const DecidedStatement& statement : equations.statements) list += statement.status + " ";
    return list;
}

const std::string all_proved = "proved proved proved proved ";

/// A top on the sphere, with `more` of the first section in [e_a, e_b], which should be 0.
std::string spinning_top(const std::string& more)
{
    return "[parameters]\nI1 = 1\nI2 = 2\nI3 = 3\nm = 1\n[base]\ncoordinates = [\"g1\", \"g2\", \"g3\"]\n"
           "[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n[algebroid.anchor]\na = { g2 = \"g3\", g3 = \"-g2\" }\n"
           "b = { g1 = \"-g3\", g3 = \"g1\" }\nc = { g1 = \"g2\", g2 = \"-g1\" }\n[algebroid.bracket]\n"
           "\"a,b\" = { c = 1, a = \"" +
           more +
           "\" }\n\"b,c\" = { a = 1 }\n\"c,a\" = { b = 1 }\n[lagrangian]\nL = \"(I1*a^2 + I2*b^2 + I3*c^2)/2 - "
           "m*g3\"\n";
}

} // namespace

TEST_CASE("variations of a top are those of the paper, and so are Jacobi's equations")
{
    const EquationSet equations = variations_of(spinning_top("0"));
    CHECK(statuses_of(equations) == all_proved);
    const std::string text = print_text(equations);
    INFO(text);
    for (const char* part : {"  δg1 = g2 σ_c - g3 σ_b\n", "  δa = b σ_c - c σ_b + σ̇_a\n", "  δp_a = I1 δa\n",
                             "  d/dt δp_c = (I1 - I2) (a δb + b δa)\n", "  proved     [δ_σ, δ_τ] = δ_[σ, τ]"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(print_latex(equations).find(R"(\delta a &= b\, \sigma^{c} - c\, \sigma^{b} + \dot\sigma^{a})") !=
          std::string::npos);
}

TEST_CASE("variations of a Lagrangian that is neither quadratic nor autonomous are proved, on a frame too")
{
    CHECK(statuses_of(variations_of("[parameters]\nk = 2\n[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\n"
                                    "kind = \"tangent\"\n[lagrangian]\nL = \"(1 + x^2)*v_x^4 + x*v_x*v_y + v_y^2 + "
                                    "sin(t)*v_x - k*cos(x - y)\"\n")) == all_proved);
    const EquationSet plane = variations_of(
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid.anchor]\n"
        "a = { x = \"y\" }\nb = { y = \"y\" }\n[algebroid.bracket]\n\"a,b\" = { a = -1 }\n"
        "[lagrangian]\nL = \"(a^2 + b^2)/2 + x*a\"\n");
    CHECK(statuses_of(plane) == all_proved);
    CHECK(print_text(plane).find("  δa = b σ_a + σ̇_a - a σ_b\n") != std::string::npos);
}

TEST_CASE("where the structure equations fail variations do not close, and critical points are those of EL still")
{
    const EquationSet equations = variations_of(spinning_top("1"));
    CHECK(statuses_of(equations) == "refuted refuted proved refuted ");
    CHECK(!equations.statements[1].witness.empty());
}

TEST_CASE("parameters may have the names of accelerations and variations")
{
    const EquationSet equations =
        variations_of("[parameters]\nf_v_x = 2\n\"σ_v_x\" = 3\n[base]\ncoordinates = [\"x\"]\n[algebroid]\n"
                      "kind = \"tangent\"\n[lagrangian]\nL = \"f_v_x*v_x^2/2 - σ_v_x*x^4\"\n");
    CHECK(statuses_of(equations) == all_proved);
    CHECK(print_text(equations).find("  δx = σ_v_x'\n") != std::string::npos);
}

TEST_CASE("variations of controlled curves stay in an E-homotopy class, and the cost is critical where dH/du = 0")
{
    const auto steered = [](const std::string& more) {
        std::string text = spinning_top(more);
        return variations_of(text.substr(0, text.find("[lagrangian]")) +
                             "[control]\ncontrols = [\"u\"]\nsigma = { a = \"u^2\", b = \"g3*u\", c = 1 }\n"
                             "cost = \"u^4 + g1*u\"\n");
    };
    const EquationSet equations = steered("0");
    CHECK(statuses_of(equations) == "proved proved ");
    const std::string text = print_text(equations);
    INFO(text);
    for (const char* part : {"  δg1 = g2 η_c - g3 η_b\n", "  η̇_a = 2 u δu + η_b - g3 u η_c\n"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(print_latex(equations).find(R"(\dot{\eta^{a}} &= )") != std::string::npos);
    // [e_a, e_b] has more of e_a than its anchor: curves leave the E-paths, and the cost does not see it.
    const EquationSet wrong = steered("1");
    CHECK(statuses_of(wrong) == "refuted proved ");
    CHECK(!wrong.statements[0].witness.empty());
}
