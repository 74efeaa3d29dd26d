// SPDX-License-Identifier: GPL-2.0-or-later
/// Pictures of runs: curves with no more points than are seen, labels, spheres and boxes, and `lagen run --plot`.
#include "commands/plot/labels.hpp"
#include "commands/plot/page.hpp"
#include "commands/plot/panel.hpp"
#include "commands/plot/projection.hpp"
#include "commands/plot/thinned.hpp"
#include "commands/plot/ticks.hpp"
#include "commands/program.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <regex>

using namespace lagen::testing;
using lagen::PanelRequest;
using lagen::Polyline;
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

/// A curve with coordinates of these names.
PanelRequest panel(const SampledCurve& curve, const Strings& names)
{
    PanelRequest request;
    request.curves = {curve};
    request.symbols.emplace_back();
    for (const std::string& name : names) request.symbols[0].push_back({name, {}, {}, {}, {}});
    return request;
}

/// The points of the strokes whose style has `part` in it.
std::size_t points_in(const lagen::Drawing& drawing, const std::string& part)
{
    std::size_t count = 0;
    for (const lagen::Stroke& stroke : drawing.strokes)
        if (stroke.style.find(part) != std::string::npos)
            for (const Polyline& line : stroke.lines) count += line.size();
    return count;
}

/// Numbers "x,y" of all lines of an SVG picture.
std::size_t vertices(const std::string& svg)
{
    static const std::regex vertex("[ML]?[0-9]+\\.[0-9]+,[0-9]+\\.[0-9]+");
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(svg.begin(), svg.end(), vertex), std::sregex_iterator()));
}

constexpr const char* blue = "lines linecolor rgb '#0072b2'";
constexpr const char* pale_blue = "#aad0e6";

} // namespace

TEST_CASE("a curve keeps its ends and what is seen of it, and no more")
{
    const lagen::Polyline whole = lagen::pieces_of(circle(1, 0, 20000))[0];
    const lagen::Polyline kept = lagen::thinned(whole, {200, 200});
    // A chord of the angle a is r (1 - cos(a/2)) away from its arc: 0.15 of 200 pixels need 57 of them.
    CHECK((kept.size() > 57 && kept.size() < 200));
    CHECK((kept.front().x == 1 && kept.back().x == Approx(1)));
    for (const lagen::Point& point : kept) CHECK(std::hypot(point.x, point.y) == Approx(1));
    CHECK(lagen::thinned(whole, {2000, 2000}).size() > kept.size() + 100);
    CHECK(lagen::thinned({{0, 0}, {1, 1}, {2, 2}, {3, 3}}, {100, 100}).size() == 2);
    CHECK(lagen::distinct({{0, 0}, {0.001, 0}, {0.1, 0}, {0, 0.0001}}, {100, 100}).size() == 2);
}

TEST_CASE("what is no finite number is a gap of the curve")
{
    SampledCurve curve = circle(1, 0, 8);
    curve[3][1] = NAN;
    const std::vector<Polyline> pieces = lagen::pieces_of(curve);
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
    CHECK(lagen::axis_label({angle}, 500, true) == "angle of the rod, θ [rad]");
    CHECK(lagen::axis_label({angle}, 60, true) == "θ [rad]");
    CHECK(lagen::axis_label({angle}, 30, true) == "θ");
    CHECK(lagen::axis_label({first, second, first}, 500, true) == "x [m]");
    CHECK(lagen::axis_label({first, height}, 500, true) == "x[1], z [m]");
    CHECK(lagen::axis_label({first, angle}, 500, true) == "x[1], θ");
    const Symbol formula{"2*sqrt(g/l)*cos(th/2)", {}, "", "", ""};
    CHECK(lagen::axis_label({angle, formula}, 160, true) == "θ [rad], ...");
    CHECK(lagen::axis_label({{"F", {}, "", "kg^2 m/s^-12", ""}}, 500, true) == "F [kg² m/s⁻¹²]");
    CHECK(lagen::legends_of({{time, first}, {time, second}}) == Strings{"x[1]", "x[2]"});
    CHECK(lagen::legends_of({{time, first}, {time, angle}}) == Strings{"x[1] [m]", "θ [rad]"});
    CHECK(lagen::legends_of({{first, height}, {second, angle}}) == Strings{"x[1] [m], z [m]", "x[2] [m], θ [rad]"});
    CHECK(lagen::legends_of({{time, first}}) == Strings{""});
    const auto entry = [](const char* name) { return Symbol{name, {}, "", "m", ""}; };
    CHECK(lagen::axis_label({entry("Q[1,2]"), entry("Q[2,2]")}, 500, true) == "Q[·,2] [m]");
    CHECK(lagen::legends_of({{entry("Q[1,1]"), entry("Q[1,2]")}, {entry("Q[2,1]"), entry("Q[2,2]")}}) ==
          Strings{"Q[1,·]", "Q[2,·]"});
    CHECK(lagen::shortened("abcdefghijklmnopqrstuvwxyz", 80) == "abcdefg...");
    CHECK(lagen::text_width(lagen::shortened(std::string(200, 'm'), 300)) <= 300);
}

