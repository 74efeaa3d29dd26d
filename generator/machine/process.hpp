// SPDX-License-Identifier: GPL-2.0-or-later
/// Child processes: no shell in between, so that no name or path is ever interpreted.
#pragma once

#include "text/diagnostic.hpp"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lagen {

/// The user ended the command (exit code 130).
class InterruptedError : public Error {
  public:
    explicit InterruptedError(const std::string& text) : Error(ExitCode::interrupted, text) {}
};

struct ProcessResult {
    int exit_code = 0;        ///< 128 + signal where it was killed
    bool started = true;      ///< false: the program was not found or could not be executed
    std::string output;       ///< standard output, unless a sink took it
    std::string error;        ///< standard error
    bool interrupted = false; ///< SIGINT, SIGTERM or SIGHUP reached lagen while the child ran
};

/// Runs `arguments[0]` (looked up in PATH) and waits. `sink` receives standard output piece by piece where given;
/// `source` gives standard input piece by piece, an empty one at its end (without it there is none). What they throw
/// kills the child and is passed on. An interrupt is passed to the child and its children (once; it may finish its
/// report), then noted; a second one kills them.
[[nodiscard]] ProcessResult run_process(const std::vector<std::string>& arguments,
                                        const std::function<void(const char*, std::size_t)>& sink = {},
                                        const std::function<std::string()>& source = {});

/// The same for several, at most `at_once` of them at a time; results in the order of `commands`. Behind an interrupt
/// no further one is started.
[[nodiscard]] std::vector<ProcessResult> run_processes(const std::vector<std::vector<std::string>>& commands,
                                                       std::size_t at_once);

/// The full path of a program in PATH, or "" (a name with a slash is taken as it is).
[[nodiscard]] std::string find_program(const std::string& name);

} // namespace lagen
