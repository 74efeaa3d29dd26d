// SPDX-License-Identifier: GPL-2.0-or-later
/// main: options to a command, errors to standard error and an exit code. No mathematics.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "machine/activity_watch.hpp"
#include "machine/write_file.hpp"
#include "text/activity.hpp"

#include <fmt/core.h>

#include <array>
#include <csignal>
#include <fcntl.h>
#include <new>
#include <optional>
#include <unistd.h>

namespace {

using namespace lagen;

struct CommandEntry {
    const char* name;
    const char* purpose;
    ExitCode (*run)(Arguments);
    bool follows_itself = false; ///< shows its own progress
};

constexpr std::array commands{
    CommandEntry{"check", "prove or refute the structure equations and the other claims of a model", run_check},
    CommandEntry{"derive", "print the equations of motion", run_derive},
    CommandEntry{"generate", "write the C++ header of a model", run_generate},
    CommandEntry{"compile", "make a shared object of a model, which programs load", run_compile, true},
    CommandEntry{"run", "generate, compile and integrate a scene of a model", run_run, true},
    CommandEntry{"sweep", "integrate a scene for many parameters and initial values", run_sweep, true},
    CommandEntry{"chart", "chart what accuracy costs by every method", run_chart, true},
    CommandEntry{"reduce", "prove that a morphism projects the equations of motion; list cyclic coordinates",
                 run_reduce},
    CommandEntry{"explain", "find the least model of a scene, and say what is left out and why", run_explain},
    CommandEntry{"solve", "find relative equilibria, with what is proved of their stability", run_solve},
    CommandEntry{"linearize", "linearise at an equilibrium: eigenvalues, controllability, the gain of least cost",
                 run_linearize},
    CommandEntry{"new", "write a commented model of some kind to start from", run_new},
    CommandEntry{"schema", "print the JSON Schema of model files, for editors", run_schema},
    CommandEntry{"models", "list the example models", run_models},
    CommandEntry{"methods", "list the integrators", run_methods},
};

constexpr const char* closing = R"(
`lagen COMMAND --help` shows the options of a command. Exit codes: 0 done or proved, 1 the mathematics says no,
2 undecided, 3 the model file is wrong, 4 usage, 5 the machine (no compiler, disk full, ...), 130 interrupted.
)";

void print_help()
{
    std::string text =
        "lagen: mechanics and control on Lie algebroids, from a model file to proved equations and fast C++\n\n"
        "usage: lagen COMMAND MODEL [options]\n\n";
    for (const CommandEntry& entry : commands) text += fmt::format("  {:<10}{}\n", entry.name, entry.purpose);
    write_standard_output(text + closing);
}

ExitCode dispatch(const std::vector<std::string>& arguments)
{
    if (arguments.empty() || arguments[0] == "--help" || arguments[0] == "-h" || arguments[0] == "help") {
        print_help();
        return arguments.empty() ? ExitCode::usage : ExitCode::done;
    }
    if (arguments[0] == "--version") {
        write_standard_output(fmt::format("lagen {}\n", LAGEN_VERSION));
        return ExitCode::done;
    }
    std::vector<std::string> names;
    for (const CommandEntry& entry : commands) {
        if (arguments[0] == entry.name) {
            std::optional<Activity> activity;
            if (!entry.follows_itself) activity.emplace(entry.name);
            try {
                return entry.run(Arguments(arguments).subspan(1));
            } catch (const UsageError& error) {
                throw UsageError(fmt::format("lagen {}: {}", entry.name, error.what()));
            }
        }
        names.emplace_back(entry.name);
    }
    const std::string nearest = nearest_name(arguments[0], names);
    throw UsageError(fmt::format("lagen: unknown command '{}'{} (see lagen --help)", arguments[0],
                                 nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
}

extern "C" void on_interrupt(int)
{
    constexpr char text[] = "lagen: interrupted\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof text - 1);
    ::_exit(static_cast<int>(ExitCode::interrupted));
}

int report(const std::string& text, ExitCode code)
{
    write_standard_error(text + (text.ends_with('\n') ? "" : "\n"));
    return static_cast<int>(code);
}

/// A standard stream that the caller closed is taken by the null device, so that no file of ours gets its number; what
/// is written to it fails (it is open for reading) and is reported.
void fill_standard_streams()
{
    for (int file = ::open("/dev/null", O_RDONLY); file >= 0; file = ::open("/dev/null", O_RDONLY)) {
        if (file <= STDERR_FILENO) continue;
        ::close(file);
        return;
    }
}

} // namespace

int main(int argc, char** argv)
{
    fill_standard_streams();
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
    std::signal(SIGHUP, on_interrupt);
    std::signal(SIGPIPE, SIG_IGN); // a reader who went away: write says so
    std::signal(SIGXFSZ, SIG_IGN); // a file at its limit: write says so
    try {
        const ActivityWatch watch;
        return static_cast<int>(dispatch(std::vector<std::string>(argv + 1, argv + argc)));
    } catch (const Error& error) {
        return report(error.what(), error.code());
    } catch (const InternalError& error) {
        return report(error.what(), error.code());
    } catch (const std::bad_alloc&) {
        return report("error: out of memory", ExitCode::machine);
    } catch (const std::exception& error) {
        return report(InternalError(error.what()).what(), ExitCode::machine);
    }
}
