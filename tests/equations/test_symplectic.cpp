// SPDX-License-Identifier: GPL-2.0-or-later
/// The symplectic sections of models in continuous time and the Poisson bracket: what is printed, what is proved of
/// every kind, and what is refuted where the bracket is none.
#include "equations/derive.hpp"
#include "expression/parse.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/symplectic.hpp"
#include "model/read_model.hpp"
#include "support/model_equations.hpp"
#include "typeset/print_equations.hpp"
#include "verify/verify.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

EquationSet derived_from(const std::string& form, const std::string& text,
                         const std::vector<std::string>& brackets = {})
{
    const Model model = read_model_text("test.toml", text);
    const System system = elaborate(model);
    std::vector<Tree> functions;
    for (const std::string& each : brackets)
        functions.push_back(model.observer.close(parse_expression(whole_text("<test>", each))));
    return derive(form, model, system, verify(system), functions);
}

Lines statuses(const EquationSet& equations)
{
    Lines lines;
    for (const DecidedStatement& statement : equations.statements) lines.push_back(statement.status);
    return lines;
}

const std::string yes = "proved", no = "refuted", open = "undecided";

/// A top on the sphere, with `more` of the first section in [e_a, e_b], which should be 0.
std::string top(const std::string& more)
{
    return "[parameters]\nI1 = 1\nI2 = 2\nI3 = 3\nm = 1\n[base]\ncoordinates = [\"g1\", \"g2\", \"g3\"]\n"
           "[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n[algebroid.anchor]\na = { g2 = \"g3\", g3 = \"-g2\" }\n"
           "b = { g1 = \"-g3\", g3 = \"g1\" }\nc = { g1 = \"g2\", g2 = \"-g1\" }\n[algebroid.bracket]\n"
           "\"a,b\" = { c = 1, a = \"" +
           more +
           "\" }\n\"b,c\" = { a = 1 }\n\"c,a\" = { b = 1 }\n[lagrangian]\nL = \"(I1*a^2 + I2*b^2 + I3*c^2)/2 - "
           "m*g3\"\n";
}

/// Quadratic with a coupling, forces, time, a linear term and a Hessian that depends on x.
const std::string driven =
    "[parameters]\nk = 2\n[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n"
    "[lagrangian]\nL = \"(1 + x^2)*v_x^2/2 + x*v_x*v_y + v_y^2 + sin(t)*v_x - k*cos(x - y)\"\n"
    "[forces]\nv_y = \"-v_y^3\"\n";

} // namespace

TEST_CASE("the Cartan sections of a heavy top are those of the paper")
{
    const EquationSet equations = derived_from("cartan", top("0"));
    CHECK(statuses(equations) == Lines{yes, yes, yes, yes, yes, yes});
    const std::string text = print_text(equations);
    INFO(text);
    for (const char* part : {"  θ_L(X_a) = I1 a\n", "  ω_L(X_a, X_b) = I3 c\n", "  ω_L(X_a, X_c) = -I2 b\n",
                             "  ω_L(X_a, V_a) = I1\n", "  E_L = I1 a²/2 + I2 b²/2 + I3 c²/2 + m g3\n",
                             "  e_aᶜ(V_b) = c\n", "  e_aᶜ(V_c) = -b\n", "  proved     i_Γ ω_L = dE_L  for Γ"})
        CHECK(text.find(part) != std::string::npos);
    CHECK(print_latex(equations).find(R"(\omega_L(X_{a}, V_{a}) &= I_{1})") != std::string::npos);
}

TEST_CASE("forces and explicit time stand in the equations of the symplectic section")
{
    const EquationSet equations = derived_from("cartan", driven);
    CHECK(statuses(equations) == Lines{yes, yes, yes, yes, yes, yes});
    CHECK(equations.statements[1].formula.starts_with("i_Γ ω_L = dE_L - Q_a X^a + ∂p_a/∂t X^a  for"));
    CHECK(equations.statements[2].formula == "d_Γ θ_L = dL + Q_a X^a - ∂p_a/∂t X^a");
}

TEST_CASE("where Jacobi's identity fails the lifts are no morphism and the bracket is not Poisson's")
{
    const EquationSet cartan = derived_from("cartan", top("1"));
    CHECK(statuses(cartan) == Lines{yes, yes, yes, no, yes, yes});
    CHECK(!cartan.statements[3].witness.empty());
    CHECK(std::abs(cartan.statements[3].value) > 0);
    const EquationSet poisson = derived_from("poisson", top("1"));
    CHECK(statuses(poisson) == Lines{no, yes, yes, yes});
    CHECK(poisson.statements[0].component == Lines{"p_a", "p_b", "g2"});
    CHECK(!poisson.statements[0].witness.empty());
    CHECK(statuses(derived_from("poisson", top("0"))) == Lines{yes, yes, yes, yes});
}