TEST_CASE("numbers at an axis are round")
{
    CHECK(lagen::round_ticks(0, 1) == std::vector<double>{0, 0.2, 0.4, 0.6000000000000001, 0.8, 1});
    CHECK(lagen::round_ticks(-3, 5) == std::vector<double>{-2, 0, 2, 4});
    CHECK(lagen::round_ticks(1, 1).empty());
}

TEST_CASE("a graph that hardly leaves its start shows its change")
{
    SampledCurve curve;
    for (int k = 0; k <= 100; ++k) curve.push_back({0.1 * k, 5 + 1e-9 * std::sin(0.1 * k), 0});
    const lagen::Drawing drawing = lagen::draw_in_plane(panel(curve, {"t", "energy"}));
    CHECK(drawing.over_time);
    CHECK(drawing.y_label == "change of energy");
    CHECK(drawing.box.high.y == Approx(1e-9).epsilon(1e-2));
    CHECK(lagen::draw_in_plane(panel(curve, {"x", "energy"})).y_label == "energy");
}

TEST_CASE("a curve that keeps its distance from the origin stands on a sphere, its back pale")
{
    // The equator of radius 2 is half in front.
    const lagen::Drawing drawing = lagen::draw_in_space(panel(circle(2, 0, 1000), {"a", "b", "c"}));
    CHECK(drawing.x_label == "sphere of radius 2");
    REQUIRE(drawing.marks.size() == 3);
    CHECK((drawing.marks[0].text == "a" && drawing.marks[2].text == "c"));
    CHECK(std::abs(static_cast<int>(points_in(drawing, blue)) - 501) < 3);
    CHECK(std::abs(static_cast<int>(points_in(drawing, pale_blue)) - 501) < 3);
    // A circle around the axis that points down is seen from below.
    CHECK(points_in(lagen::draw_in_space(panel(circle(0.3, -1, 1000), {"a", "b", "c"})), pale_blue) < 200);
    // One around another centre is in a box, unless a sphere is asked for.
    PanelRequest helix = panel(circle(1, 0, 1000), {"a", "b", "c"});
    for (std::size_t k = 0; k < helix.curves[0].size(); ++k) helix.curves[0][k][2] = 0.001 * static_cast<double>(k);
    CHECK(lagen::draw_in_space(helix).x_label.empty());
    helix.sphere = true;
    CHECK(lagen::draw_in_space(helix).x_label == "sphere of radius 1.41421");
    helix = panel(circle(2, 0, 1000), {"a", "b", "c"});
    helix.sphere = false;
    CHECK(lagen::draw_in_space(helix).x_label.empty());
}

TEST_CASE("legends name every curve, beside the panel or below it in columns, and stay on the page")
{
    // Right edges of all texts of a legend, with the height of the page behind them.
    const auto right_edges = [](const std::vector<std::string>& names, std::size_t& entries) {
        PanelRequest request;
        for (std::size_t k = 0; k < names.size(); ++k) {
            request.curves.push_back({{0, 0, 0}, {1, 0.1 * static_cast<double>(k), 0}});
            request.symbols.push_back({Symbol{"t", {}, "", "", ""}, Symbol{names[k], {}, "", "", ""}});
        }
        const std::string path = fresh_folder() + "/legend.svg";
        lagen::draw_page({lagen::draw_in_plane(request)}, std::string(300, 'T'), path);
        const std::string svg = read_text(path);
        CHECK_THAT(svg, Catch::Contains("TTT...<"));
        std::smatch size;
        REQUIRE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 900 ([0-9]+)\"")));
        static const std::regex legend(
            "translate\\(([0-9.]+),([0-9.]+)\\)[^>]*start[^>]*>\\s*<text>(?:<[^>]*>)*(curve[^<]*)<");
        std::vector<double> edges;
        for (std::sregex_iterator at(svg.begin(), svg.end(), legend), end; at != end; ++at) {
            edges.push_back(std::stod((*at)[1]) + lagen::text_width((*at)[3]));
            CHECK(std::stod((*at)[2]) < std::stod(size[1]));
        }
        entries = edges.size();
        return edges;
    };
    std::size_t entries = 0;
    const std::vector<std::string> few{"curve 1", "curve 2", "curve 3"};
    for (const double edge : right_edges(few, entries)) CHECK((edge > 800 && edge <= 900));
    CHECK(entries == 3);
    std::vector<std::string> many, broad; // more than one column holds; names up to the breadth of the page and beyond
    for (int k = 1; k <= 40; ++k) {
        many.push_back("curve " + std::to_string(k));
        broad.push_back("curve_" + std::string(static_cast<std::size_t>(2 * k), 'm') + std::to_string(k));
    }
    for (const auto& names : {many, broad}) {
        for (const double edge : right_edges(names, entries)) CHECK(edge <= 900);
        CHECK(entries == 40);
    }
}

TEST_CASE("the axes of the usual view point to the left and down, to the right, and up")
{
    const lagen::PictureProjection project(lagen::usual_azimuth, lagen::usual_elevation);
    CHECK((project({1, 0, 0}).x < 0 && project({1, 0, 0}).y < 0));
    CHECK((project({0, 1, 0}).x > 0 && project({0, 0, 1}).y > 0));
    const lagen::Vector eye = project.towards();
    CHECK(lagen::length(eye) == Approx(1));
    CHECK((std::fabs(project(eye).x) < 1e-15 && std::fabs(project(eye).y) < 1e-15));
    CHECK(project.depth(eye) == Approx(1));
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
