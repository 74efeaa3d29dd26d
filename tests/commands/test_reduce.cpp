// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce`: equations that project, component by component, those that do not, and cyclic coordinates.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <fstream>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

const std::string reduced_models = std::string(LAGEN_SOURCE_DIR) + "/models/morphisms/";
const std::string reduced_data = std::string(LAGEN_SOURCE_DIR) + "/tests/data/morphisms/";

/// What stands before the equations.
std::string head_of(const std::string& text)
{
    return text.substr(0, text.find("\n\n") + 1);
}

std::string model_written(const std::string& folder, const std::string& name, const std::string& text)
{
    std::ofstream(folder + "/" + name) << text;
    return folder + "/" + name;
}

/// A force that the map does not carry over, unless `drag` is there too.
std::string dragged_line(const std::string& folder, const std::string& name, const std::string& drag)
{
    return model_written(folder, name,
                         "[base]\ncoordinates = [\"x\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                         "L = \"v_x^2/2 - x^4\"\n[forces]\nv_x = \"" +
                             drag + "\"\n");
}

} // namespace

TEST_CASE("the equations of the heavy top in Euler angles project onto those on the sphere, and both are printed")
{
    const Outcome outcome = call({"reduce", reduced_models + "heavy_top_reduction.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(head_of(outcome.out) ==
          "heavy_top_reduction: the equations of heavy_top_euler project onto those of heavy_top\n"
          "  lagrange        g1, g2, g3, w1, w2, w3: proved\n"
          "  variations      g1, g2, g3, w1, w2, w3: proved\n"
          "  lifts           dph, dth, dps: proved\n");
    for (const char* model : {"heavy_top_euler.toml", "heavy_top.toml"}) {
        const Outcome derived = call({"derive", std::string(LAGEN_SOURCE_DIR) + "/models/" + model});
        CHECK(derived.out.size() > 500);
        CHECK(outcome.out.find(derived.out) != std::string::npos);
    }
}

TEST_CASE("reduce --format json has the verdict of each component and the equations of both sides")
{
    const Outcome outcome = call({"reduce", reduced_models + "elroys_beanie_reduction.toml", "--format", "json"});
    CHECK(outcome.code == 0);
    const json::Value value = json::parse(outcome.out);
    CHECK(value.keys == std::vector<std::string>{"model", "verdict", "trivial", "checks", "paths", "source", "target"});
    CHECK(value["verdict"].text == "valid");
    CHECK(value["paths"][5]["name"].text == "paths");
    CHECK(value["paths"][5]["indices"].texts() == std::vector<std::string>{"lifts", "v_th"});
    REQUIRE(value["checks"].size() == 5);
    CHECK(value["checks"][4]["name"].text == "projects");
    CHECK(value["checks"][4]["indices"].texts() == std::vector<std::string>{"lagrange", "v2"});
    CHECK(value["checks"][4]["status"].text == "proved");
    CHECK(value["source"][0]["model"].text == "elroys_beanie_unreduced");
    CHECK(value["target"][0]["form"].text == "lagrange");
}

TEST_CASE("a false map is refused; unchecked, each component that does not project has a witness")
{
    const Outcome refused = call({"reduce", reduced_data + "wrong_row.toml"});
    CHECK(refused.code == 1);
    CHECK(refused.out.empty());
    CHECK(refused.err.starts_with("error: morphism 'wrong_row' is refuted: admissible (dth, g1), residual "));
    const Outcome outcome = call({"reduce", reduced_data + "wrong_row.toml", "--unchecked", "--format", "json"});
    CHECK(outcome.code == 1);
    const json::Value value = json::parse(outcome.out);
    CHECK(value["verdict"].text == "invalid");
    std::size_t refuted = 0;
    for (const json::Value& check : value["checks"].entries) {
        if (check["status"].text != "refuted") continue;
        ++refuted;
        CHECK(check["witness"].keys.size() > 0);
    }
    CHECK(refuted == 5); // g2' has no w2
}

TEST_CASE("equations project although the Lagrangians do not: twice L, and a total derivative")
{
    const std::string folder = fresh_folder();
    const auto plane = [&](const std::string& name, const std::string& L) {
        return model_written(
            folder, name,
            "[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" + L + "\"\n");
    };
    plane("twice.toml", "v_x^2 + v_y^2 - 2*x^2*y + y*v_x + x*v_y");
    plane("once.toml", "(v_x^2 + v_y^2)/2 - x^2*y");
    const std::string map =
        model_written(folder, "map.toml",
                      "[morphism]\nsource = \"twice.toml\"\ntarget = \"once.toml\"\nbase = { x = \"x\", y "
                      "= \"y\" }\nfibre = { v_x = \"v_x\", v_y = \"v_y\" }\n");
    CHECK(call({"reduce", map}).code == 1); // L is not invariant
    const Outcome outcome = call({"reduce", map, "--unchecked"});
    CHECK(outcome.code == 0);
    CHECK(head_of(outcome.out) ==
          "map: the equations of twice project onto those of once\n  lagrange        x, y, v_x, v_y: proved\n"
          "  variations      x, y, v_x, v_y: proved\n  lifts           v_x, v_y: refuted\n");
}

TEST_CASE("of a source whose Lagrangian is degenerate the accelerations are not known, and it is said")
{
    const std::string folder = fresh_folder();
    model_written(folder, "flat.toml",
                  "[parameters]\nm = 1\n[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n"
                  "[lagrangian]\nL = \"9*m*x^4*v_x^2/2\"\n");
    const auto reduced = [&](const std::string& name, const std::string& coordinates, const std::string& L,
                             const std::string& maps) {
        model_written(folder, "line.toml",
                      "[parameters]\nm = 1\n[base]\ncoordinates = [" + coordinates +
                          "]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = \"" + L + "\"\n");
        return call(
            {"reduce", "--unchecked",
             model_written(folder, name, "[morphism]\nsource = \"flat.toml\"\ntarget = \"line.toml\"\n" + maps)});
    };
    const Outcome cube =
        reduced("cube.toml", "\"q\"", "m*v_q^2/2", "base = { q = \"x^3\" }\nfibre = { v_q = \"3*x^2*v_x\" }\n");
    CHECK(cube.code == 2);
    CHECK(head_of(cube.out) == "cube: the equations of flat are not shown to project onto those of line\n"
                               "  lagrange        q: proved\n  lagrange        v_q: undecided\n"
                               "  variations      q, v_q: proved\n  lifts           v_x, v_y: proved\n");
    CHECK(cube.out.find("undecided: projects (lagrange, v_q)\n  known: L of the source is degenerate: its equations do "
                        "not determine the accelerations\n") != std::string::npos);
    // An equation without accelerations is decided as ever.
    const Outcome still =
        reduced("still.toml", "\"q\", \"s\"", "m*v_q^2/2 - s^2",
                "base = { q = \"x^3\", s = \"y\" }\nfibre = { v_q = \"3*x^2*v_x\", v_s = \"v_y\" }\n");
    CHECK(still.out.find("  lagrange        q, s: proved\n  lagrange        v_s: refuted\n"
                         "  lagrange        v_q: undecided\n") != std::string::npos);
}

TEST_CASE("forces project with the equations, and one that does not is refuted in its component alone")
{
    const std::string folder = fresh_folder();
    dragged_line(folder, "from.toml", "-v_x^3");
    dragged_line(folder, "to.toml", "-v_x^3");
    dragged_line(folder, "other.toml", "-v_x");
    const std::string map = "[morphism]\nsource = \"from.toml\"\nbase = { x = \"-x\" }\nfibre = { v_x = \"-v_x\" }\n";
    const Outcome good = call({"reduce", model_written(folder, "good.toml", map + "target = \"to.toml\"\n")});
    CHECK(head_of(good.out) ==
          "good: the equations of from project onto those of to\n  lagrange        x, v_x: proved\n"
          "  variations      x, v_x: proved\n  lifts           v_x: proved\n");
    const Outcome bad =
        call({"reduce", model_written(folder, "bad.toml", map + "target = \"other.toml\"\n"), "--unchecked"});
    CHECK(bad.code == 1);
    CHECK(head_of(bad.out) == "bad: the equations of from do not project onto those of other\n"
                              "  lagrange        x: proved\n  lagrange        v_x: refuted\n"
                              "  variations      x, v_x: proved\n  lifts           v_x: refuted\n");
}

TEST_CASE("discrete equations of arrows are pulled back, on groups, actions and bundles, and for compositions")
{
    struct DiscreteReduction {
        const char* file;
        const char* components;
    };
    for (const DiscreteReduction& each :
         {DiscreteReduction{"se2_reduction", "v_th, v_x, v_y"}, DiscreteReduction{"top_reduction", "v_ph, v_th, v_ps"},
          DiscreteReduction{"circle_reduction", "v_x, v_y, v_s"}, DiscreteReduction{"turned", "w1, w2, w3"}}) {
        const Outcome outcome = call({"reduce", reduced_data + each.file + ".toml"});
        INFO(each.file << "\n" << outcome.out << outcome.err);
        CHECK(outcome.code == 0);
        CHECK(outcome.out.find(std::string("  discrete        ") + each.components + ": proved\n") !=
              std::string::npos);
    }
    // A fibre map that is twice what the arrows say.
    const Outcome wrong = call({"reduce", reduced_data + "wrong_fibre.toml", "--unchecked"});
    CHECK(wrong.code == 1);
    CHECK(wrong.out.find("  discrete        v_s: refuted\n") != std::string::npos);
    CHECK(wrong.out.find("  discrete        v_x, v_y: proved\n") != std::string::npos);
    const Outcome nothing = call({"reduce", reduced_data + "circle_and_shape.toml"});
    CHECK(nothing.code == 2);
    CHECK(nothing.out == "circle_and_shape: the equations of kaluza_klein are not shown to project onto those of "
                         "plane_pair\n  note: the two models have no form of the equations of motion in common\n");
}

TEST_CASE("Hamilton's equations of H alone, and Pontryagin's with controls that turn with the base, are compared on "
          "pulled back momenta")
{
    const std::string folder = fresh_folder();
    const std::string kind = "[algebroid]\nkind = \"tangent\"\n";
    model_written(folder, "wide.toml",
                  "[base]\ncoordinates = [\"x\", \"y\"]\n" + kind +
                      "[hamiltonian]\nH = \"(p_v_x^2 + p_v_y^2)/2 + x^4\"\n");
    model_written(folder, "narrow.toml",
                  "[base]\ncoordinates = [\"x\"]\n" + kind + "[hamiltonian]\nH = \"p_v_x^2/2 + x^4\"\n");
    const Outcome hamilton =
        call({"reduce", model_written(folder, "forget.toml",
                                      "[morphism]\nsource = \"wide.toml\"\ntarget = \"narrow.toml\"\n"
                                      "base = { x = \"x\" }\nfibre = { v_x = \"v_x\" }\n")});
    CHECK(head_of(hamilton.out) == "forget: the equations of wide project onto those of narrow\n"
                                   "  hamilton        x, p_v_x, p_v_y: proved\n");

    const auto steered = [&](const std::string& name, const std::string& sigma) {
        model_written(folder, name,
                      "[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n" + kind +
                          "[control]\ncontrols = [\"u\", \"v\"]\n" + sigma + "cost = \"(u^2 + v^2)/2\"\n");
    };
    steered("fixed.toml", "sigma = { v_x = \"u\", v_y = \"v\", v_z = \"u\" }\n");
    steered(
        "turning.toml",
        "sigma = { v_x = \"cos(z)*u - sin(z)*v\", v_y = \"sin(z)*u + cos(z)*v\", v_z = \"cos(z)*u - sin(z)*v\" }\n");
    const std::string map = "[morphism]\nsource = \"turning.toml\"\ntarget = \"fixed.toml\"\n"
                            "base = { x = \"x\", y = \"y\", z = \"z\" }\n"
                            "fibre = { v_x = \"v_x\", v_y = \"v_y\", v_z = \"v_z\" }\n";
    const Outcome pontryagin = call(
        {"reduce", model_written(folder, "steer.toml",
                                 map + "controls = { u = \"cos(z)*u - sin(z)*v\", v = \"sin(z)*u + cos(z)*v\" }\n")});
    CHECK(head_of(pontryagin.out) == "steer: the equations of turning project onto those of fixed\n"
                                     "  pontryagin      v_x, v_y, v_z, x, y, z, p_v_x, p_v_y, p_v_z, u, v: proved\n");
}

TEST_CASE("without options reduce lists the cyclic coordinates of a model")
{
    const std::string models = std::string(LAGEN_SOURCE_DIR) + "/models/";
    const Outcome top = call({"reduce", models + "heavy_top_euler.toml"});
    CHECK(top.code == 0);
    CHECK(top.out.starts_with("heavy_top_euler: cyclic coordinates: ph\n\nrefuted: cyclic (th, L)\n"));
    const Outcome beanie = call({"reduce", reduced_models + "elroys_beanie_unreduced.toml", "--format", "json"});
    const json::Value value = json::parse(beanie.out);
    CHECK(value.keys == std::vector<std::string>{"model", "cyclic", "trivial", "checks"});
    CHECK(value["cyclic"].texts() == std::vector<std::string>{"th", "x", "y"});
    CHECK(value["checks"][3]["indices"].texts() == std::vector<std::string>{"ps", "L"});
    const Outcome body = call({"reduce", models + "heavy_top.toml"});
    CHECK(body.out.starts_with("heavy_top: cyclic coordinates: none\n"));
    const Outcome other = call({"reduce", models + "heavy_top.toml", "--routh", "g1"});
    CHECK(other.code == 1);
    CHECK(other.err.starts_with("error: Routh's reduction takes a Lagrangian on a tangent bundle"));
}
