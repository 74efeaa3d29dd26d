// SPDX-License-Identifier: GPL-2.0-or-later
/// Invariants that are found without help: of which motions which ones, and that nothing that is none is among them.
#include "equations/derive.hpp"
#include "model/read_model.hpp"
#include "support/stages.hpp"
#include "typeset/print_equations.hpp"

#include <catch2/catch.hpp>

#include <sstream>

using namespace lagen;
using Lines = std::vector<std::string>;

namespace {

Lines found_in(const Model& model)
{
    const System system = elaborate(model);
    std::istringstream text(print_text(derive("invariants", model, system, verify(model))));
    Lines lines;
    for (std::string line; std::getline(text, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos) continue;
        if (line[first] == 'F' && line.find(" = ") != std::string::npos) lines.push_back(line.substr(first));
        if (line.find("values of the file") != std::string::npos) lines.push_back("for the file");
    }
    return lines;
}

Lines found(const std::string& model)
{
    return found_in(read_model(LAGEN_SOURCE_DIR "/models/" + model + ".toml"));
}

Lines found_of_text(const std::string& text)
{
    return found_in(read_model_text("test.toml", text));
}

} // namespace

TEST_CASE("momenta, areas and Casimirs of bodies and tops are found, free of parameters")
{
    CHECK(found("rigid_body") == Lines{"F1 = Pi1² + Pi2² + Pi3²"});
    CHECK(found("lagrange_top") == Lines{"F1 = g1 p_w1 + g2 p_w2 + g3 p_w3", "F2 = p_w3"});
    CHECK(found("heavy_top") == Lines{"F1 = g1 p_w1 + g2 p_w2 + g3 p_w3"});
    CHECK(found("kirchhoff") == Lines{"F1 = p_w1 p_v1 + p_w2 p_v2 + p_w3 p_v3", "F2 = p_v1² + p_v2² + p_v3²"});
    CHECK(found("wong") == Lines{"F1 = p_q1² + p_q2² + p_q3²"});
    CHECK(found("spherical_pendulum") == Lines{"F1 = p_v"});
}

TEST_CASE("a component of Laplace's vector is found beside the angular momentum, and not the other, which follows")
{
    // F3 = x p_v² - k x/√(x² + y²) - y p_u p_v has F2² + F3² = k² + 2 H F1².
    CHECK(found("kepler") == Lines{"F1 = x p_v - y p_u", "F2 = k y/√(x² + y²) + x p_u p_v - y p_u²"});
}

TEST_CASE("functions of invariants are none of their own, of whatever degree and with roots and quotients")
{
    const std::string vortices =
        "[base]\ncoordinates = [\"x[1..3]\"]\n[fibre]\ncoordinates = [\"v[1..3]\"]\nmomenta = "
        "[\"y[1..3]\"]\n[algebroid]\nkind = \"tangent\"\n[definitions]\n\"d(i,j)\" = "
        "\"(x[i] - x[j])^2 + (y[i] - y[j])^2\"\n[hamiltonian]\nH = \"-log(d(1,2)) - log(d(2,3)) - "
        "log(d(1,3))\"\n";
    // Three, where F2 F1² and the like were three more.
    CHECK(found_of_text(vortices).size() == 3);
    // Free motion: momenta, areas, and none of their products. Of six dimensions five at most are independent.
    CHECK(found_of_text("[base]\ncoordinates = [\"x[1..3]\"]\n[fibre]\ncoordinates = [\"v[1..3]\"]\n[algebroid]\n"
                        "kind = \"tangent\"\n[lagrangian]\nL = \"dot(v, v)/2 - x[3]\"\n")
              .size() == 4); // beside H
    // The two oscillators below in a plane that turns: their difference of energies is a function of H and one.
    CHECK(found_of_text("[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\n"
                        "kind = \"tangent\"\n[lagrangian]\nL = \"(u^2 + v^2)/2 - 2*x^2 - 3*y^2\"\n")
              .size() == 1);
}

