// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen check`: verdicts, exit codes and the JSON of the interface.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;
namespace json = lagen::json;

TEST_CASE("every example model is proved", "[long]")
{
    std::vector<std::string> arguments{"check", "--format", "json"};
    for (const std::string& name : example_models()) arguments.push_back(name + ".toml");
    const Outcome outcome = call(arguments);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    const json::Value list = json::parse(outcome.out);
    REQUIRE(list.size() == example_models().size());
    REQUIRE(list.size() >= 10);
    for (std::size_t k = 0; k < list.size(); ++k) {
        CHECK(list[k]["model"].text == example_models()[k]);
        CHECK(list[k]["verdict"].text == "valid");
        const std::string& regularity = list[k]["regularity"]["status"].text;
        const std::string text = read_text(LAGEN_SOURCE_DIR "/models/" + example_models()[k] + ".toml");
        const bool control = text.find("[control]") != std::string::npos;   // no function whose Hessian is asked about
        const bool discrete = text.find("[discrete]") != std::string::npos; // regular near the arrows 1 alone
        const bool none = control || text.find("[rates]") != std::string::npos;
        INFO(example_models()[k]);
        CHECK(regularity == (none ? "absent" : discrete ? "generically_regular" : "regular"));
    }
}

TEST_CASE("what a subbundle says more is no hint where sections move with time")
{
    const std::string path = fresh_folder() + "/moving.toml";
    const auto checked = [&](const char* constraint, const char* format) {
        write_text(path, "[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n[fibre]\ncoordinates = [\"v_x\", \"v_y\"]\n"
                         "[algebroid]\nkind = \"nonholonomic\"\nof = { kind = \"tangent\" }\nconstraints = [\"" +
                             std::string(constraint) + "\"]\n");
        return call({"check", "--format", format, path}).out;
    };
    const std::string moving = checked("v_z - x*v_x - t*v_y", "text"), fixed = checked("v_z - x*v_x - y*v_y", "text");
    CHECK(moving.find("integrable      yes: brackets of sections lie in their span at each t\n") != std::string::npos);
    CHECK(fixed.find("lie in their span, and kind = \"subbundle\" says more\n") != std::string::npos);
    CHECK(checked("v_z - x*v_x - t*v_y", "json").find("subbundle") == std::string::npos);
    CHECK(checked("v_z - x*v_x - y*v_y", "json").find("subbundle") != std::string::npos);
}

TEST_CASE("a refuted model shows its residual and a witness, and exits 1")
{
    const Outcome outcome = call({"check", "refuted.toml"});
    CHECK(outcome.code == 1);
    CHECK(outcome.out == "refuted: invalid\n"
                         "  1 equation zero by structure, 1 refuted\n"
                         "  anchor          1 refuted\n"
                         "  regularity      regular, rank 2, positive definite\n"
                         "\n"
                         "refuted: anchor (u, v, y)\n"
                         "  component y of [rho(u), rho(v)] - rho([u, v])\n"
                         "  residual 1\n"
                         "  at every point: 1\n"
                         "  hint: [u, v] needs component v = 1/x, given is none; with it all equations of the "
                         "algebroid hold\n");
    const json::Value value = json::parse(call({"check", "refuted.toml", "--format", "json"}).out);
    CHECK(value["verdict"].text == "invalid");
    CHECK(value["trivial"].text == "1");
    const json::Value& check = value["checks"][0];
    CHECK(check["name"].text == "anchor");
    CHECK(check["indices"].texts() == std::vector<std::string>{"u", "v", "y"});
    CHECK(check["status"].text == "refuted");
    CHECK(check["residual"].text == "1");
    CHECK(check["witness"].keys.empty()); // the residual is a number
    CHECK(check["value"].number() == 1);
    CHECK(check["hint"].text ==
          "[u, v] needs component v = 1/x, given is none; with it all equations of the algebroid hold");
}

TEST_CASE("a proved maximum beside an angle says of every control where it is, in text and JSON")
{
    const std::string known =
        "H = a + b cos(th) + c sin(th) is largest at th = atan2(c, b), wherever b or c is not 0; "
        "H is concave in u within its bounds, and largest where dH/du = 0 or at the bound next to that";
    CHECK(call({"check", "climb.toml"}).out == "climb: valid\n"
                                               "  2 equations zero by structure, 1 proved\n"
                                               "  maximum         1 proved\n"
                                               "                  " +
                                                   known + "\n");
    const json::Value value = json::parse(call({"check", "climb.toml", "--format", "json"}).out);
    CHECK(value["checks"][0]["evidence"].text == known);
}

TEST_CASE("a divisor that is zero everywhere is the model's mistake, exit code 3")
{
    const Outcome outcome = call({"check", "zero_divisor.toml"});
    CHECK(outcome.code == 3);
    CHECK(outcome.out.empty());
    CHECK(outcome.err ==
          "zero_divisor.toml:8:18: error: division by sin(q)^2 + cos(q)^2 - 1, which is zero everywhere\n"
          "  height = \"q + 1/(sin(q)^2 + cos(q)^2 - 1)\"\n"
          "                   ^~~~~~~~~~~~~~~~~~~~~~~\n"
          "hint: a divisor must be nonzero somewhere on the domain\n");
}

