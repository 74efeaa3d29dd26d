// SPDX-License-Identifier: GPL-2.0-or-later
/// Every mistake of tests/errors gets its exact text, and the mistakes that no file can hold get theirs here.
#include "model/read_model.hpp"
#include "scene/evaluate_scene.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

const fs::path folder = fs::path(LAGEN_SOURCE_DIR) / "tests" / "errors";

std::string content(const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// The rendered error of a model, "" where there is none.
std::string error_of(const std::string& name, const std::string& text)
{
    try {
        const lagen::Model model = lagen::read_model_text(name, text);
        for (const lagen::Scene& scene : model.scenes) (void)lagen::evaluate_scene(model, scene);
    } catch (const lagen::ModelError& error) {
        return std::string(error.what()) + "\n";
    }
    return "";
}

std::string error_of_file(const fs::path& path)
{
    try {
        (void)lagen::read_model(path.string());
    } catch (const lagen::ModelError& error) {
        return error.diagnostic().message;
    }
    return "";
}

std::string tangent_model(const std::string& lagrangian)
{
    return "[base]\ncoordinates = [\"q\"]\n[algebroid]\nkind = \"tangent\"\n[lagrangian]\nL = '" + lagrangian + "'\n";
}

} // namespace

TEST_CASE("every bad model gets the text beside it")
{
    std::vector<fs::path> models;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".toml") models.push_back(entry.path());
    }
    std::sort(models.begin(), models.end());
    REQUIRE(models.size() >= 60);
    for (const fs::path& model : models) {
        std::string found;
        try {
            found = error_of(model.filename().string(), content(model));
        } catch (const lagen::InternalError&) {
            continue; // a level set asks for a frame, which another room makes: tests/errors reads it
        }
        INFO(model.filename().string() << " gave:\n" << found);
        const fs::path text = fs::path(model).replace_extension(".txt");
        if (std::getenv("LAGEN_UPDATE_GOLDEN") != nullptr) std::ofstream(text, std::ios::binary) << found;
        CHECK(found == content(text));
        CHECK(!found.empty());
    }
}

TEST_CASE("a missing file and a folder are named for what they are")
{
    CHECK(error_of_file("/no/such/model.toml") == "the model file '/no/such/model.toml' does not exist");
    CHECK(error_of_file(folder) == "the model file '" + folder.string() + "' is a folder");
}

TEST_CASE("a file above 16 MiB is refused without being parsed")
{
    CHECK(error_of_file("/dev/zero") == "the model file '/dev/zero' is larger than 16 MiB");
}

TEST_CASE("a million nested parentheses are one error that names the bound")
{
    const std::string deep = std::string(1'000'000, '(') + "q" + std::string(1'000'000, ')');
    CHECK_THAT(error_of("deep.toml", tangent_model(deep)), Contains("deep.toml:6:"));
    const std::string nested = std::string(400'000, '(') + "q" + std::string(400'000, ')');
    CHECK_THAT(error_of("deep.toml", tangent_model(nested)), Contains("256"));
}

TEST_CASE("nested arrays end in an error, not in a crash")
{
    CHECK_THAT(error_of("deep.toml", "a = " + std::string(100'000, '[')), Contains("not valid TOML"));
}

TEST_CASE("the stem of the file names the model where it can")
{
    const std::string text = tangent_model("v_q^2/2");
    CHECK(lagen::read_model_text("some/where/swing.toml", text).name == "swing");
    CHECK_THAT(error_of("my model.toml", text),
               Contains("the file's stem 'my model', which names the model, is not a C++ identifier"));
    CHECK_THAT(error_of("2d.toml", text), Contains("the file's stem '2d'"));
}

TEST_CASE("a title may hold anything printable")
{
    const std::string title = R"(title = '*/ #include "x" \ \n // ?>' )";
    CHECK(lagen::read_model_text("m.toml", title + "\n" + tangent_model("0")).title == R"(*/ #include "x" \ \n // ?>)");
}

TEST_CASE("more than 4096 names are refused")
{
    std::string text = "[parameters]\n";
    for (int k = 0; k < 5000; ++k) text += "a" + std::to_string(k) + " = 1\n";
    CHECK_THAT(error_of("m.toml", text + tangent_model("0")), Contains("the model declares more than 4096 names"));
}

TEST_CASE("a model has at most 200 scenes, a scene 1000 events and 100000 times")
{
    const std::string scene = "initial = { q = 0, v_q = 0 }\nduration = 1\n";
    std::string scenes = tangent_model("v_q^2/2"), events = scenes + "[scene.a]\n" + scene + "[scene.a.events]\n";
    std::string times = scenes + "[scene.a]\n" + scene + "at = [0";
    for (int k = 0; k < 201; ++k) scenes += "[scene.a" + std::to_string(k) + "]\n" + scene;
    for (int k = 0; k < 1001; ++k) events += "e" + std::to_string(k) + " = { when = 'q' }\n";
    for (int k = 0; k < 100'000; ++k) times += ", 0";
    CHECK_THAT(error_of("m.toml", scenes), Contains(": error: [scene] has 201 scenes, more than 200\n"));
    CHECK_THAT(error_of("m.toml", events),
               Contains(": error: 'events' of scene 'a' has 1001 events, more than 1000\n"));
    CHECK_THAT(error_of("m.toml", times + "]\n"),
               Contains(": error: 'at' of scene 'a' has 100001 times, more than 100000\n"));
}

TEST_CASE("a setting must name a parameter and have a value over parameters")
{
    const std::string text = "[parameters]\nmass = 1\n" + tangent_model("mass*v_q^2/2");
    const auto error = [&](const char* name, const char* value) -> std::string {
        try {
            (void)lagen::read_model_text("m.toml", text, {{name, lagen::whole_text("<--set>", value)}});
        } catch (const lagen::ModelError& e) {
            return e.diagnostic().message + " | " + e.diagnostic().hint;
        }
        return "";
    };
    CHECK(error("mas", "2") == "the model has no parameter 'mas' to set | did you mean 'mass'?");
    CHECK(error("q", "2") == "'q' is a base coordinate, not a parameter | where a scene starts is set by "
                             "--initial q=2, of `run` and `sweep`");
    CHECK(error("mass", "q") ==
          "the value set for parameter 'mass' may not depend on a base coordinate ('q') | allowed here: parameters");
    CHECK(error("mass", "2*mass") ==
          "the parameters depend on each other in a cycle: mass -> mass | give one of them a value of its own");
}

TEST_CASE("a mistake at the end of a line of a million characters is found at its column")
{
    std::string line = "parameters = { ";
    for (int k = 0; k < 2500; ++k) line += "a" + std::to_string(k) + " = '1" + std::string(400, ' ') + "', ";
    const std::string place = "m.toml:1:" + std::to_string(line.size() + 5);
    CHECK(line.size() > 1'000'000);
    CHECK_THAT(error_of("m.toml", line + "z = true }\n" + tangent_model("0")),
               Catch::StartsWith(place + ": error: the parameter 'z'"));
}
