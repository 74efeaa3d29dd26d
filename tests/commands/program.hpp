// SPDX-License-Identifier: GPL-2.0-or-later
/// The program as its user meets it: arguments in, exit code and two streams out.
#pragma once

#include "support/json.hpp"

#include <map>
#include <string>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace lagen::testing {

struct Outcome {
    int code = -1; ///< 128 + signal where it was killed
    std::string out, err;

    [[nodiscard]] bool operator==(const Outcome&) const = default;
};

/// What differs from an ordinary call.
struct Surroundings {
    std::vector<std::pair<std::string, std::string>> environment{}; ///< an empty value removes the variable
    std::string folder{};                                           ///< to stand in; default: models_folder()
    std::string output{};                                           ///< standard output goes there instead
    bool output_closed = false;
    bool error_closed = false;
    long largest_file = 0;  ///< bytes; 0: no limit
    std::string program{};  ///< instead of lagen
    bool long_runs = false; ///< what is compiled computes for longer than it is compiled
};

/// Runs lagen. Programs that it compiles are shared by the whole test program.
[[nodiscard]] Outcome call(const std::vector<std::string>& arguments, const Surroundings& around = {});

/// The same, which must succeed.
[[nodiscard]] Outcome done(const std::vector<std::string>& arguments, const Surroundings& around = {});

/// The same, not waited for; `finish` waits.
struct Started {
    pid_t process = 0;
    std::string out, err; ///< files
};
[[nodiscard]] Started start_call(const std::vector<std::string>& arguments, const Surroundings& around = {});
[[nodiscard]] Outcome finish(const Started& started);

/// The report of a command in JSON, which must end with this exit code.
[[nodiscard]] json::Value report_of(const char* command, std::vector<std::string> arguments, int code = 0,
                                    const Surroundings& around = {});
/// The report of `lagen run` with these arguments, which must come to its end.
[[nodiscard]] json::Value finished_run(std::vector<std::string> arguments);
/// Its last row by the names of the columns.
[[nodiscard]] std::map<std::string, double> last_columns(const json::Value& run);
/// The last row of `lagen run` with these arguments, which must come to its end: t, then the columns.
[[nodiscard]] std::vector<double> last_row(std::vector<std::string> arguments);

/// A new empty folder, removed with everything else when the test program ends.
[[nodiscard]] std::string fresh_folder();
/// The path of a new file with this text, in a folder of its own.
[[nodiscard]] std::string written_file(const std::string& name, const std::string& text);
/// A folder with a copy of what is in models and in tests/commands/models.
[[nodiscard]] const std::string& models_folder();
/// The example models by name, sorted.
[[nodiscard]] std::vector<std::string> example_models();
/// Names of everything in a folder, sorted.
[[nodiscard]] std::vector<std::string> names_in(const std::string& folder);
/// TMPDIR of every call: must be empty after each.
[[nodiscard]] const std::string& temporary_folder();

} // namespace lagen::testing
