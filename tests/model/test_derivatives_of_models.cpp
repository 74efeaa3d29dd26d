// SPDX-License-Identifier: GPL-2.0-or-later
/// Dt along the anchor of every kind, derivatives in the blocks of a model, anchors by rates, forces by index.
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

using lagen::Model;
using lagen::to_text;

namespace {

Model model_of(const std::string& text)
{
    return lagen::read_model_text("test.toml", text);
}

/// What L closes to with these lines before it.
std::string lagrangian_of(const std::string& blocks, const std::string& L)
{
    return to_text(model_of(blocks + "\n[lagrangian]\nL = \"" + L + "\"\n").lagrangian);
}

std::string diagnostic_of(const std::string& text)
{
    try {
        (void)model_of(text);
    } catch (const lagen::ModelError& error) {
        return error.diagnostic().message + "; " + error.diagnostic().hint;
    }
    return "accepted";
}

std::string texts_of(const std::vector<lagen::ComponentEntry>& entries)
{
    std::string out;
    for (const lagen::ComponentEntry& entry : entries)
        out += (out.empty() ? "" : "; ") + std::to_string(entry.section) + " " + to_text(entry.value);
    return out;
}

std::string anchor_of(const lagen::AlgebroidBlock& block)
{
    std::string out;
    for (const lagen::AnchorEntry& entry : block.anchor)
        out += (out.empty() ? "" : "; ") + std::to_string(entry.section) + "," + std::to_string(entry.coordinate) +
               " " + to_text(entry.value);
    return out;
}

const std::string pole =
    "[parameters]\nl = 2\n[base]\ncoordinates = [\"x\", \"th\"]\n[algebroid]\nkind = \"tangent\"\n";
const std::string sphere = "[base]\ncoordinates = [\"g[1..3]\"]\n[fibre]\ncoordinates = [\"w[1..3]\"]\n";

} // namespace

TEST_CASE("Dt of positions is what a person would write on a tangent bundle")
{
    CHECK(lagrangian_of(pole, "dot(Dt([x, 0]), Dt([x, 0]))/2") == "v_x^2/2");
    CHECK(lagrangian_of(pole, "Dt(l*sin(th))") == "l*cos(th)*v_th");
    CHECK(lagrangian_of(pole + "[definitions]\nX = \"[x + l*sin(th), -l*cos(th)]\"\n\"speed(q)\" = \"norm(Dt(q))\"",
                        "speed(X)") == "sqrt((v_x + l*cos(th)*v_th)^2 + (l*sin(th)*v_th)^2)");
    CHECK(lagrangian_of(pole, "Dt(x*sin(t))") == "sin(t)*v_x + x*cos(t)");
    CHECK(lagrangian_of("[base]\ncoordinates = [\"x\", \"k\"]\n[algebroid]\nkind = \"tangent\"\nover = [\"x\"]",
                        "Dt(k*x)") == "k*v_x");
}

TEST_CASE("Dt follows the anchor of whatever kind the algebroid has")
{
    const std::string by_rows = sphere + "[algebroid]\nkind = \"action\"\nalgebra = \"so(3)\"\n"
                                         "anchor = { \"w[1]\" = { \"g[2]\" = \"g[3]\", \"g[3]\" = \"-g[2]\" } }";
    CHECK(lagrangian_of(by_rows, "Dt(g[1]*g[2])") == "g[1]*g[3]*w[1]");
    const std::string by_matrices =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"w\"]\n[algebroid]\nkind = \"action\"\n"
        "algebra = \"R^1\"\nrepresentation = [[[0, -1], [1, 0]]]";
    CHECK(lagrangian_of(by_matrices, "Dt(x)") == "y*w"); // -(A x), the sign of an entry folded
    CHECK(lagrangian_of(by_matrices, "Dt(y)") == "-x*w");
    const std::string atiyah = "[base]\ncoordinates = [\"r\"]\n[fibre]\ncoordinates = [\"u\", \"w\"]\n[algebroid]\n"
                               "kind = \"atiyah\"\nalgebra = \"R^1\"";
    CHECK(lagrangian_of(atiyah, "Dt(r^2)") == "2*r*u");
    const std::string frame =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\n"
        "kind = \"frame\"\nsections = { a = { v_x = \"x\" }, b = { v_x = 1, v_y = 1 } }\n"
        "of = { kind = \"tangent\" }";
    CHECK(lagrangian_of(frame, "Dt(x) - v_x + Dt(y)") == "x*a + b - (x*a + b) + b");
    const std::string leaf = "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"w\"]\n[algebroid]\n"
                             "kind = \"subbundle\"\nspanned_by = { w = { x = \"-y\", y = \"x\" } }";
    CHECK(lagrangian_of(leaf, "Dt(x*y)") == "y*-y*w + x*x*w");
    const std::string blade = "[base]\ncoordinates = [\"x\", \"y\", \"th\"]\n[fibre]\ncoordinates = [\"u\", \"w\"]\n"
                              "[algebroid]\nkind = \"nonholonomic\"\nsections = { u = { v_x = \"cos(th)\", v_y = "
                              "\"sin(th)\" }, w = { v_th = 1 } }\nof = { kind = \"tangent\" }";
    CHECK(lagrangian_of(blade, "Dt(x)^2") == "v_x^2");
    CHECK(lagrangian_of("[groupoid]\nkind = \"pair\"\n[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"v\"]",
                        "Dt(x)") == "v");
    CHECK(lagrangian_of("[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"prolongation\"\nbundle = \"E\"\n"
                        "of = { kind = \"tangent\" }",
                        "Dt(x)*Dt(v_x)") == "X_v_x*V_v_x");
}

