// SPDX-License-Identifier: GPL-2.0-or-later
/// The command line itself: help, version, and what a slip of the hand gets.
#include "program.hpp"

#include "support/json.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;

namespace {

/// A call that is wrong: nothing on standard output, this on standard error.
void refused(const std::vector<std::string>& arguments, int code, const std::string& text)
{
    const Outcome outcome = call(arguments);
    INFO(text);
    CHECK(outcome.code == code);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == text);
}

} // namespace

TEST_CASE("lagen --version prints the version")
{
    const Outcome outcome = call({"--version"});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Matches("lagen [0-9]+\\.[0-9]+\\.[0-9]+\n"));
    CHECK(outcome.err.empty());
}

TEST_CASE("lagen --help names every command and every exit code, and each command has its own help")
{
    const Outcome whole = call({"--help"});
    CHECK(whole.code == 0);
    CHECK(call({"help"}).out == whole.out);
    for (const std::string command :
         {"check", "derive", "generate", "run", "sweep", "linearize", "models", "methods"}) {
        CHECK(whole.out.find("  " + command + " ") != std::string::npos);
        const Outcome own = call({command, "--help"});
        CHECK(own.code == 0);
        CHECK(own.err.empty());
        const std::string start = "usage: lagen " + command;
        CHECK(own.out.substr(0, start.size()) == start);
        CHECK(own.out.find("--help") != std::string::npos);
    }
    CHECK(whole.out.find("Exit codes: 0 done or proved, 1 the mathematics says no") != std::string::npos);
    const std::string run = call({"run", "--help"}).out;
    CHECK(run.find("dop853") != std::string::npos);
    CHECK(run.find("1e-10") != std::string::npos);
}

TEST_CASE("lagen without arguments prints its help and exits 4")
{
    const Outcome outcome = call({});
    CHECK(outcome.code == 4);
    CHECK(outcome.out == call({"--help"}).out);
}

TEST_CASE("a slip in a command, an option or a choice is answered with the nearest one")
{
    refused({"chek", "pendulum.toml"}, 4, "lagen: unknown command 'chek', did you mean 'check'? (see lagen --help)\n");
    refused({"run", "pendulum.toml", "--methd", "rk4"}, 4,
            "lagen run: unknown option '--methd', did you mean '--method'? (see lagen run --help)\n");
    refused({"run"}, 4, "lagen run: MODEL is missing (see lagen run --help)\n");
    refused({"check"}, 4, "lagen check: MODEL... is missing (see lagen check --help)\n");
    refused({"run", "a.toml", "b.toml"}, 4, "lagen run: unexpected argument 'b.toml' (see lagen run --help)\n");
    refused({"methods", "x"}, 4, "lagen methods: unexpected argument 'x' (see lagen methods --help)\n");
    refused({"run", "pendulum.toml", "--set", "g"}, 4, "lagen run: --set needs name=value, found 'g'\n");
    refused({"run", "pendulum.toml", "--at", ""}, 4, "lagen run: --at needs at least one time, e.g. --at 0,1/2,1\n");
    refused({"derive", "pendulum.toml", "--format", "latx"}, 4,
            "lagen derive: --format is 'latx', it must be one of text, latex, json; did you mean 'latex'?\n");
    refused({"generate", "pendulum.toml", "--form", "lagrnge"}, 4,
            "lagen generate: --form is 'lagrnge', it must be one of lagrange, hamilton, pontryagin, discrete, "
            "first_order; did "
            "you mean 'lagrange'?\n");
    refused({"run", "pendulum.toml", "--form", "newton"}, 4,
            "lagen run: --form is 'newton', it must be one of lagrange, hamilton, pontryagin, discrete, first_order\n");
    refused({"run", "pendulum.toml", "--method", "rk44"}, 4,
            "lagen run: unknown method 'rk44'\nhint: did you mean 'rk4'?\n");
    refused({"run", "pendulum.toml", "--method", "rk4"}, 4,
            "lagen run: method 'rk4' needs a step: give --step, or `step` in scene 'default'\n");
    refused({"run", "pendulum.toml", "--plot", "a.gif"}, 4,
            "lagen run: --plot needs a file that ends in .svg, .png or .pdf, found 'a.gif'\n");
    refused({"generate", "pendulum.toml", "--report=full"}, 4,
            "lagen generate: option '--report' does not take any arguments (see lagen generate --help)\n");
    refused({"generate", "--report", "pendulum.toml", "full"}, 4,
            "lagen generate: unexpected argument 'full' (see lagen generate --help)\n");
    refused({"generate", "pendulum.toml", "--depfile", "a.d"}, 4, "lagen generate: --depfile needs --output\n");
}

TEST_CASE("what the command line says about a model is checked like the model")
{
    refused({"check", "nope.toml"}, 3,
            "error: the model file 'nope.toml' does not exist\nhint: give the path of a .toml file\n");
    refused({"check", "."}, 3, "error: the model file '.' is a folder\nhint: give the path of a .toml file in it\n");
    refused({"run", "pendulum.toml", "--set", "q=1"}, 3,
            "<--set>:1:1: error: the model has no parameter 'q' to set\n  q=1\n  ^\nhint: known parameters: m, l, g\n");
    refused({"run", "pendulum.toml", "--set", "l=zz"}, 3,
            "<--set l>:1:1: error: unknown symbol 'zz'\n  zz\n  ^~\nhint: known names are m, l, g\n");
    refused({"run", "heavy_top.toml", "--set", "g1=3"}, 3,
            "<--set>:1:1: error: 'g1' is a base coordinate, not a parameter\n  g1=3\n  ^~\n"
            "hint: where a scene starts is set by --initial g1=3, of `run` and `sweep`\n");
    refused({"run", "pendulum.toml", "--scene", "deflt"}, 3,
            "error: the model 'pendulum.toml' has no scene 'deflt'\n"
            "hint: known scenes: default, small, rotation, first_turn\n");
    refused({"run", "no_scene.toml"}, 3,
            "no_scene.toml:1:1: error: the model has no scene\n  [base]\n  ^\n"
            "hint: add [scene.default] with initial values and a duration\n");
    refused({"check", "pendulum.toml", "--invariant", "w*"}, 3,
            "<--invariant>:1:3: error: the expression ends after '*' where a number, a name or '(' is required\n"
            "  w*\n    ^\n");
}

TEST_CASE("lagen models lists every example with its scenes")
{
    const Outcome text = call({"models"}, {.environment = {{"LAGEN_MODELS", LAGEN_SOURCE_DIR "/models"}}});
    CHECK(text.code == 0);
    CHECK(text.out.find("\n  kepler                       Planar Kepler problem [default, infall, comet]\n") !=
          std::string::npos);
    const Outcome outcome =
        call({"models", "--format", "json"}, {.environment = {{"LAGEN_MODELS", LAGEN_SOURCE_DIR "/models"}}});
    std::vector<std::string> names;
    const lagen::json::Value list = lagen::json::parse(outcome.out);
    for (const lagen::json::Value& entry : list.entries) {
        names.push_back(entry["model"].text);
        CHECK_FALSE(entry["title"].text.empty());
        CHECK(entry["scenes"].size() >= 1);
    }
    CHECK(names == example_models());
}
