// SPDX-License-Identifier: GPL-2.0-or-later
/// Pictures of runs: curves with no more points than are seen, labels, spheres and boxes, and `lagen run --plot`.
#include "commands/plot/labels.hpp"
#include "commands/plot/panel.hpp"
#include "commands/program.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <regex>

using namespace lagen::testing;
using lagen::Panel;
using lagen::Pen;
using lagen::PlotPoint;
using lagen::SampledCurve;
using lagen::Symbol;
using Strings = std::vector<std::string>;

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// (cos, sin, height) of a whole turn and of each of its parts.
SampledCurve circle(double radius, double height, int parts)
{
    SampledCurve curve;
    for (int k = 0; k <= parts; ++k)
        curve.push_back({radius * std::cos(whole_turn * k / parts), radius * std::sin(whole_turn * k / parts), height});
    return curve;
}

/// What gnuplot is told of one curve with axes of these names.
std::string script_of(const SampledCurve& curve, const Strings& labels, std::optional<bool> sphere = {})
{
    Panel panel;
    panel.curves = {curve};
    panel.legends = {""};
    panel.labels = labels;
    panel.sphere = sphere;
    return lagen::page_script({panel}, "title", "picture.svg");
}

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Numbers "x,y" of all lines of an SVG picture.
std::size_t vertices(const std::string& svg)
{
    static const std::regex vertex("[ML]?[0-9]+\\.[0-9]+,[0-9]+\\.[0-9]+");
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(svg.begin(), svg.end(), vertex), std::sregex_iterator()));
}

} // namespace

TEST_CASE("a curve keeps its ends and what is seen of it, and no more")
{
    const SampledCurve whole = circle(1, 0, 20000);
    const std::vector<SampledCurve> kept = lagen::seen_pieces(whole, lagen::box_of({whole}), Pen::line);
    REQUIRE(kept.size() == 1);
    // A chord of the angle a is r (1 - cos(a/2)) away from its arc: 1/4000 of the breadth 2 r needs 100 of them.
    CHECK((kept[0].size() > 100 && kept[0].size() < 300));
    CHECK((kept[0].front()[0] == 1 && kept[0].back()[0] == Approx(1)));
    for (const PlotPoint& point : kept[0]) CHECK(std::hypot(point[0], point[1]) == Approx(1));
    const SampledCurve line{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}, near{{0, 0, 0}, {1e-5, 0, 0}, {1, 0, 0}};
    CHECK(lagen::seen_pieces(line, lagen::box_of({line}), Pen::line)[0].size() == 2);
    CHECK(lagen::seen_pieces(near, lagen::box_of({near}), Pen::points)[0].size() == 2);
}

TEST_CASE("what is no finite number is a gap of the curve")
{
    SampledCurve curve = circle(1, 0, 8);
    curve[3][1] = NAN;
    const std::vector<SampledCurve> pieces = lagen::seen_pieces(curve, lagen::box_of({curve}), Pen::line);
    REQUIRE(pieces.size() == 2);
    CHECK((pieces[0].size() == 3 && pieces[1].size() == 5));
}

TEST_CASE("labels have LaTeX in characters, texts where there is room, and one unit")
{
    CHECK(lagen::characters_of_latex("\\omega_1") == "ω₁");
    CHECK(lagen::characters_of_latex("\\gamma_{12}") == "γ₁₂");
    CHECK(lagen::characters_of_latex("\\dot\\varphi") == "φ\u0307");
    CHECK(lagen::characters_of_latex("\\hbar").empty());
    CHECK(lagen::characters_of_latex("q^2").empty());
    const Symbol angle{"th", {}, "angle of the rod", "rad", "\\theta"}, first{"x[1]", {}, "", "m", ""};
    const Symbol second{"x[2]", {}, "", "m", ""}, height{"z", {}, "height", "m", ""}, time{"t", {}, "", "s", ""};
    CHECK(lagen::axis_label({angle}) == "angle of the rod, θ [rad]");
    CHECK(lagen::axis_label({{"th", {}, std::string(40, 'm'), "rad", "\\theta"}}) == "θ [rad]");
    CHECK(lagen::axis_label({first, second, first}) == "x [m]");
    CHECK(lagen::axis_label({first, height}) == "x[1], z [m]");
    CHECK(lagen::axis_label({first, angle}) == "x[1], θ");
    CHECK(lagen::axis_label({angle, {"2*sqrt(g/l)*cos(th/2)+2*sqrt(g/l)*cos(th/2)", {}, "", "", ""}}) ==
          "θ [rad], ...");
    CHECK(lagen::axis_label({{"F", {}, "", "kg^2 m/s^-12", ""}}) == "F [kg² m/s⁻¹²]");
    CHECK(lagen::axis_label({{std::string(99, 'q'), {}, "", "", ""}}) == std::string(37, 'q') + "...");
    CHECK(lagen::legends_of({{time, first}, {time, second}}) == Strings{"x[1]", "x[2]"});
    CHECK(lagen::legends_of({{time, first}, {time, angle}}) == Strings{"x[1] [m]", "θ [rad]"});
    CHECK(lagen::legends_of({{first, height}, {second, angle}}) == Strings{"x[1] [m], z [m]", "x[2] [m], θ [rad]"});
    CHECK(lagen::legends_of({{time, first}}) == Strings{""});
    const auto entry = [](const char* name) { return Symbol{name, {}, "", "m", ""}; };
    CHECK(lagen::axis_label({entry("Q[1,2]"), entry("Q[2,2]")}) == "Q[·,2] [m]");
    CHECK(lagen::legends_of({{entry("Q[1,1]"), entry("Q[1,2]")}, {entry("Q[2,1]"), entry("Q[2,2]")}}) ==
          Strings{"Q[1,·]", "Q[2,·]"});
}

