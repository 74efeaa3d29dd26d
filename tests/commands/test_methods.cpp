// SPDX-License-Identifier: GPL-2.0-or-later
/// Methods that are part of lagen: the options with which they are compiled, and their bits beside those of a program.
#include "commands/program.hpp"
#include "machine/compile.hpp"
#include "methods/integrate_compiled.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <utility>

using namespace lagen;
using namespace lagen::testing;
namespace fs = std::filesystem;

TEST_CASE("methods over compiled models are compiled with the options that round every sum by itself")
{
    const std::string commands = read_text(LAGEN_BINARY_DIR "/compile_commands.json");
    std::size_t files = 0;
    for (std::size_t at = commands.find("\"command\""); at != std::string::npos;
         at = commands.find("\"command\"", at + 1)) {
        const std::string line = commands.substr(at, commands.find('\n', at) - at);
        if (line.find("lagen_methods.dir") == std::string::npos) continue;
        ++files;
        for (const std::string& option : rounding_options()) {
            INFO(option);
            CHECK(line.find(" " + option) != std::string::npos);
        }
    }
    CHECK(files > 0);
}

namespace {

struct Asked {
    const char* type;
    std::vector<std::string> method;
    std::string model = "heavy_top", parameter = "mgl";
};

/// The row of a run, in the process, is that of a sweep, by a program.
void check_rows(const std::vector<Asked>& asked)
{
    const std::string folder = fresh_folder();
    for (const auto& [type, method, model, parameter] : asked) {
        INFO(type);
        REQUIRE(integrates_compiled(type));
        const std::string file = std::string(LAGEN_SOURCE_DIR "/models/") + model + ".toml";
        std::vector<std::string> once{"run", file, "--t-end", "3", "--at", "3", "--no-second-run"};
        once.insert(once.end(), method.begin(), method.end());
        once.insert(once.end(), {"--set", parameter + "=1.7"});
        const Outcome run = done(once);
        std::vector<std::string> many{"sweep", file, "--t-end", "3", "--set", parameter + "=1.7:1.7:1", "-o", "a.csv"};
        many.insert(many.end(), method.begin(), method.end());
        const Outcome sweep = done(many, {.folder = folder});
        // A row of the sweep is 0,1.7,t,state..,: the fields behind t are those of the run's only row.
        const std::string row = run.out.substr(run.out.find('\n') + 1);
        const std::string state = row.substr(row.find(',') + 1, row.find('\r') - row.find(',') - 1);
        CHECK_THAT(read_text(folder + "/a.csv"), Catch::Contains("\r\n0,1.7,3," + state + ","));
        fs::remove(folder + "/a.csv");
    }
}

} // namespace

TEST_CASE("the rows of a run by a method of lagen are those of the program of a sweep", "[run]")
{
    check_rows({{"Gauss8", {"--method", "gauss8", "--step", "0.02"}}, {"Taylor", {"--method", "taylor"}}});
    CHECK_FALSE(integrates_compiled("Discrete"));
}

TEST_CASE("the rows of a run are those of the program of a sweep by every kind of method", "[all]")
{
    check_rows({{"Rk4", {"--method", "rk4", "--step", "0.01"}},
                {"Dop853", {"--method", "dop853"}},
                {"Gauss4", {"--method", "gauss4", "--step", "0.01"}},
                {"Radau5", {"--method", "radau5"}},
                {"Yoshida6", {"--method", "yoshida6", "--step", "0.02"}, "pleiades", "m[1]"},
                {"Srkn6", {"--method", "srkn6", "--step", "0.02"}, "kepler", "k"}});
}

TEST_CASE("functions that begin at 0 are followed in the process as they are in a program", "[run]")
{
    const Outcome run =
        call({"run", "pleiades.toml", "--t-end", "0.3", "--at", "0.3", "--no-second-run", "--format", "json"});
    REQUIRE(run.code == 0);
    const json::Value invariants = json::parse(run.out)["invariants"];
    for (const char* name : {"energy", "momentum[1]", "momentum[2]", "angular_momentum"}) {
        INFO(name);
        CHECK(invariants[name]["max_drift"].number() < 1e-9L);
    }
}

TEST_CASE("a model without lanes runs by every kind of method", "[run]")
{
    const std::string path = written_file("none.toml", R"toml([base]
coordinates = []
[fibre]
coordinates = []
[algebroid]
kind = "tangent"
[lagrangian]
L = "1"
[scene.default]
duration = 1
samples = 3
)toml");
    for (const std::vector<std::string>& method : {std::vector<std::string>{"dop853"},
                                                   {"rk4", "--step", "0.25"},
                                                   {"gauss4", "--step", "0.25"},
                                                   {"radau5"},
                                                   {"taylor"}}) {
        INFO(method[0]);
        std::vector<std::string> arguments{"run", path, "--method"};
        arguments.insert(arguments.end(), method.begin(), method.end());
        const Outcome run = done(arguments);
        CHECK(run.out == "t\r\n0\r\n0.5\r\n1\r\n");
    }
}

TEST_CASE("a run with constraints that fails at its start says so", "[run]")
{
    for (const char* method : {"dop853", "radau5", "taylor"}) {
        INFO(method);
        const Outcome run =
            call({"run", "heavy_top.toml", "--method", method, "--tolerance", "1e-18", "--format", "json"});
        INFO(run.err);
        CHECK(run.code == 1);
        const json::Value report = json::parse(run.out);
        CHECK(report["status"].text == "step_too_small");
        CHECK(report["steps"].text == "0");
        CHECK(report["invariants"].size() == 0); // nothing was followed
        CHECK_FALSE(report.has("manifold_distance"));
    }
}
