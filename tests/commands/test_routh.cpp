// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen reduce --routh`: the file that it writes, its motions beside those of the whole model, and what is refused.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
namespace json = lagen::json;

namespace {

const std::string angles_of_top = R"toml([parameters]
I1 = 1.5
I3 = 0.9
mgl = 2.2
[base]
coordinates = ["ph", "th", "ps"]
domain = ["I1 > 0", "I3 > 0", "sin(th) > 0"]
[fibre]
coordinates = ["dph", "w", "dps"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "I1*(w^2 + sin(th)^2*dph^2)/2 + I3*(dps + cos(th)*dph)^2/2 - mgl*cos(th)"
[invariants]
spin = "I3*(dps + cos(th)*dph)"
[scene.default]
initial = { ph = 0.2, th = 0.9, ps = 0, w = -0.2, dph = 0.7, dps = 3 }
duration = 8
observe = ["th", "ph", "ps", "w"]
[scene.momenta]
initial = { th = 0.9, ph = 0, ps = 0, p_w = 0.3, p_dph = 2.1, p_dps = 2.4 }
duration = 1
observe = ["th"]
)toml";

/// The names of the checks of a report, with those that are not proved marked by "!".
std::vector<std::string> checks_of(const json::Value& report)
{
    std::vector<std::string> lines;
    for (const json::Value& check : report["checks"].entries)
        lines.push_back((check["status"].text == "proved" ? "" : "!") + check["name"].text + " " +
                        check["indices"][0].text);
    return lines;
}

} // namespace

TEST_CASE("the symmetric top is reduced by both of its angles, and every step of it is proved")
{
    const std::string whole = written_file("top.toml", angles_of_top), reduced = fresh_folder() + "/reduced.toml";
    const Outcome outcome = call({"reduce", whole, "--routh", "ph,ps", "--format", "json", "-o", reduced});
    CHECK(outcome.code == 0);
    const json::Value report = json::parse(outcome.out);
    CHECK(report["verdict"].text == "valid");
    CHECK(checks_of(report) == std::vector<std::string>{"cyclic ph", "cyclic ps", "conserved p_dph", "momentum p_dph",
                                                        "conserved p_dps", "momentum p_dps", "routh w"});
    CHECK(report["routhian"].text == "I1*w^2/2 - p_dph^2/(2*I1*sin(th)^2) + p_dph*p_dps*cos(th)/(I1*sin(th)^2) - "
                                     "p_dps^2*cos(th)^2/(2*I1*sin(th)^2) - p_dps^2/(2*I3) - mgl*cos(th)");
    CHECK(report["file"].text == read_text(reduced));
    CHECK(call({"check", reduced}).out.find("reduced: valid\n") == 0);
    CHECK(call({"reduce", whole, "--routh", "ps, ph"}).out == read_text(reduced));
}

