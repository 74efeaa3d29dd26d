// SPDX-License-Identifier: GPL-2.0-or-later
/// What is said of xdot, dx and p_x, which are no names of a model.
#include "model/read_model.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// The hint of the mistake in a model; empty where it has none.
std::string hint_of_model(const std::string& text)
{
    try {
        (void)read_model_text("test.toml", text);
    } catch (const ModelError& error) {
        return error.diagnostic().hint;
    }
    return "";
}

std::string tangent_to(const std::string& base, const std::string& rest)
{
    return "[base]\ncoordinates = [" + base + "]\n[algebroid]\nkind = \"tangent\"\n" + rest;
}

std::string with_lagrangian(const std::string& lagrangian)
{
    return "[lagrangian]\nL = \"" + lagrangian + "\"\n";
}

} // namespace

TEST_CASE("every usual name of a velocity is answered with the fibre coordinate, whatever that is called")
{
    for (const char* spelling : {"xdot", "x_dot", "dx", "vx", "dot_x", "dxdt", "dx_dt"}) {
        INFO(spelling);
        CHECK(hint_of_model(tangent_to("\"x\"", with_lagrangian(std::string(spelling) + "^2/2"))) ==
              "did you mean 'v_x'?");
        CHECK(hint_of_model(tangent_to("\"x\"", "[fibre]\ncoordinates = [\"speed\"]\n" +
                                                    with_lagrangian(std::string(spelling) + "^2/2"))) ==
              "did you mean 'speed'?");
    }
    CHECK(hint_of_model(tangent_to("\"x\"", "[fibre]\ncoordinates = [\"speed\"]\n" + with_lagrangian("v_x^2"))) ==
          "did you mean 'speed'?");
    // What the model declares wins.
    CHECK(hint_of_model(tangent_to("\"x\"", "[parameters]\ndx = 1\n" + with_lagrangian("dx*v_x^2"))).empty());
}

TEST_CASE("forces, observables and events are answered like L, H with momenta")
{
    const std::string lagrangian = with_lagrangian("v_x^2/2");
    CHECK(hint_of_model(tangent_to("\"x\"", lagrangian + "[forces]\nv_x = \"-xdot\"\n")) == "did you mean 'v_x'?");
    CHECK(hint_of_model(tangent_to("\"x\"", lagrangian + "[observables]\nspeed = \"xdot\"\n")) ==
          "did you mean 'v_x'?");
    CHECK(hint_of_model(tangent_to("\"x\"", lagrangian + "[observables]\npush = \"px\"\n")) == "did you mean 'p_v_x'?");
    const std::string hamiltonian = "[hamiltonian]\nH = \"xdot^2/2\"\n";
    CHECK(hint_of_model(tangent_to("\"x\"", hamiltonian)) == "momenta stand here: that of 'v_x' is 'p_v_x'");
    CHECK(hint_of_model(tangent_to("\"x\"", "[fibre]\nmomenta = [\"m\"]\n[hamiltonian]\nH = \"p_x^2/2\"\n")) ==
          "did you mean 'm'?");
}

TEST_CASE("a family of velocities is answered with the family of fibre coordinates")
{
    CHECK(hint_of_model(tangent_to("\"x[1..3]\"", with_lagrangian("dot(xdot, xdot)/2"))) == "did you mean 'v_x'?");
    CHECK(hint_of_model(tangent_to("\"x[1..3]\"", with_lagrangian("dx[2]^2"))) == "did you mean 'v_x'?");
    CHECK(hint_of_model(tangent_to("\"x[1..3]\"", "[hamiltonian]\nH = \"dot(p_x, p_x)\"\n")) ==
          "did you mean 'p_v_x'?");
    // Two families of fibre coordinates are not one name.
    CHECK(hint_of_model(tangent_to("\"x[1..2]\"",
                                   "[fibre]\ncoordinates = [\"a\", \"b\"]\n" + with_lagrangian("dot(xdot, xdot)"))) ==
          "known names are x, a, b, t");
}

TEST_CASE("where the anchor mixes sections the rate is what it makes of them; a long one is not told")
{
    const auto model = [](const std::string& entry) {
        return "[base]\ncoordinates = [\"x\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid.anchor]\nu = { x = "
               "\"" +
               entry + "\" }\n[lagrangian]\nL = \"u^2/2 + xdot^2\"\n";
    };
    CHECK(hint_of_model(model("2*cos(x)")) == "by the anchor the rate of 'x' is 2*cos(x)*u");
    CHECK(hint_of_model(model("1")) == "did you mean 'u'?");
    CHECK(hint_of_model(model("cos(x)*sin(x)*exp(x)*cos(2*x)*sin(2*x)*exp(2*x)*cos(3*x)*sin(3*x)")) ==
          "known names are x, u, v, t");
}

TEST_CASE("in H a definition of momenta is known, and one of velocities is not")
{
    const std::string model = tangent_to("\"x\"", "[definitions]\nkinetic = \"p_v_x^2/2\"\nspeedy = \"v_x\"\n");
    CHECK(hint_of_model(model + "[hamiltonian]\nH = \"kinetci\"\n") == "did you mean 'kinetic'?");
    CHECK(hint_of_model(model + "[hamiltonian]\nH = \"speedi\"\n") == "known names are x, p_v_x, kinetic, t");
}

TEST_CASE("subbundles answer with the ambient velocity, frames with the coordinates of the inner frame")
{
    const std::string base = "[base]\ncoordinates = [\"x\", \"y\"]\n";
    CHECK(hint_of_model(base +
                        "[fibre]\ncoordinates = [\"u\"]\n[algebroid]\nkind = \"subbundle\"\n"
                        "spanned_by = { u = { x = \"cos(y)\", y = \"1\" } }\n" +
                        with_lagrangian("xdot^2/2")) == "did you mean 'v_x'?");
    CHECK(hint_of_model(base +
                        "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"frame\"\n"
                        "sections = { a = { r = \"1\" }, b = { s = \"x\" } }\n[algebroid.of]\n"
                        "kind = \"tangent\"\nfibre = [\"r\", \"s\"]\n" +
                        with_lagrangian("ydot^2/2")) == "did you mean 's'?");
}
