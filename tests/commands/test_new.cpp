// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen new`: models to start from, of every kind.
#include "commands/program.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>

using namespace lagen::testing;

namespace {

using KindList = std::vector<std::string>;

/// What `--kind` takes, by the error of a kind that it does not take.
KindList kinds_of_new()
{
    const std::string text = call({"new", "swing", "--kind", "?"}).err;
    KindList kinds;
    static const std::regex word("[a-z_]+");
    const std::size_t list = text.find("one of ") + 7;
    for (std::sregex_iterator at(text.begin() + static_cast<std::ptrdiff_t>(list), text.end(), word), end; at != end;
         ++at)
        kinds.push_back(at->str());
    return kinds;
}

} // namespace

TEST_CASE("there is a model to start from of every kind, and lagen check proves it")
{
    const KindList kinds = kinds_of_new();
    // README lists the kinds in the first column of a table.
    const std::string readme = read_text(LAGEN_SOURCE_DIR "/README.md");
    const std::size_t table = readme.find("| kind | keys | is |"), end = readme.find("\n\n", table);
    REQUIRE(end != std::string::npos);
    std::size_t rows = 0;
    for (std::size_t at = table; (at = readme.find("\n| `", at)) < end; ++at, ++rows) {
        const std::string kind = readme.substr(at + 4, readme.find('`', at + 4) - at - 4);
        INFO(kind);
        CHECK(std::ranges::find(kinds, kind) != kinds.end());
    }
    CHECK(rows == 12);
    CHECK(kinds.size() == rows + 2); // discrete and control
    const std::string folder = fresh_folder();
    for (const std::string& kind : kinds) {
        INFO(kind);
        const Outcome made = call({"new", "my_" + kind, "--kind", kind}, {.folder = folder});
        CHECK(made.code == 0);
        CHECK_THAT(made.out, Catch::Contains("my_" + kind + ".toml\n"));
        const std::string text = read_text(folder + "/my_" + kind + ".toml");
        CHECK_THAT(text, Catch::StartsWith("#:schema lagen.schema.json\n# Made by `lagen new my_" + kind + " --kind " +
                                           kind + "`. Next:\n#   lagen check my_" + kind + ".toml\n") &&
                             !Catch::Contains("NAME"));
        const Outcome checked = call({"check", "my_" + kind + ".toml"}, {.folder = folder});
        CHECK(checked.code == 0);
        CHECK(checked.err.empty());
    }
}

TEST_CASE("a new model overwrites nothing, and its name is that of a class")
{
    const std::string folder = fresh_folder();
    CHECK(call({"new", "planet", "--kind", "product"}, {.folder = folder}).out ==
          "planet.toml\nplanet_body.toml\nplanet_orbit.toml\nlagen.schema.json\n");
    CHECK(read_text(folder + "/lagen.schema.json") == call({"schema"}).out);
    const std::string text = read_text(folder + "/planet.toml");
    CHECK_THAT(text, Catch::Contains("of = [\"planet_orbit.toml\", \"planet_body.toml\"]"));
    write_text(folder + "/other_orbit.toml", "");
    for (const char* name : {"planet", "other"}) {
        const Outcome again = call({"new", name, "--kind", "product"}, {.folder = folder});
        CHECK(again.code == 4);
        CHECK(again.out.empty());
        CHECK_THAT(again.err, Catch::EndsWith(".toml' is there already, and is not overwritten\n"));
    }
    CHECK(read_text(folder + "/planet.toml") == text);
    CHECK(names_in(folder) == KindList{"lagen.schema.json", "other_orbit.toml", "planet.toml", "planet_body.toml",
                                       "planet_orbit.toml"}); // no half of `other`
    CHECK(call({"new", "two words"}, {.folder = folder}).err ==
          "<NAME>:1:1: error: the model name 'two words' is not a C++ identifier\n  two words\n  ^~~~~~~~~\n"
          "hint: use letters, digits and '_', with no digit first, e.g. \"heavy_top\"\n");
    write_text(folder + "/heavy_top.toml", "");
    CHECK(call({"new", "moon"}, {.environment = {{"LAGEN_MODELS", folder}}, .folder = folder}).err ==
          "error: the models to start from were not found\nhint: set LAGEN_MODELS to the folder of the example models, "
          "which has them in new/\n");
}

TEST_CASE("a new model runs", "[run]")
{
    const std::string folder = fresh_folder();
    CHECK(call({"new", "swing"}, {.folder = folder}).code == 0);
    const Outcome run = call({"run", "swing.toml", "-o", "swing.csv", "--plot", "swing.svg"}, {.folder = folder});
    CHECK(run.code == 0);
    CHECK_THAT(run.err, Catch::Contains("swing, scene default: ok") && !Catch::Contains("warning"));
}

TEST_CASE("a new model of every kind runs", "[all]")
{
    const std::string folder = fresh_folder();
    for (const std::string& kind : kinds_of_new()) {
        INFO(kind);
        CHECK(call({"new", kind + "_model", "--kind", kind}, {.folder = folder}).code == 0);
        const Outcome run = call({"run", kind + "_model.toml", "-o", "/dev/null"}, {.folder = folder});
        CHECK(run.code == 0);
        CHECK_THAT(run.err, Catch::Contains(": ok at t = ") && !Catch::Contains("warning"));
    }
}
