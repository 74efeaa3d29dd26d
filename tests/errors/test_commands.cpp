// SPDX-License-Identifier: GPL-2.0-or-later
/// Mistakes that take a command to be seen: tests/errors/commands/NAME.txt is the command, all that it prints (standard
/// output first), and its exit code.
#include "errors/examples.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <sys/wait.h>

using namespace lagen::errors;

namespace {

namespace fs = std::filesystem;

/// The text of an example whose command is this one, as the program gives it now.
std::string transcript(const std::string& command)
{
    const std::string folder = fs::path(LAGEN_PROGRAM).parent_path().string();
    const std::string cache = std::string(LAGEN_BINARY_DIR) + "/examples_cache";
    const lagen::testing::Shell shell = lagen::testing::run_shell(
        "cd '" + examples_folder() + "/commands' && export LAGEN_CACHE='" + cache + "' PATH='" + folder +
        "':\"$PATH\" CXXFLAGS=-O1 && unset CXX && { " + command + "; }");
    REQUIRE(WIFEXITED(shell.status));
    return "$ " + command + "\n" + shell.output + "exit code " + std::to_string(WEXITSTATUS(shell.status)) + "\n";
}

} // namespace

TEST_CASE("every command of tests/errors/commands prints the text beside it")
{
    std::size_t done = 0;
    for (const Example& example : read_examples()) {
        if (!example.name.starts_with("commands/")) continue;
        INFO(example.name);
        REQUIRE(example.text.starts_with("$ "));
        const std::string found = transcript(example.text.substr(2, example.text.find('\n') - 2));
        if (std::getenv("LAGEN_UPDATE_GOLDEN") != nullptr)
            lagen::testing::write_text(examples_folder() + "/" + example.name + ".txt", found);
        CHECK(found == example.text);
        ++done;
    }
    CHECK(done >= 40);
}

TEST_CASE("every model of tests/errors/commands is named by a command or by a model")
{
    std::string texts;
    for (const auto& entry : fs::directory_iterator(examples_folder() + "/commands"))
        texts += lagen::testing::read_text(entry.path().string());
    for (const auto& entry : fs::directory_iterator(examples_folder() + "/commands")) {
        const std::string name = entry.path().filename().string();
        INFO(name);
        if (name.ends_with(".toml")) CHECK(texts.find(name) != std::string::npos);
    }
}
