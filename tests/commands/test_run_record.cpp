// SPDX-License-Identifier: GPL-2.0-or-later
/// The second run of a model reads what the first one proved, and proves again what rested on other values.
#include "program.hpp"
#include "scene/run_record.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace lagen::testing;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// A cache of its own with the records that it holds.
struct Cache {
    std::string folder = fresh_folder();

    [[nodiscard]] std::vector<fs::path> records() const
    {
        std::vector<fs::path> found;
        for (const std::string& name : names_in(folder))
            if (name.ends_with(".run")) found.push_back(fs::path(folder) / name);
        return found;
    }
    /// Programs are no records: they are compiled once.
    void take_programs_of(const Cache& other) const
    {
        for (const std::string& name : names_in(other.folder))
            if (!name.ends_with(".run")) fs::copy(other.folder + "/" + name, folder + "/" + name);
    }
    [[nodiscard]] Outcome run(std::vector<std::string> options) const
    {
        options.insert(options.begin(), {"run", "quartic_body.toml", "--at", "2"});
        return call(options, {.environment = {{"LAGEN_CACHE", folder}}});
    }
};

std::string content_of(const fs::path& file)
{
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

} // namespace

TEST_CASE("the second run reads a record; a lost program or a damaged record is made again", "[run]")
{
    const Cache cache;
    const Outcome first = cache.run({});
    REQUIRE(first.code == 0);
    REQUIRE(cache.records().size() == 1);
    const fs::path file = cache.records()[0];
    const std::string record = content_of(file);
    // A word in the record shows who reads it.
    lagen::RunRecord marked = lagen::find_record(file.string()).value();
    const std::string program = marked.program;
    marked.warnings.push_back("this was read");
    lagen::keep_record(file.string(), marked);
    const Outcome second = cache.run({});
    CHECK(second.out == first.out);
    CHECK_THAT(second.err, Catch::StartsWith("warning: this was read\n"));
    const Outcome elsewhere = cache.run({"--initial", "w1=1.25"});
    CHECK_THAT(elsewhere.err, Catch::StartsWith("warning: this was read\n"));
    CHECK(elsewhere.out != first.out);
    CHECK_THAT(cache.run({"--tolerance", "1e-6"}).err, Catch::StartsWith("warning: this was read\n"));
    // A line of comment is no other model.
    const std::string folder = fresh_folder();
    std::ofstream(folder + "/quartic_body.toml")
        << "# A comment\n\n"
        << content_of(models_folder() + "/quartic_body.toml") << "  # and another one\n";
    CHECK(call({"run", "quartic_body.toml", "--at", "2"},
               {.environment = {{"LAGEN_CACHE", cache.folder}}, .folder = folder})
              .err == second.err);
    CHECK(cache.records().size() == 1);
    CHECK(call({"check", "quartic_body.toml"}, {.environment = {{"LAGEN_CACHE", cache.folder}}}).err.empty());

    const auto check_made_again = [&](const char* what) {
        INFO(what);
        const Outcome again = cache.run({});
        CHECK(again.out == first.out);
        CHECK_THAT(again.err, !Contains("this was read"));
        CHECK(content_of(file) == record);
    };
    REQUIRE(fs::remove(program));
    check_made_again("the program is gone");
    std::ofstream(file) << "this was read\n";
    check_made_again("the record is another file");
    lagen::keep_record(file.string(), marked);
    fs::resize_file(file, record.size() / 2);
    check_made_again("the record ends early");
}

TEST_CASE("what a record decided for some values is decided again for others", "[run]")
{
    const Cache cache;
    const Outcome first = cache.run({"--form", "hamilton"}),
                  softer = cache.run({"--form", "hamilton", "--set", "c=1/4"});
    REQUIRE(first.code == 0);
    REQUIRE(softer.code == 0);
    CHECK(first.out != softer.out);
    CHECK(cache.records().size() == 1);
    const Cache other;
    other.take_programs_of(cache);
    CHECK(other.run({"--form", "hamilton", "--set", "c=1/4"}).out == softer.out);
    CHECK(cache.run({"--form", "hamilton"}).out == first.out);
    const Outcome refused = cache.run({"--form", "hamilton", "--set", "c=-3"});
    CHECK(refused.code == 1);
    CHECK(refused.err == other.run({"--form", "hamilton", "--set", "c=-3"}).err);
    // The first run decides for the values that it runs with, as the second does: here that of the file is not asked.
    const Cache lagrange;
    const Outcome once = lagrange.run({"--set", "c=-0.05"});
    REQUIRE(once.code == 0);
    REQUIRE(lagrange.records().size() == 1);
    const std::string decided = content_of(lagrange.records()[0]);
    CHECK(lagrange.run({"--set", "c=-0.04"}).code == 0);
    REQUIRE(lagrange.records().size() == 1);
    CHECK(content_of(lagrange.records()[0]) != decided);
    // Another form has a record of its own.
    CHECK(cache.run({"--method", "tsit5"}).code == 0);
    CHECK(cache.records().size() == 2);
}

