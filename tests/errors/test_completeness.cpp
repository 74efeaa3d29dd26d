// SPDX-License-Identifier: GPL-2.0-or-later
/// No message without an example: the texts of generator/ against tests/errors and the literals of all other tests.
#include "errors/examples.hpp"
#include "errors/source_texts.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

using namespace lagen::errors;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> sources_below(const std::string& folder)
{
    std::vector<std::string> paths;
    for (const auto& entry : fs::recursive_directory_iterator(std::string(LAGEN_SOURCE_DIR) + "/" + folder))
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp")
            paths.push_back(entry.path().string());
    std::ranges::sort(paths);
    return paths;
}

/// Texts with which lagen can be shown to say something: the examples, and what the tests of the rooms assert.
std::vector<std::string> shown_texts()
{
    std::vector<std::string> texts;
    for (const Example& example : read_examples()) texts.push_back(example.text);
    for (const std::string& path : sources_below("tests")) {
        if (path.find("/tests/errors/") != std::string::npos) continue;
        for (SourceText& literal : string_literals(lagen::testing::read_text(path)))
            texts.push_back(std::move(literal.text));
    }
    return texts;
}

bool is_called(const SourceText& literal, const char* ending)
{
    return std::ranges::any_of(literal.calls, [&](const std::string& call) { return call.ends_with(ending); });
}

/// In two rooms nearly every sentence is a message; in the others only what an error is made from counts. What graph,
/// proof and symbolic throw ends in a verdict as its reason, not before the user.
bool is_message(const std::string& path, const SourceText& literal)
{
    const auto in = [&](const char* room) { return path.find(std::string("/generator/") + room) != std::string::npos; };
    const bool sentence = word_count(literal.text) >= 3 && literal.text.find(' ') != std::string::npos;
    if (!sentence || is_called(literal, "InternalError")) return false;
    const bool documents = path.ends_with("/schema_table.cpp") && !is_called(literal, "like") &&
                           !literal.text.starts_with("source = ");         // `lagen schema` prints it
    if (documents || literal.text.starts_with(" EOF FILE ")) return false; // or it is no sentence
    if (in("graph/") || in("proof/") || in("symbolic/")) return false;
    return in("expression/") || in("model/") || is_called(literal, "Error") || is_called(literal, "refuse") ||
           is_called(literal, "fail");
}

/// Pieces of messages that never stand alone, and guards of a room against callers that the rooms before it rule out.
constexpr std::array guards{
    " moving base coordinates, but the fibre has ",
    "; may use every name of the model", // of `lagen schema`
    "Error while parsing ",
    "a built-in quantity",
    "a vector has one entry at least",
    "an array has no entries",
    "an entry is named x[3] or W[1,2]",
    "an unknown place",
    "end of the expression",
    "give [fibre] one coordinate for each base coordinate that moves",
    "has a zero byte in its name",
    "the tangent algebroid has ",
};

/// Messages for which no model is known.
constexpr std::array without_model{
    "it could not be shown that the sections of the subbundle are linearly independent somewhere",
    "not shown to be a combination of the generators",
    "the arrow of a step cannot be solved for; let L depend on the arrow in every direction", // of kernels too long to
                                                                                              // read
};

/// Messages of a machine in trouble, or with paths of the machine in them.
constexpr std::array of_the_machine{
    "CXXFLAGS holds {}, with which a program cannot see that a number is not finite and loses its compensated sums",
    "Eigen's headers (Eigen/Core) were not found",
    "a program of the chart ended with exit code {}\n{}",
    "cannot be opened: {}",
    "cannot be read to its end",
    "cannot make a folder in '{}': {}",
    "cannot make a pipe: {}",
    "cannot wait for a child process: {}",
    "gnuplot failed with exit code {}\n{}",
    "it is installed with lagen, in share/lagen/program beside bin/",
    "lagen: interrupted while drawing",
    "lagen: interrupted, nothing was written",
    "leave it out; -O3 -march=native is as fast here",
    "remove '{}' to have it compiled again",
    "set LAGEN_CACHE",
    "set LAGEN_EIGEN_INCLUDE to the folder that holds Eigen/",
    "set LAGEN_INCLUDE to the folder that holds lagen/",
    "set LAGEN_MODELS to their folder",
    "the C++ compiler '{}' could not be started: {}",
    "the C++ compiler failed with exit code {}\n{}\n{}{}",
    "the compiled model could not be loaded: {}",
    "the compiled scene could not be started: {}",
    "the compiled scene ended with exit code {}\n{}",
    "the example models were not found",
    "the program of `run` (lagen_run/driver.hpp) was not found",
    "the runtime's headers (lagen/kernel.hpp) were not found",
    "there is nothing to plot: the run gave no rows",
    "{}\nand neither is '{}': {}",
};

} // namespace

TEST_CASE("the literals of a source are found with the calls around them")
{
    const std::vector<SourceText> found = string_literals("#include \"a.hpp\"\n// \"b\"\nthrow Error(f(\"one {} \"\n  "
                                                          "\"two\\n\", '\"', 1'000), x) + \"three\"; R\"(fo\\ur)\"");
    REQUIRE(found.size() == 3);
    CHECK(found[0].text == "one {} two\n");
    CHECK(found[0].calls == std::vector<std::string>{"Error", "f"});
    CHECK(found[1].text == "three");
    CHECK(found[1].calls.empty());
    CHECK(found[2].text == "fo\\ur");
}

TEST_CASE("an example is known by the parts of its format, in their order")
{
    CHECK(is_made_from("error: the size 'n' is 5000, where", fixed_parts("the size {} is {}, where")));
    CHECK_FALSE(is_made_from("is 5000, where the size", fixed_parts("the size {} is {}, where")));
    CHECK(is_made_from("x = { y }", fixed_parts("x = {{ {} }}")));
    CHECK(word_count("{} is {:02x} bytes, at most") == 4);
}

TEST_CASE("every message of the generator has an example")
{
    const std::vector<std::string> shown = shown_texts();
    std::size_t messages = 0;
    std::vector<std::string> found;
    for (const std::string& path : sources_below("generator")) {
        for (const SourceText& literal : string_literals(lagen::testing::read_text(path))) {
            if (!is_message(path, literal)) continue;
            ++messages;
            const std::vector<std::string> parts = fixed_parts(literal.text);
            if (std::ranges::none_of(shown, [&](const std::string& text) { return is_made_from(text, parts); }))
                found.push_back(literal.text);
        }
    }
    INFO("write tests/errors/NAME.toml and NAME.txt for each of these, and name it in tests/errors/themes.txt");
    CHECK(messages > 300);
    std::vector<std::string> excused(guards.begin(), guards.end());
    excused.insert(excused.end(), without_model.begin(), without_model.end());
    excused.insert(excused.end(), of_the_machine.begin(), of_the_machine.end());
    std::ranges::sort(excused);
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    CHECK(found == excused);
}