TEST_CASE("a constraint may be a rate: no slip is Dt of a contact point")
{
    const Model model =
        model_of("[parameters]\nr = 1\n[base]\ncoordinates = [\"x\", \"phi\"]\n[fibre]\ncoordinates = "
                 "[\"v_phi\"]\n[algebroid]\nkind = \"nonholonomic\"\nconstraints = [\"Dt(x - r*phi)\"]\n"
                 "of = { kind = \"tangent\" }\n[lagrangian]\nL = \"v_x^2/2\"\n");
    REQUIRE(model.algebroid.constraints.size() == 1);
    CHECK(to_text(model.algebroid.constraints[0]) == "v_x - r*v_phi");
}

TEST_CASE("L is differentiated in observables, definitions in forces and H")
{
    const Model model =
        model_of(pole + "[definitions]\nV = \"l*cos(th)\"\nkinetic = \"v_th^2*x^2/2\"\n"
                        "[lagrangian]\nL = \"kinetic - V\"\n[forces]\nv_th = \"diff(V, th) - min(x, 1)\"\n"
                        "[observables]\npush = \"diff(lagrangian, v_th)\"\nslopes = \"grad(V, [x, th])\"\n"
                        "speed = \"norm(Dt([x, th]))\"\n");
    CHECK(texts_of(model.forces) == "1 -l*sin(th) - min(x, 1)");
    REQUIRE(model.observables.size() == 4);
    CHECK(to_text(model.observables[0].value) == "2*v_th*x^2/2");
    CHECK(to_text(model.observables[1].value) == "0");
    CHECK(to_text(model.observables[2].value) == "-l*sin(th)");
    CHECK(to_text(model.observables[3].value) == "sqrt(v_x^2 + v_th^2)");
}

TEST_CASE("what has no rate in the model is refused by name, and so is what is put in later")
{
    CHECK(
        diagnostic_of(pole + "[lagrangian]\nL = \"Dt(v_x)\"\n") ==
        "Dt is taken of an expression with 'v_x', whose rate is not known here; Dt(X) is for X over t, parameters and "
        "base coordinates: other rates are known along a motion alone");
    CHECK(diagnostic_of(pole + "[observables]\npower = \"Dt(energy)\"\n") ==
          "Dt is taken of an expression with 'energy', whose rate is not known here; Dt(X) is for X over t, parameters "
          "and base coordinates: other rates are known along a motion alone");
    CHECK(diagnostic_of(pole + "[observables]\nslope = \"diff(energy, x)\"\n") ==
          "diff is taken of an expression with 'energy'; what 'energy' depends on is put in later; definitions have "
          "derivatives, and 'lagrangian' where the model has L");
    CHECK(diagnostic_of(pole + "[lagrangian]\nL = \"xdt\"\n") != "accepted");
    CHECK(diagnostic_of(pole + "[hamiltonian]\nH = \"Dt(x)\"\n") ==
          "the Hamiltonian may not depend on a fibre coordinate ('v_x'); allowed here: time, parameters, base "
          "coordinates, momenta");
}

TEST_CASE("a velocity that Dt brings to where it may not stand is refused where Dt stands")
{
    try {
        (void)model_of(pole + "[control]\ncontrols = [\"u\"]\nsigma = { v_x = \"u\" }\ncost = \"u^2 + Dt(x)\"\n");
        FAIL("accepted");
    } catch (const lagen::ModelError& error) {
        CHECK(error.diagnostic().message == "the cost may not depend on a fibre coordinate ('v_x')");
        CHECK(lagen::place(error.diagnostic().where) == "test.toml:10:9");
    }
}