TEST_CASE("methods and scenes that ask for the same kernels share a record, of which one with more serves all", "[run]")
{
    const Cache cache;
    const std::string folder = fresh_folder();
    const auto run = [&](std::vector<std::string> options, const std::string& observe = "") {
        std::ofstream(folder + "/m.toml")
            << "name = \"m\"\n[base]\ncoordinates = [\"q\"]\n[fibre]\ncoordinates = [\"v\"]\n[algebroid]\nkind = "
               "\"tangent\"\n[parameters]\nk = 4\n"
               "[lagrangian]\nL = \"v^2/2 - k*q^2/2\"\n[scene.default]\ninitial = { q = 1, v = 0 }\nduration = 2\n"
            << observe << "[scene.other]\ninitial = { q = 1, v = 2 }\nduration = 3\n";
        options.insert(options.begin(), {"run", "m.toml"});
        return call(options, {.environment = {{"LAGEN_CACHE", cache.folder}}, .folder = folder});
    };
    const auto count = [&] { return cache.records().size(); };
    const Outcome first = run({"--method", "radau5"});
    INFO(first.err);
    REQUIRE(first.code == 0);
    REQUIRE(count() == 1); // it has the Jacobian
    for (const std::vector<std::string>& options : {std::vector<std::string>{},
                                                    {"--method", "tsit5"},
                                                    {"--method", "gauss4", "--step", "0.1"},
                                                    {"--scene", "other"},
                                                    {"--initial", "q=2"}})
        CHECK(run(options).code == 0);
    CHECK(count() == 1);
    CHECK(run({"--method", "gauss8", "--step", "0.1"}).code == 0); // calls packs
    CHECK(count() == 2);
    const Outcome shared = run({"--scene", "other"}), observed = run({}, "observe = [\"q\", \"q^2\"]\n");
    CHECK_THAT(observed.out, Contains("q_2"));
    CHECK(count() == 3);
    // What is compiled with more has the same bits.
    const Cache fresh;
    CHECK(
        call({"run", "m.toml", "--scene", "other"}, {.environment = {{"LAGEN_CACHE", fresh.folder}}, .folder = folder})
            .out == shared.out);
}

TEST_CASE("a start that is moved onto its constraints is the same with a record and without", "[run]")
{
    const std::string folder = fresh_folder();
    std::ofstream(folder + "/m.toml") << "name = \"m\"\n[base]\ncoordinates = [\"x\", \"y\", \"z\"]\n"
                                         "constraints = [\"x^2 + y^2 + z^2 - 1\"]\n[fibre]\ncoordinates = [\"w\"]\n"
                                         "[algebroid]\nkind = \"general\"\nanchor = { w = { x = \"-y\", y = \"x\" } }\n"
                                         "[lagrangian]\nL = \"w^2/2\"\n[scene.default]\n"
                                         "initial = { x = 1, y = 0, z = 0.5, w = 1 }\nduration = 1\nproject = true\n";
    const Cache cache;
    const auto run = [&] {
        return call({"run", "m.toml", "--at", "0"}, {.environment = {{"LAGEN_CACHE", cache.folder}}, .folder = folder});
    };
    const Outcome first = run();
    INFO(first.err);
    REQUIRE(first.code == 0);
    CHECK_THAT(first.out, Contains("0.866025") && Contains(",0.5,")); // z is a Casimir, and stays
    CHECK(run().out == first.out);
}

TEST_CASE("the compiler of users makes the rows that clang makes", "[run]")
{
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"heavy_top.toml"}, {"heavy_top.toml", "--form", "hamilton", "--method", "rkmk4"}}) {
        std::vector<std::string> arguments{"run"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        arguments.insert(arguments.end(), {"--at", "1", "--step", "0.05"});
        const Outcome here = call(arguments);
        CHECK(here.code == 0);
        CHECK(call(arguments, {.environment = {{"CXX", ""}, {"CXXFLAGS", ""}}}).out == here.out);
    }
}