TEST_CASE("gyroscopic terms of a Routhian are there, and the file is one of a whole model's motions")
{
    const std::string coupled = written_file("coupled.toml", R"toml([base]
coordinates = ["x", "y", "z"]
[fibre]
coordinates = ["u", "v", "w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "(u^2 + v^2 + (w + y*u - x*v)^2)/2 - (x^2 + 2*y^2)/2"
[dissipation]
R = "u^2/10"
)toml");
    const Outcome outcome = call({"reduce", coupled, "--routh", "z"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.find("\nL = \"y*u*p_w + u^2/2 + v^2/2 - x^2/2 - x*v*p_w - y^2 - p_w^2/2\"\n") !=
          std::string::npos);
    CHECK(outcome.out.find("\n[states]\nz = \"w\"\n") != std::string::npos);
}

TEST_CASE("a momentum that a force changes is no constant, and nothing is written")
{
    const std::string pushed =
        written_file("pushed.toml", "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = "
                                    "[\"u\", \"v\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\n"
                                    "L = \"(u^2 + v^2)/2\"\n[forces]\nu = \"-v\"\n");
    const Outcome outcome = call({"reduce", pushed, "--routh", "x"});
    CHECK(outcome.code == 1);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.find("refuted: conserved (p_u)") != std::string::npos);
}

TEST_CASE("reduced runs end where those of the whole model do, angles included", "[run]")
{
    for (const auto& [model, angles] : {std::pair(written_file("top.toml", angles_of_top), "ph,ps"),
                                        {models_folder() + "/spherical_pendulum.toml", "ph"}}) {
        const std::string reduced = fresh_folder() + "/reduced.toml";
        REQUIRE(call({"reduce", model, "--routh", angles, "-o", reduced}).code == 0);
        std::vector<json::Value> ends;
        for (const std::string& path : {model, reduced}) {
            const Outcome outcome = done({"run", path, "--tolerance", "1e-13", "--format", "json"});
            ends.push_back(json::parse(outcome.out));
        }
        std::size_t compared = 0;
        for (std::size_t k = 1; k < ends[0]["columns"].size(); ++k)
            for (std::size_t j = 1; j < ends[1]["columns"].size(); ++j) {
                if (ends[0]["columns"][k].text != ends[1]["columns"][j].text) continue;
                const double a = std::stod(ends[0]["rows"].entries.back()[k].text);
                CHECK(std::abs(a - std::stod(ends[1]["rows"].entries.back()[j].text)) <
                      1e-11 * std::max(1.0, std::abs(a)));
                ++compared;
            }
        CHECK(compared >= 3);
    }
}

TEST_CASE("the model that is reduced is not written over")
{
    const std::string path = written_file("top.toml", angles_of_top);
    const Outcome outcome = call({"reduce", path, "--routh", "ph", "-o", path});
    CHECK(outcome.code == 4);
    CHECK(read_text(path) == angles_of_top);
}

TEST_CASE("a scene that starts from momenta gives them to the parameters")
{
    const Outcome outcome = call({"reduce", written_file("top.toml", angles_of_top), "--routh", "ph,ps"});
    CHECK(
        outcome.out.find("[scene.momenta]\ninitial = { th = 0.9, ph = 0, ps = 0, p_w = 0.3 }\nduration = 1\nobserve = "
                         "[\"th\"]\nparameters = { p_dph = \"2.1\", p_dps = \"2.4\" }\n") != std::string::npos);
}

TEST_CASE("where the momenta do not determine the velocities is left out of the domain, and said beside the proof")
{
    const std::string text = R"toml([parameters]
k = 3
m = 2
[base]
coordinates = ["x", "th"]
domain = ["m > 0"]
[fibre]
coordinates = ["v", "w"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v^2/2 + m*x^2*(k - 2)*w^2/2 + v*w - x^2"
[scene.default]
initial = { x = 1, th = 0, v = 0.3, w = 0.7 }
duration = 1
)toml";
    const std::string whole = written_file("loose.toml", text), reduced = fresh_folder() + "/reduced.toml";
    const Outcome outcome = call({"reduce", whole, "--routh", "th", "-o", reduced});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.find("loose: reduced by th: valid\n") == 0);
    CHECK(outcome.err.ends_with("\n  where k - 2 != 0 and x != 0\n"));
    CHECK(read_text(reduced).find("\ndomain = [\"m > 0\", \"k - 2 != 0\", \"x != 0\"]\n") != std::string::npos);
    const Outcome outside = call({"run", reduced, "--set", "k=2"});
    CHECK(outside.code == 3);
    CHECK(outside.err.find("k - 2 != 0 is required") != std::string::npos);
    const json::Value report = json::parse(call({"reduce", whole, "--routh", "th", "--format", "json"}).out);
    for (const json::Value& check : report["checks"].entries) {
        const bool divides = check["name"].text == "momentum" || check["name"].text == "routh";
        REQUIRE(check.has("where") == divides);
        if (divides) CHECK(check["where"].texts() == std::vector<std::string>{"k - 2 != 0", "x != 0"});
    }
    CHECK(call({"reduce", whole, "--routh", "th", "--set", "k=2"}).code == 1);
}