TEST_CASE("a curve that keeps its distance from the origin stands on a sphere, its back pale")
{
    // The equator of radius 2 is half in front.
    const std::string equator = script_of(circle(2, 0, 1000), {"a", "b", "c"});
    CHECK_THAT(equator, Catch::Contains("'sphere of radius 2'") && Catch::Contains("set label 'a' at") &&
                            Catch::Contains("set label 'c' at") && Catch::Contains("set view 65,125"));
    const auto front = count_of(equator, " 0x0072b2\n"), back = count_of(equator, " 0xaad0e6\n");
    CHECK((front > 40 && back > 40 && front < back + 10 && back < front + 10));
    // A circle around the axis that points down is seen from below.
    const std::string below = script_of(circle(0.3, -1, 1000), {"a", "b", "c"});
    CHECK_THAT(below, Catch::Contains("set view 115,"));
    CHECK(count_of(below, " 0xaad0e6\n") < count_of(below, " 0x0072b2\n"));
    // One around another centre is in a box, unless a sphere is asked for.
    SampledCurve helix = circle(1, 0, 1000);
    for (std::size_t k = 0; k < helix.size(); ++k) helix[k][2] = 0.001 * static_cast<double>(k);
    CHECK_THAT(script_of(helix, {"a", "b", "c"}), !Catch::Contains("sphere") && Catch::Contains("set zlabel 'c'"));
    CHECK_THAT(script_of(helix, {"a", "b", "c"}, true), Catch::Contains("'sphere of radius 1.41421'"));
    CHECK_THAT(script_of(circle(2, 0, 1000), {"a", "b", "c"}, false), !Catch::Contains("sphere"));
}

TEST_CASE("legends name every curve, however many there are, and stand on the page")
{
    for (const int count : {3, 40}) {
        Panel panel;
        panel.labels = {"t", "x"};
        panel.over_time = true;
        for (int k = 1; k <= count; ++k) {
            panel.curves.push_back({{0, 0, 0}, {1, 0.1 * k, 0}});
            panel.legends.push_back("curve " + std::to_string(k));
        }
        const std::string path = fresh_folder() + "/legend.svg";
        lagen::draw_panels({panel}, "title", path);
        const std::string svg = read_text(path);
        std::smatch size;
        REQUIRE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 900 ([0-9]+)\"")));
        static const std::regex legend("translate\\(([0-9.]+),([0-9.]+)\\)[^>]*>\\s*<text>(?:<[^>]*>)*curve [0-9]+<");
        int found = 0;
        for (std::sregex_iterator at(svg.begin(), svg.end(), legend), end; at != end; ++at, ++found)
            CHECK((std::stod((*at)[1]) < 860 && std::stod((*at)[2]) < std::stod(size[1])));
        CHECK(found == count);
    }
}

TEST_CASE("the rows of a picture go into a pipe, and a terminal is told how to have them", "[run]")
{
    const std::string folder = fresh_folder(), picture = folder + "/a.svg";
    const std::string told = "  picture in " + picture + ": 2 panels, 4 curves";
    const Outcome piped = call({"run", "rotor.toml", "--plot", picture});
    CHECK(piped.out == call({"run", "rotor.toml"}).out);
    CHECK_THAT(piped.err, Catch::EndsWith(told + "\n"));
    // script(1) gives the program a terminal.
    const std::string command = fmt::format("'{}' run rotor.toml --plot '{}'", LAGEN_PROGRAM, picture);
    const Outcome seen = call({"-qec", command, "/dev/null"}, {.program = "/usr/bin/script"});
    CHECK(seen.code == 0);
    CHECK_THAT(seen.out, Catch::Contains(told + "; the rows as CSV: -o FILE.csv, or into a pipe") &&
                             !Catch::Contains("t,x_1") && Catch::Contains("rotor, scene default: ok"));
}

