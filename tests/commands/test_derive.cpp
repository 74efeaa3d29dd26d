// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen derive` in its three formats.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;

namespace {

/// What two fresh processes print as equations of a model.
void check_equations(const std::string& name, const std::string& format)
{
    INFO(name << " as " << format);
    const std::vector<std::string> arguments{"derive", name + ".toml", "--format", format};
    const Outcome first = call(arguments);
    CHECK(first.code == 0);
    CHECK(first.err.empty());
    CHECK(first.out.size() > 200);
    CHECK(first.out.ends_with('\n'));
    CHECK(call(arguments, {.environment = {{"PADDING", std::string(997, 'x')}}}).out == first.out);
    if (format == "json") CHECK(lagen::json::parse(first.out).size() > 2);
}

const std::vector<std::string> formats{"text", "latex", "json"};

} // namespace

TEST_CASE("the equations of every model are the same text in fresh processes, in one format after the other", "[long]")
{
    std::size_t k = 0;
    for (const std::string& name : example_models()) check_equations(name, formats[k++ % formats.size()]);
}

TEST_CASE("the equations of every model are the same text in fresh processes, in each format", "[all]")
{
    for (const std::string& name : example_models())
        for (const std::string& format : formats) check_equations(name, format);
}

TEST_CASE("Hamilton's equations are the same text in fresh processes, and those of a control problem are Pontryagin's",
          "[long]")
{
    for (const std::string name :
         {"double_pendulum", "elroys_beanie", "heavy_top", "relativistic_oscillator", "wong"}) {
        INFO(name);
        const Outcome first = call({"derive", name + ".toml", "--form", "hamilton"});
        CHECK(first.code == 0);
        CHECK(first.out.find("\nPoisson brackets:") != std::string::npos);
        CHECK(call({"derive", name + ".toml", "--form", "hamilton"},
                   {.environment = {{"PADDING", std::string(997, 'x')}}})
                  .out == first.out);
    }
    const Outcome pontryagin = call({"derive", "unicycle.toml", "--format", "json"});
    CHECK(pontryagin.out.find("\"form\": \"pontryagin\"") != std::string::npos);
    CHECK(call({"derive", "unicycle.toml", "--format", "json", "--form", "pontryagin"}).out == pontryagin.out);
}

TEST_CASE("a form that is none is answered with the nearest one")
{
    const Outcome outcome = call({"derive", "pendulum.toml", "--form", "hamiltonian"});
    CHECK(outcome.code == 4);
    CHECK(outcome.err ==
          "lagen derive: --form is 'hamiltonian', it must be one of lagrange, hamilton, pontryagin, "
          "discrete, first_order, exterior, cartan, poisson, invariants, variations, reaction, projected; did "
          "you mean 'hamilton'?\n");
}

TEST_CASE("Euler's equations of the rigid body are those of the textbook")
{
    const std::string text = call({"derive", "rigid_body.toml", "--expand"}).out;
    INFO(text);
    CHECK(text.find("\n  I1 ẇ1 = (I2 - I3) w2 w3\n  I2 ẇ2 = (I3 - I1) w1 w3\n  I3 ẇ3 = (I1 - I2) w1 w2\n") !=
          std::string::npos);
    const std::string vectors = call({"derive", "rigid_body.toml"}).out;
    INFO(vectors);
    CHECK(vectors.find("\n  I ẇ = I w × w\n") != std::string::npos);
    CHECK(vectors.find("\n   I = diag(I1, I2, I3)\n") != std::string::npos);
}

TEST_CASE("definitions are symbols with a list of what they stand for, and --expand writes them out")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/a.toml", R"toml([parameters]
J = 1
m = 2
[base]
coordinates = ["x"]
[fibre]
coordinates = ["u", "w"]
[algebroid]
kind = "atiyah"
algebra = "R^1"
[definitions]
I = "J + m*(2 + cos(x))^2"
[lagrangian]
L = "m*u^2/2 + I*w^2/2"
)toml");
    const std::string kept = call({"derive", folder + "/a.toml"}).out;
    CHECK(kept.find("\n  p_w = I w\n") != std::string::npos);
    CHECK(kept.ends_with("\nwhere:\n  I = J + m (cos(x) + 2)²\n"));
    const std::string flat = call({"derive", folder + "/a.toml", "--expand"}).out;
    CHECK(flat.find("\n  p_w = w (J + m (cos(x) + 2)²)\n") != std::string::npos);
    CHECK(flat.find("where") == std::string::npos);
    CHECK(call({"derive", folder + "/a.toml", "--format", "json"}).out.find(R"("where": [{"symbol": "I", "value": )") !=
          std::string::npos);
    CHECK(
        call({"derive", folder + "/a.toml", "--format", "json"})
            .out.find(
                R"("system": {"parameters": [{"symbol": "J", "value": "1"}, {"symbol": "m", "value": "2"}], "base": ["x"], )"
                R"("fibre": ["u", "w"], "momenta": ["p_u", "p_w"], "definitions": [{"symbol": "I", "value": )"
                R"("J + m*(2 + cos(x))^2"}], "lagrangian": "m*u^2/2 + (J + m*(2 + cos(x))^2)*w^2/2", "constraints": [], )"
                R"("rho": [{"indices": ["x", "u"], "value": "1"}], "C": []})") != std::string::npos);
}

TEST_CASE("-o writes the equations to a file")
{
    const std::string folder = fresh_folder();
    const Outcome outcome =
        call({"derive", models_folder() + "/pendulum.toml", "--format", "latex", "-o", "a.tex"}, {.folder = folder});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(read_text(folder + "/a.tex") == call({"derive", "pendulum.toml", "--format", "latex"}).out);
}

TEST_CASE("almost Poisson brackets of functions on D* are printed, and Jacobi's identity is said to fail")
{
    const Outcome outcome = call({"derive", std::string(LAGEN_SOURCE_DIR) + "/models/chaplygin_sleigh.toml", "--form",
                                  "poisson", "--bracket", "p_u", "--bracket", "x*p_w"});
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("  {F, G} = p_w (cos(th) - m a x/(m a² + J))\n") != std::string::npos);
    CHECK(outcome.out.find("  J(x, p_u, p_w) = sin(th)\n") != std::string::npos);
}