TEST_CASE("an anchor may be written by rates, one line a family")
{
    const std::string action = "[algebroid]\nkind = \"action\"\nalgebra = \"so(3)\"\n";
    const Model top = model_of(sphere + action + "anchor = { g = \"cross(g, w)\" }\n");
    CHECK(anchor_of(top.algebroid) == "1,0 -g[3]; 2,0 g[2]; 0,1 g[3]; 2,1 -g[1]; 0,2 -g[2]; 1,2 g[1]");
    const Model matrices = model_of("[base]\ncoordinates = [\"R[1..3,1..3]\", \"x[1..3]\"]\n[fibre]\ncoordinates = "
                                    "[\"w[1..3]\", \"v[1..3]\"]\n[algebroid]\nkind = \"action\"\nalgebra = \"se(3)\"\n"
                                    "anchor = { R = \"R*hat(w)\", x = \"R*v\" }\n[definitions]\nspin = \"Dt(R[1,1])\"\n"
                                    "[observables]\ns = \"spin\"\n");
    CHECK(matrices.algebroid.anchor.size() == 27);
    CHECK(to_text(matrices.observables[0].value) == "-R[1,3]*w[2] + R[1,2]*w[3]");
    // Inner frames have fibre coordinates of their own.
    const Model frame =
        model_of("[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"a\"]\n[algebroid]\nkind = "
                 "\"frame\"\nsections = { a = { u = 2 } }\n[algebroid.of]\nfibre = [\"u\"]\nanchor = { x = "
                 "\"3*x*u\" }\n[lagrangian]\nL = \"Dt(x)\"\n");
    CHECK(to_text(frame.lagrangian) == "3*x*2*a");
    CHECK(
        diagnostic_of(sphere + action + "anchor = { g = \"cross(g, w) + g\" }\n") ==
        "the rate of 'g' is not linear in the fibre coordinates; an anchor is linear: x' = rho^x_a y^a, and each term "
        "has one fibre coordinate for a factor");
    CHECK(diagnostic_of(sphere + action + "anchor = { g = \"t*w\" }\n") ==
          "the rate of 'g' may not depend on the time ('t'); allowed here: parameters, base coordinates, fibre "
          "coordinates");
    CHECK(diagnostic_of(sphere + action + "anchor = { w = { g = \"hat(g)\" }, \"g[1]\" = \"w[1]\" }\n") ==
          "the rate of 'g[1]' is given twice; by the lines of the sections too: keep one of them");
}

TEST_CASE("a running index gives a family its forces, its sections and its controls")
{
    const std::string chain =
        "[parameters]\nd = 1\n[base]\ncoordinates = [\"q[1..3]\", \"W[1..2,1..2]\"]\n[algebroid]\n"
        "kind = \"tangent\"\n";
    CHECK(texts_of(model_of(chain + "[forces]\n\"v_q[j]\" = \"-d*j*v_q[j] + sum(k, 1, j, q[k])\"\n").forces) ==
          "0 -d*1*v_q[1] + q[1]; 1 -d*2*v_q[2] + q[1] + q[2]; 2 -d*3*v_q[3] + q[1] + q[2] + q[3]");
    CHECK(texts_of(model_of(chain + "[forces]\n\"v_W[i,j]\" = \"W[j,i]\"\n").forces) ==
          "3 W[1,1]; 4 W[2,1]; 5 W[1,2]; 6 W[2,2]");
    CHECK(texts_of(model_of(chain + "[forces]\n\"v_W[2,j]\" = \"j\"\n").forces) == "5 1; 6 2");
    CHECK(texts_of(model_of(chain + "[forces]\n\"v_W[j,j]\" = \"j\"\n").forces) == "3 1; 6 2");
    CHECK(diagnostic_of(chain + "[forces]\n\"v_q[j]\" = \"j\"\n\"v_q[2]\" = 1\n") ==
          "the force on 'v_q[2]' is given twice: by 'v_q[j]' and by 'v_q[2]'; keep one of them");
    CHECK(diagnostic_of(chain + "[forces]\n\"v_q[d]\" = \"1\"\n") ==
          "the index 'd' is not an integer constant; it is made of integers and sizes");
    CHECK(diagnostic_of(chain + "[forces]\n\"v_W[j]\" = \"1\"\n") ==
          "[forces] names 'v_W[j]', which is no fibre coordinate; the entries of 'v_W' are v_W[1,1] to v_W[2,2]");
}