TEST_CASE("an undecided model exits 2")
{
    const Outcome outcome = call({"check", "undecided.toml", "--format", "json"});
    CHECK(outcome.code == 2);
    const json::Value value = json::parse(outcome.out);
    CHECK(value["verdict"].text == "undecided");
    CHECK(value["checks"][0]["status"].text == "undecided");
    CHECK_FALSE(value["checks"][0].has("witness"));
}

TEST_CASE("a degenerate Lagrangian leaves the verdict as it is")
{
    const Outcome outcome = call({"check", "degenerate.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out == "degenerate: valid\n  regularity      degenerate, rank 0\n                  `generate` and "
                         "`run` refuse a degenerate Lagrangian\n                  kernel vector k_v = 1\n");
    const json::Value value = json::parse(call({"check", "degenerate.toml", "--format", "json"}).out);
    REQUIRE(value["regularity"]["kernel"].size() == 1);
    CHECK(value["regularity"]["kernel"][0].keys == std::vector<std::string>{"v"});
    CHECK(value["regularity"]["kernel"][0]["v"].text == "1");
    const json::Value regular = json::parse(call({"check", "pendulum.toml", "--format", "json"}).out);
    CHECK_FALSE(regular["regularity"].has("kernel"));
}

TEST_CASE("a Lagrangian that is regular at some points only says where it is singular")
{
    const Outcome outcome = call({"check", "gimbal.toml"});
    CHECK(outcome.code == 0);
    CHECK(outcome.out ==
          "gimbal: valid\n  2 equations zero by structure\n  regularity      generically_regular, rank 2\n"
          "                  singular where cos(theta) = 0\n");
    const json::Value singular = json::parse(call({"check", "gimbal.toml", "--format", "json"}).out);
    CHECK(singular["regularity"]["singular_where"].texts() == std::vector<std::string>{"cos(theta)"});
    CHECK(singular["regularity"]["singular_at"].size() == 0);
    const json::Value regular = json::parse(call({"check", "pendulum.toml", "--format", "json"}).out);
    CHECK(regular["regularity"]["singular_where"].size() == 0);
}

TEST_CASE("over several models the exit code is 3 before 1 before 2 before 0, and each is reported")
{
    const auto code = [](const std::vector<std::string>& models) {
        std::vector<std::string> arguments{"check"};
        arguments.insert(arguments.end(), models.begin(), models.end());
        return call(arguments).code;
    };
    CHECK(code({"pendulum.toml", "kepler.toml"}) == 0);
    CHECK(code({"pendulum.toml", "undecided.toml", "kepler.toml"}) == 2);
    CHECK(code({"refuted.toml", "undecided.toml"}) == 1);
    CHECK(code({"undecided.toml", "refuted.toml", "nope.toml", "pendulum.toml"}) == 3);
    const Outcome outcome = call({"check", "nope.toml", "refuted.toml", "pendulum.toml", "--format", "json"});
    const json::Value list = json::parse(outcome.out);
    REQUIRE(list.size() == 3);
    CHECK(list[0]["verdict"].text == "error");
    CHECK(list[0]["model"].text == "nope.toml");
    CHECK(list[1]["verdict"].text == "invalid");
    CHECK(list[2]["verdict"].text == "valid");
    CHECK(outcome.err == "error: the model file 'nope.toml' does not exist\nhint: give the path of a .toml file\n");
}

TEST_CASE("--invariant decides a function from the command line, exactly")
{
    const auto verdict = [](const std::string& expression) {
        const Outcome outcome = call({"check", "kepler.toml", "--invariant", expression, "--format", "json"});
        return std::pair(outcome.code, json::parse(outcome.out)["verdict"].text);
    };
    CHECK(verdict("x*v - y*u") == std::pair(0, std::string("valid")));
    CHECK(verdict("u^2 + v^2 - 2*k/r") == std::pair(0, std::string("valid")));
    CHECK(verdict("u^2 + v^2 - 2.000000000000000000001*k/r") == std::pair(1, std::string("invalid")));
    const Outcome outcome = call({"check", "kepler.toml", "--invariant", "x*p_v - y*p_u"});
    CHECK(outcome.code == 0); // momenta may stand there too
}

TEST_CASE("what jumps although its rate vanishes is valid, and says where it is proved")
{
    const std::vector<std::string> claims{
        "check",       "oscillator.toml",  "--invariant", "energy",
        "--invariant", "t - atan2(-v, x)", "--invariant", "abs(x*v)/(x*v) - 2*energy"};
    const Outcome outcome = call(claims);
    CHECK(outcome.code == 0);
    CHECK(outcome.out ==
          "oscillator: valid\n"
          "  3 proved\n"
          "  invariant       3 proved\n"
          "                  t - atan2(-v, x) where v != 0; may change where a motion crosses\n"
          "                  abs(x*v)/(x*v) - 2*energy where x != 0 and v != 0; may change where a motion "
          "crosses\n"
          "  regularity      regular, rank 1, positive definite\n");
    std::vector<std::string> as_json = claims;
    as_json.insert(as_json.end(), {"--format", "json"});
    const json::Value value = json::parse(call(as_json).out);
    CHECK(value["verdict"].text == "valid");
    CHECK_FALSE(value["checks"][0].has("where"));
    CHECK(value["checks"][1]["status"].text == "proved");
    CHECK(value["checks"][1]["where"].texts() == std::vector<std::string>{"v != 0"});
    CHECK(value["checks"][2]["where"].texts() == std::vector<std::string>{"x != 0", "v != 0"});
    CHECK(value["checks"][2]["residual"].text == "0");
}
