// SPDX-License-Identifier: GPL-2.0-or-later
/// Hamiltonians, forces, dissipation and control problems: what a file says is what the record holds.
#include "expression/parse.hpp"
#include "model/names.hpp"
#include "model/read_model.hpp"
#include "model/scene_form.hpp"
#include "scene/evaluate_scene.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using lagen::Model;
using lagen::read_model_text;
using lagen::to_text;
using Strings = std::vector<std::string>;

namespace {

const std::string plane = "[base]\ncoordinates = [\"x\", \"y\"]\n[algebroid]\nkind = \"tangent\"\n";
const std::string lagrangian = "[lagrangian]\nL = \"(v_x^2 + v_y^2)/2\"\n";
const std::string hamiltonian = "[hamiltonian]\nH = \"(p_v_x^2 + p_v_y^2)/2\"\n";
const std::string control = R"toml(
[control]
controls = ["u"]
sigma = { v_x = "u*cos(t)", v_y = 0 }
cost = "u^2/2"
)toml";
const std::string start = "[scene.default]\nduration = 1\ninitial = { x = 0, y = 0, ";
const std::string from_velocities = start + "v_x = 1, v_y = 0 }\n";
const std::string from_momenta = start + "p_v_x = 1, p_v_y = 0 }\n";

Model read(const std::string& text)
{
    return read_model_text("test.toml", text);
}

/// "0 cos(t)*u": section and value of each entry.
Strings texts(const std::vector<lagen::ComponentEntry>& entries)
{
    Strings out;
    for (const lagen::ComponentEntry& entry : entries)
        out.push_back(std::to_string(entry.section) + " " + to_text(entry.value));
    return out;
}

Strings texts(const std::vector<lagen::NamedTree>& entries)
{
    Strings out;
    for (const lagen::NamedTree& entry : entries) out.push_back(entry.name + " = " + to_text(entry.value));
    return out;
}

Strings columns(const lagen::Scene& scene)
{
    Strings out;
    for (const lagen::NamedTree& column : *scene.observe) out.push_back(column.name);
    return out;
}

std::string error_of(const std::function<void()>& act)
{
    try {
        act();
    } catch (const lagen::Error& error) {
        return error.what();
    }
    return "";
}

/// A folder with model files that goes with the test.
struct Files {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "lagen_test_mechanics";
    explicit Files(const std::map<std::string, std::string>& files)
    {
        std::filesystem::create_directories(folder);
        for (const auto& [name, text] : files) std::ofstream(folder / name) << text;
    }
    ~Files() { std::filesystem::remove_all(folder); }
    [[nodiscard]] Model read(const std::string& name) const { return lagen::read_model((folder / name).string()); }
};

} // namespace

TEST_CASE("a Hamiltonian is closed over momenta, and definitions may be written in them")
{
    const Model model = read(plane + "[fibre]\ncoordinates = [\"u\", \"v\"]\nmomenta = [\"p\", \"q\"]\n"
                                     "[definitions]\nT = \"(p^2 + q^2)/2\"\n[hamiltonian]\nH = \"T + x*sin(t)\"\n");
    CHECK(to_text(model.hamiltonian) == "(p^2 + q^2)/2 + x*sin(t)");
    CHECK(model.hamiltonian_where.file == model.file);
    CHECK_FALSE(model.lagrangian);
}

TEST_CASE("forces stand at their sections, may switch, and a family gives all of its entries")
{
    const Model model = read("[base]\ncoordinates = [\"x[1..2]\", \"z\"]\n[algebroid]\nkind = \"tangent\"\n"
                             "[forces]\nv_z = \"if(z < 0, -z, 0)\"\nv_x = [\"-v_x[1]\", 0]\n"
                             "[dissipation]\nR = \"v_z^4/4\"\n");
    CHECK(texts(model.forces) == Strings{"2 if(z < 0, -z, 0)", "0 -v_x[1]"});
    CHECK(to_text(model.dissipation) == "v_z^4/4");
}

TEST_CASE("an entry of a family of forces may be named by a size")
{
    const Model model = read("[sizes]\nn = 3\n[base]\ncoordinates = [\"x[1..n]\"]\n[algebroid]\nkind = \"tangent\"\n"
                             "[forces]\n\"v_x[n]\" = \"n*t\"\n");
    CHECK(texts(model.forces) == Strings{"2 3*t"});
}

