// SPDX-License-Identifier: GPL-2.0-or-later
/// tests/support/timed, through which ctest runs every test.
#include "support/golden.hpp"

using namespace lagen::testing;

namespace {

const std::string folder = LAGEN_BINARY_DIR "/test-times-of-house";

/// Runs `command` as the test `name` that is expected to take so many seconds.
int timed(const std::string& name, const std::string& figure, const std::string& command)
{
    const Shell shell = run_shell("'" LAGEN_SOURCE_DIR "/tests/support/timed' " + name + " " + figure + " '" + folder +
                                  "' sh -c '" + command + "'");
    INFO(shell.output);
    CHECK((shell.output.find("processor seconds, more than five times the " + figure + " expected") !=
           std::string::npos) == (name == "slow"));
    return shell.status;
}

const std::string busy = "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done";

} // namespace

TEST_CASE("a test that takes five times the processor seconds that it is expected to take fails")
{
    CHECK(timed("slow", "0.001", busy) != 0);
    CHECK(timed("quick", "20", busy) == 0);
}

TEST_CASE("time that a test waits is not counted, that of the processes it starts is")
{
    CHECK(timed("waiting", "0.1", "sleep 0.6") == 0);
    CHECK(timed("slow", "0.001", "sh -c \"i=0; while [ \\$i -lt 100000 ]; do i=\\$((i+1)); done\"; true") != 0);
}

TEST_CASE("what a test took and was expected to take stands in a file of its name, and a failure stays one")
{
    CHECK(timed("failing", "20", "exit 3") != 0);
    const std::string line = read_text(folder + "/failing");
    CHECK(line.starts_with("failing,0."));
    CHECK(line.ends_with(",20\n"));
}