TEST_CASE("a chaotic system has none beside H, and what holds for the values of the file alone says so")
{
    CHECK(found("henon_heiles").empty());
    const auto springs = [](const char* b) {
        return std::string("[parameters]\na = 2\nb = ") + b +
               "\n[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = "
               "\"tangent\"\n[lagrangian]\nL = \"(u^2 + v^2)/2 - (a*x^2 + b*y^2)/2\"\n";
    };
    // Two oscillators keep their energies; with one stiffness the area besides.
    CHECK(found_of_text(springs("5")) == Lines{"F1 = 2 x² + p_u²", "for the file"});
    // F3 = 2 x y + p_u p_v has F3² = F2 (2 H - F2) - 2 F1².
    CHECK(found_of_text(springs("2")) ==
          Lines{"F1 = x p_v - y p_u", "F2 = 2 x² + p_u²", "for the file", "for the file"});
}

TEST_CASE("Casimirs are found as such, and not as combinations with H")
{
    const auto body = [](const std::string& algebra, const std::string& L) {
        return "[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n[algebroid]\nkind = \"lie_algebra\"\nalgebra = \"" +
               algebra + "\"\n[lagrangian]\nL = \"" + L + "\"\n";
    };
    CHECK(found_of_text(body("so(3)", "(a^2 + 2*b^2 + 3*c^2)/2")) == Lines{"F1 = p_a² + p_b² + p_c²"});
    CHECK(found_of_text(body("se(2)", "(a^2 + b^2 + 2*c^2)/2")) == Lines{"F1 = p_b² + p_c²"});
}

TEST_CASE("where L has explicit time, invariants without t are found")
{
    const auto plane = [](const std::string& potential) {
        return "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\nkind = "
               "\"tangent\"\n[lagrangian]\nL = \"(u^2 + v^2)/2 - " +
               potential + "\"\n";
    };
    CHECK(found_of_text(plane("t*x^2/2")) == Lines{"F1 = p_v"});
    CHECK(found_of_text(plane("cos(t)*(x^2 + y^2)")) == Lines{"F1 = x p_v - y p_u"});
    CHECK(found_of_text(plane("t*x*y")).empty());
    // sin(O t) and its multiples are no factors of what is sought: their rates are not those of x and p alone.
    const std::string turning = "[parameters]\nO = 2\n[base]\ncoordinates = [\"q\"]\n[fibre]\ncoordinates = [\"w\"]\n"
                                "[algebroid]\nkind = \"tangent\"\n[definitions]\n"
                                "P = \"[sin(q)*cos(O*t), sin(q)*sin(O*t), cos(q)]\"\n[lagrangian]\n";
    CHECK(found_of_text(turning + "L = \"dot(Dt(P), Dt(P))/2\"\n").empty());
    CHECK(found_of_text(turning + "L = \"dot(Dt(P), Dt(P))/2 + O*sin(O*t)*sin(q)*O*sin(O*t)*sin(q)\"\n").empty());
}

TEST_CASE("without a Hamiltonian in closed form or with forces none are sought")
{
    const std::string line =
        "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = \"tangent\"\n";
    for (const char* rest : {"[lagrangian]\nL = \"v^2/2\"\n[forces]\nv = \"-v\"\n", "[lagrangian]\nL = \"x*v\"\n"})
        CHECK_THROWS_AS(found_of_text(line + rest), MathematicsError);
}

TEST_CASE("where L is regular but for some points invariants are found there, and are said to hold there")
{
    const Model polar = read_model_text("test.toml", "[base]\ncoordinates = [\"r\", \"ph\"]\n[fibre]\ncoordinates = "
                                                     "[\"u\", \"w\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                                                     "L = \"(u^2 + r^2*w^2)/2 - r^4\"\n");
    CHECK(found_in(polar) == Lines{"F1 = p_w"});
    const System system = elaborate(polar);
    const EquationSet set = derive("invariants", polar, system, verify(polar));
    REQUIRE(set.statements.size() == 1);
    CHECK(set.statements[0].formula == "dF1/dt = 0, where L is regular");
}

TEST_CASE("no parameter need be kept from 0 by a domain")
{
    CHECK(found_of_text(
              "[parameters]\nI1 = 5\nI2 = 2\nI3 = 3\n[fibre]\ncoordinates = [\"a\", \"b\", \"c\"]\n[algebroid]\n"
              "kind = \"lie_algebra\"\nalgebra = \"so(3)\"\n[lagrangian]\nL = \"(I1*a^2 + I2*b^2 + I3*c^2)/2\"\n") ==
          Lines{"F1 = p_a² + p_b² + p_c²"});
}