TEST_CASE("a control problem holds controls, sigma without its zeros, cost, bounds and both ends")
{
    const Model model = read("[parameters]\nm = 2\n" + plane + R"toml(
[control]
controls = ["u", "w[1..2]"]
sigma = { v_x = "u*w[1]", v_y = "w[2]*sin(t)" }
cost = "(u^2 + dot(w, w))/2"
bounds = { u = ["-m", "m"], w = [[-1, -2], 3] }
[control.boundary]
from = { x = 0, y = "m" }
to = { y = "1/2" }
duration = "free"
terminal_cost = "m*x^2"
[about]
u = { unit = "N", latex = "\\tau" }
)toml");
    REQUIRE(model.control);
    const lagen::Control& problem = *model.control;
    REQUIRE(problem.controls.size() == 3);
    CHECK(problem.controls[2].name == "w[2]");
    CHECK(problem.controls[0].unit == "N");
    CHECK(texts(problem.sigma) == Strings{"0 u*w[1]", "1 w[2]*sin(t)"});
    CHECK(to_text(problem.cost) == "(u^2 + w[1]^2 + w[2]^2)/2");
    REQUIRE(problem.bounds.size() == 3);
    CHECK(to_text(problem.bounds[0].lower) == "-m");
    CHECK(problem.bounds[2].control == 2);
    CHECK(to_text(problem.bounds[2].lower) == "-2");
    CHECK(to_text(problem.bounds[2].upper) == "3");
    REQUIRE(problem.boundary);
    CHECK(texts(problem.boundary->from) == Strings{"x = 0", "y = m"});
    CHECK(texts(problem.boundary->to) == Strings{"y = 1/2"});
    CHECK(problem.boundary->free_duration);
    CHECK_FALSE(problem.boundary->duration);
    CHECK(to_text(problem.boundary->terminal_cost) == "m*x^2");
    const auto& families = model.families;
    REQUIRE(families.size() == 1);
    CHECK((families[0].name == "w" && families[0].role == lagen::Role::control && families[0].first == 1));
}

TEST_CASE("the default form is that of a control problem, else of L, else of H")
{
    CHECK(lagen::forms_of(read(plane)).empty());
    CHECK(lagen::forms_of(read(plane + hamiltonian)) == Strings{"hamilton"});
    CHECK(lagen::forms_of(read(plane + lagrangian)) == Strings{"lagrange", "hamilton"});
    CHECK(lagen::forms_of(read(plane + control)) == Strings{"pontryagin"});
    CHECK(lagen::forms_of(read(plane + lagrangian + control)) == Strings{"pontryagin", "lagrange", "hamilton"});
    for (const std::string& block : {hamiltonian, lagrangian, control, lagrangian + hamiltonian + control})
        CHECK(lagen::default_form(read(plane + block)) == lagen::forms_of(read(plane + block)).front());
}

TEST_CASE("\"state\" means the states of the form, and changes with it")
{
    const Model model = read(plane + lagrangian + control + from_momenta + "observe = [\"y\", \"state\", \"p_v_y\"]\n");
    const lagen::Scene& scene = model.scenes[0];
    CHECK(scene.form.empty());
    CHECK(columns(scene) == Strings{"y", "x", "p_v_x", "p_v_y", "u"});
    CHECK(columns(lagen::in_form(model, scene, "hamilton")) == Strings{"y", "x", "p_v_x", "p_v_y"});
    const lagen::Scene lagrange = lagen::in_form(model, scene, "lagrange");
    CHECK(lagrange.form == "lagrange");
    CHECK(columns(lagrange) == Strings{"y", "x", "v_x", "v_y"});
    const Model plain = read(plane + lagrangian + from_velocities + "observe = [\"y\", \"state\", \"p_v_y\"]\n");
    CHECK(columns(plain.scenes[0]) == Strings{"y", "x", "v_x", "v_y", "p_v_y"});
    CHECK(columns(lagen::in_form(plain, plain.scenes[0], "hamilton")) == Strings{"y", "x", "p_v_x", "p_v_y"});
}

TEST_CASE("a scene that another form cannot do is refused when it is put into it")
{
    const Model model = read(plane + lagrangian + control + from_momenta + "observe = [\"energy\", \"2*u\"]\n");
    CHECK(error_of([&] { (void)lagen::in_form(model, model.scenes[0], "lagrange"); })
              .find("the column '2*u' of scene 'default' depends on the control 'u', which the form 'lagrange' does "
                    "not have") != std::string::npos);
    const Model other = read(plane + lagrangian + control + from_velocities + "form = \"lagrange\"\n");
    CHECK(error_of([&] {
              (void)lagen::in_form(other, other.scenes[0], "pontryagin");
          }).find("scene 'default' starts from fibre coordinates, where Pontryagin's equations start from momenta\n") !=
          std::string::npos);
    CHECK(error_of([&] { (void)lagen::in_form(other, other.scenes[0], "discrete"); }) ==
          "error: the form asked for is 'discrete', but the model has no [discrete]\nhint: forms of this model: "
          "pontryagin, lagrange, hamilton");
    CHECK_FALSE(lagen::has_value(model, (*model.scenes[0].observe)[1].value, "lagrange"));
    CHECK(lagen::has_value(model, (*model.scenes[0].observe)[0].value, "lagrange"));
}