TEST_CASE("a momentum that jumps is constant where it does not")
{
    const std::string whole = written_file("jumping.toml", R"toml([base]
coordinates = ["x", "a"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2 + v_a^2/2 + v_a*abs(x)/x"
)toml");
    const Outcome outcome = call({"reduce", whole, "--routh", "a", "-o", fresh_folder() + "/reduced.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.err.ends_with("\n  where x != 0\n"));
}

TEST_CASE(
    "a determinant that has velocities or the time stands in a comment, and one that algebra finds to be 0 is refused")
{
    const std::string head =
        "[base]\ncoordinates = [\"x\", \"a\"]\n[fibre]\ncoordinates = [\"v\", \"p\"]\n[algebroid]\n"
        "kind = \"tangent\"\n[lagrangian]\n";
    const Outcome moving =
        call({"reduce", written_file("moving.toml", head + "L = \"v^2/2 + t*v^2*p^2/2\"\n"), "--routh", "a"});
    CHECK(moving.code == 0);
    CHECK(moving.err.ends_with("\n  where v != 0 and t != 0\n"));
    CHECK(moving.out.find("# It holds where v != 0 and t != 0.\n") != std::string::npos);
    CHECK(moving.out.find("domain") == std::string::npos);
    const Outcome zero =
        call({"reduce", written_file("zero.toml", head + "L = \"v^2/2 + (sin(x)^2 + cos(x)^2 - 1)*p^2/2 + v*p\"\n"),
              "--routh", "a"});
    CHECK(zero.code == 1);
    CHECK(zero.err.find("do not determine their velocities: det d2L/dy2 is 0 in them\n") != std::string::npos);
}

TEST_CASE("a momentum that depends on the time is that of the start of each scene", "[run]")
{
    const std::string whole = written_file("driven.toml", R"toml([parameters]
k = 2
late = 0.25
[base]
coordinates = ["x", "a"]
[fibre]
coordinates = ["v", "p"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v^2/2 + (1 + x^2)*p^2/2 + p*v*cos(k*t) - x^4"
[scene.default]
initial = { x = 0.6, a = 0.1, v = 0.1, p = 0.4 }
duration = 1
[scene.later]
initial = { x = 0.6, a = 0.1, v = 0.1, p = 0.4 }
start = 1.5
duration = 1
[scene.like_later]
like = "later"
start = "3*late"
[scene.momenta]
initial = { x = 0.6, a = 0.1, p_v = 0.1, p_p = 0.4 }
start = 2
duration = 1
)toml");
    const std::string reduced = fresh_folder() + "/reduced.toml";
    const Outcome outcome = done({"reduce", whole, "--routh", "a", "-o", reduced});
    const std::string text = read_text(reduced);
    for (const char* start : {"cos(k*0)", "cos(k*3/2)", "cos(k*3*late)"}) {
        const std::size_t at = text.find(start, text.find("[scene"));
        REQUIRE(at != std::string::npos);
        CHECK(text.substr(text.rfind('\n', at) + 1).starts_with("parameters = { p_p = \""));
    }
    std::vector<double> ends;
    for (const char* scene : {"default", "later", "like_later", "momenta"}) {
        std::vector<double> x;
        for (const std::string& path : {whole, reduced})
            x.push_back(last_columns(finished_run({path, "--scene", scene, "--tolerance", "1e-13"})).at("x"));
        CHECK(std::abs(x[0] - x[1]) < 1e-11);
        for (const double other : ends) CHECK(std::abs(x[0] - other) > 1e-3);
        ends.push_back(x[0]);
    }
}

TEST_CASE("a cyclic coordinate that algebra has left in L is gone from the Routhian", "[run]")
{
    const std::string whole = written_file("sphere.toml", R"toml([parameters]
m = 2
l = 1.5
[base]
coordinates = ["th", "ph"]
[algebroid]
kind = "tangent"
[definitions]
X = "[l*sin(th)*cos(ph), l*sin(th)*sin(ph), -l*cos(th)]"
[lagrangian]
L = "m*dot(Dt(X), Dt(X))/2 - 9*m*X[3]"
[scene.default]
initial = { th = 1, ph = 0.2, v_th = 0.1, v_ph = 2 }
duration = 2
)toml");
    const std::string reduced = fresh_folder() + "/reduced.toml";
    REQUIRE(call({"reduce", whole, "--routh", "ph", "-o", reduced}).code == 0);
    const std::string text = read_text(reduced);
    const std::size_t L = text.find("L = ");
    CHECK(text.substr(L, text.find('\n', L) - L).find("ph)") == std::string::npos);
    std::vector<double> ends;
    for (const std::string& path : {whole, reduced})
        ends.push_back(last_columns(finished_run({path, "--tolerance", "1e-13"})).at("th"));
    CHECK(std::abs(ends[0] - ends[1]) < 1e-11);
}