TEST_CASE("whether omega_L is symplectic is what is known of its Hessian")
{
    const std::string plane = "[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n";
    const EquationSet degenerate = derived_from("cartan", plane + "L = \"(v_x + v_y)^2/2 - x^2\"\n");
    CHECK(degenerate.statements.back().status == no);
    CHECK(degenerate.statements.back().evidence == "W has rank 1 of 2");
    const EquationSet generic = derived_from("cartan", plane + "L = \"x*v_x^2/2 + v_y^2/2\"\n");
    CHECK(generic.statements.back().status == open);
    CHECK(generic.statements.back().evidence == "at almost all points; not where x = 0");
    CHECK(statuses(generic) == Lines{yes, yes, yes, yes, yes, open});
}

TEST_CASE("the bracket of functions is that of coordinates, and {F, G} = -Omega(X_F, X_G)")
{
    const std::string kepler =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\n"
        "kind = \"tangent\"\n[lagrangian]\nL = \"(u^2 + v^2)/2 + 1/sqrt(x^2 + y^2)\"\n";
    const EquationSet equations =
        derived_from("poisson", kepler, {"x*p_v - y*p_u", "(p_u^2 + p_v^2)/2 - 1/sqrt(x^2 + y^2)", "p_u", "x^2*y"});
    CHECK(statuses(equations) == Lines{yes, yes, yes, yes, yes, yes});
    const std::string text = print_text(equations);
    INFO(text);
    CHECK(text.find("  {F, G} = 0\n") != std::string::npos);
    CHECK(text.find("{F2, G2} = 2 x y\n") != std::string::npos);
    const EquationSet body =
        derived_from("poisson", top("0"), {"p_a*g1 + p_b*g2 + p_c*g3", "p_a^2*g2", "p_a", "p_b*g3"});
    const std::string brackets = print_text(body);
    INFO(brackets);
    CHECK(brackets.find("  {F, G} = 0\n") != std::string::npos);
    CHECK(brackets.find("{F2, G2} = g3 p_c - g2 p_b\n") != std::string::npos);
    CHECK(statuses(body) == Lines{yes, yes, yes, yes, yes, yes});
}

TEST_CASE("a sign that is wrong in omega_L or in X_H is seen on the graph")
{
    System system = elaborate(read_model_text("test.toml", top("0")));
    Graph& graph = system.graph;
    const LagrangianNodes lagrangian = lagrangian_nodes(graph, system);
    const SymplecticForms forms = lagrangian_forms(graph, system, lagrangian);
    BaseGradient partial(graph, forms.prolongation.x);
    const std::map<std::string, double> values{{"a", 0.3},   {"b", -0.7}, {"c", 1.1}, {"g1", 0.2}, {"g2", 0.5},
                                               {"g3", -0.4}, {"I1", 1},   {"I2", 2},  {"I3", 3},   {"m", 1}};
    const ExteriorForm d_theta = differential(partial, forms.prolongation, forms.theta);
    for (const auto& [index, value] : forms.omega.components) {
        const NodeId nodes[] = {value, d_theta.components.at(index)};
        const std::vector<double> numbers = evaluate<double>(graph, nodes, values);
        CHECK(numbers[0] != 0);
        CHECK(numbers[0] == Approx(-numbers[1]));
    }
    // i_{X_F} Omega = dF of F = mu_a g2: X_F has gdot = rho_a g2 in no place, and {F, g3} = rho^3_a g2 = -g2^2.
    const SymplecticForms canonical = canonical_forms(graph, system);
    const NodeId F = graph.multiply(system.mu[0], system.algebroid.x[1]);
    const NodeId bracket = poisson_bracket(graph, system, F, system.algebroid.x[2]);
    CHECK(evaluate<double>(graph, {&bracket, 1}, values)[0] == Approx(-0.25));
    const Section X_F = hamiltonian_section(graph, system, F);
    REQUIRE(X_F.size() >= 1);
    CHECK(X_F[0].index == 0);
    CHECK(evaluate<double>(graph, {&X_F[0].value, 1}, values)[0] == Approx(0.5));
}

TEST_CASE("Pontryagin's equations are those of a section along the projection to E*")
{
    const std::string turning = "[base]\ncoordinates = [\"x\", \"y\", \"h\"]\n[fibre]\ncoordinates = [\"a\", \"b\", "
                                "\"c\"]\n[algebroid.anchor]\na = { x = \"cos(h)\", y = \"sin(h)\" }\nb = { h = 1 }\n"
                                "c = { x = \"-sin(h)\", y = \"cos(h)\" }\n[algebroid.bracket]\n\"a,b\" = { c = -1 }\n"
                                "\"b,c\" = { a = -1 }\n[control]\ncontrols = [\"u\", \"w\"]\n"
                                "sigma = { a = \"u*w\", b = \"w + x\" }\ncost = \"u^4 + w^2*y\"\n";
    const EquationSet equations = derived_from("poisson", turning, {});
    CHECK(statuses(equations) == Lines{yes, yes, yes});
    CHECK(equations.statements[2].formula.starts_with("i_{σ_H} Ω = dH - (∂H/∂u^A) du^A"));
}