TEST_CASE("a scene of Pontryagin's form asks for the momenta that it leaves out")
{
    const std::string error = error_of([] { (void)read(plane + control + start + "p_v_x = 1 }\nrest = true\n"); });
    CHECK(error == "test.toml:10:8: error: scene 'default' leaves out the initial value of p_v_y\n  [scene.default]\n"
                   "         ^~~~~~~");
}

TEST_CASE("what expressions from outside may use has momenta, controls and the three functions of every form")
{
    const Model model = read(plane + lagrangian + control + "[observables]\npower = \"u*p_v_x - hamiltonian\"\n");
    const auto close = [&](const char* text) {
        return to_text(model.observer.close(lagen::parse_expression(lagen::whole_text("<test>", text))));
    };
    CHECK(close("power + energy + lagrangian") == "u*p_v_x - hamiltonian + energy + (v_x^2 + v_y^2)/2");
    CHECK(lagen::symbol_names(model) == Strings{"x", "y", "v_x", "v_y", "u", "total_cost"});
}

TEST_CASE("a frame of a file takes over its Lagrangian with forces and dissipation, pulled back")
{
    const Files files(
        {{"inner.toml", plane + lagrangian +
                            "[forces]\nv_x = \"-v_y\"\nv_y = \"if(x < 0, 1, 0)\"\n"
                            "[dissipation]\nR = \"v_x^2/2\"\n"},
         {"outer.toml", "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"frame\"\n"
                        "of = \"inner.toml\"\nsections = { a = { v_x = \"x\" }, b = { v_x = 1, v_y = 2 } }\n"},
         {"undamped.toml", "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"frame\"\n"
                           "of = \"inner.toml\"\nsections = { a = { v_x = \"x\" }, b = { v_y = 2 } }\n"
                           "[forces]\na = \"t\"\n[dissipation]\nR = 0\n"},
         {"other.toml", "[fibre]\ncoordinates = [\"a\", \"b\"]\n[algebroid]\nkind = \"frame\"\n"
                        "of = \"inner.toml\"\nsections = { a = { v_x = 1 }, b = { v_y = 2 } }\n"
                        "[lagrangian]\nL = \"a^2 + b^2\"\n"}});
    const Model outer = files.read("outer.toml");
    // v_x = x a + b, v_y = 2 b;  Q_a = x Q_vx, Q_b = Q_vx + 2 Q_vy
    CHECK(to_text(outer.dissipation) == "(x*a + b)^2/2");
    CHECK(texts(outer.forces) == Strings{"0 x*-2*b", "1 -2*b + 2*if(x < 0, 1, 0)"});
    const Model undamped = files.read("undamped.toml");
    CHECK(to_text(undamped.lagrangian) == "((x*a)^2 + (2*b)^2)/2");
    CHECK(texts(undamped.forces) == Strings{"0 t"});
    CHECK(to_text(undamped.dissipation) == "0");
    const Model other = files.read("other.toml");
    CHECK(other.forces.empty());
    CHECK_FALSE(other.dissipation);
}

TEST_CASE("a product of files has the forces of each factor at its own sections")
{
    const Files files({{"p.toml", plane + lagrangian + "[forces]\nv_y = \"-v_y\"\n"},
                       {"q.toml", "[base]\ncoordinates = [\"z\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                                  "L = \"v_z^2\"\n[forces]\nv_z = \"cos(t)\"\n[dissipation]\nR = \"v_z^2\"\n"},
                       {"both.toml", "[algebroid]\nkind = \"product\"\nof = [\"q.toml\", \"p.toml\"]\n"}});
    const Model both = files.read("both.toml");
    CHECK(texts(both.forces) == Strings{"0 cos(t)", "2 -v_y"});
    CHECK(to_text(both.dissipation) == "v_z^2");
}

TEST_CASE("a bound may be left open, as text or as a number of TOML")
{
    const std::string control =
        "[control]\ncontrols = [\"u[1..2]\", \"w\", \"z\"]\nsigma = { v_x = \"w\" }\ncost = 1\n";
    const Model model =
        read(plane + control + "bounds = { u = [\"-inf\", [1, 2]], w = [-3, +inf], z = [-inf, \"inf\"] }\n");
    const std::vector<lagen::ControlBound>& bounds = model.control->bounds;
    REQUIRE(bounds.size() == 3); // z has none
    CHECK_FALSE(bounds[1].lower);
    CHECK(to_text(bounds[1].upper) == "2");
    CHECK(bounds[2].control == 2);
    CHECK(to_text(bounds[2].lower) == "-3");
    CHECK_FALSE(bounds[2].upper);
}

TEST_CASE("bounds over parameters are compared at the values of a scene")
{
    const Model model = read("[parameters]\nm = -1\n" + plane + control + "bounds = { u = [\"-m\", \"m\"] }\n" +
                             from_momenta + "parameters = { m = 2 }\n");
    CHECK(lagen::evaluate_scene(model, model.scenes[0]).momenta.size() == 2);
}