TEST_CASE("columns over time have a panel a unit, and runs of other scenes stand in the same panels", "[run]")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/swing.toml",
               "[base]\ncoordinates = ['r', 'th', 's']\n[algebroid]\nkind = 'tangent'\n[lagrangian]\n"
               "L = '(v_r^2 + r^2*v_th^2 + v_s^2)/2 - r^2/2'\n"
               "[about]\nr = { unit = 'm' }\nth = { unit = 'rad' }\ns = { unit = 'm' }\n"
               "[scene.default]\ninitial = { r = 1, th = 0, s = 0, v_r = 0, v_th = 0.5, v_s = 0.1 }\nduration = 2\n"
               "observe = ['r', 'th', 's']\n[scene.fast]\nlike = 'default'\nobserve = ['th']\n"
               "initial = { r = 1, th = 0, s = 0, v_r = 0, v_th = 1.5, v_s = 0.1 }\n[scene.fast.plot]\n"
               "curves = ['r*cos(th):r*sin(th)']\n");
    const auto draw = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"run", "swing.toml", "--plot", "a.svg"});
        const Outcome outcome = call(options, {.folder = folder});
        CHECK(outcome.code == 0);
        return std::pair(outcome.err, read_text(folder + "/a.svg"));
    };
    const auto [series, lines] = draw({});
    CHECK_THAT(series, Catch::EndsWith(": 2 panels, 3 curves\n"));
    CHECK_THAT(lines, Catch::Contains(">base coordinates [m]<") && Catch::Contains(">th [rad]<"));
    const auto [both, runs] = draw({"--like", "fast", "--scene", "fast", "--scene", "default", "--equal"});
    CHECK_THAT(both, Catch::Contains("swing, scene fast: ok") && Catch::EndsWith(": 1 panel, 2 curves\n"));
    CHECK_THAT(runs, Catch::Contains(">default<") && Catch::Contains(">fast<"));
}

TEST_CASE("a picture is dense whatever the rows are, and the same twice", "[run]")
{
    const std::string folder = fresh_folder();
    const auto draw = [&](const std::string& name) {
        const Outcome outcome =
            call({"run", "rotor.toml", "--plot", folder + "/" + name, "--curves", "x[1]:x[2],[t:x, t:v_x]"});
        CHECK(outcome.code == 0);
        CHECK_THAT(outcome.err, Catch::Contains("2 rows\n") &&
                                    Catch::EndsWith("  picture in " + folder + "/" + name + ": 2 panels, 5 curves\n"));
        return read_text(folder + "/" + name);
    };
    const std::string svg = draw("a.svg");
    CHECK(draw("b.svg") == svg);
    CHECK(vertices(svg) > 100);
    for (const char* text : {">x[1]<", ">x[2]<", ">v_x[2]<", ">t<", ">x[1], x[2], v_x[1], v_x[2]<"})
        CHECK_THAT(svg, Catch::Contains(text));
    CHECK(call({"run", "rotor.toml", "--plot", folder + "/a.svg", "-o", folder + "/a.csv"}).out.empty());
    CHECK_THAT(call({"run", "rotor.toml", "--plot", folder + "/a.svg", "-f", "json"}).out,
               Catch::StartsWith("{\"model\""));
}

TEST_CASE("a graph that hardly leaves its start shows its change", "[run]")
{
    const std::string picture = fresh_folder() + "/a.svg";
    CHECK(call({"run", "rotor.toml", "--plot", picture, "--curves", "t:energy"}).code == 0);
    CHECK_THAT(read_text(picture), Catch::Contains(">change of energy<"));
}

TEST_CASE("the points of a discrete motion and of a section are drawn one by one", "[run]")
{
    const std::string folder = fresh_folder();
    write_text(
        folder + "/steps.toml",
        "[base]\ncoordinates = ['q']\n[groupoid]\nkind = 'pair'\n[discrete]\nstep = 'h'\n"
        "L = '(q_next - q)^2/(2*h) - h*(q^2 + q_next^2)/4'\n[scene.default]\ninitial = { q = 1 }\n"
        "next = { q = 1 }\nstep = 0.5\nsteps = 12\n[scene.default.plot]\ncurves = ['q:p_v_q']\n"
        "[scene.section]\nlike = 'default'\nsample = 1\n[scene.section.plot]\npoints = true\nlike = 'default'\n");
    const auto points = [&](const char* scene) {
        CHECK(call({"run", "steps.toml", "--scene", scene, "--plot", "a.svg"}, {.folder = folder}).code == 0);
        const std::string svg = read_text(folder + "/a.svg");
        std::size_t count = 0;
        for (std::size_t at = 0;
             (at = svg.find("<use xlink:href='#gpPt6' transform='translate", at)) != std::string::npos; ++at)
            ++count;
        return count;
    };
    CHECK(points("default") == 13);
    CHECK(points("section") == 7);
}
