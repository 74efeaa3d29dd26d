// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/integrate_scene.hpp"

#include "lagen_run/archive.hpp"
#include "machine/process.hpp"
#include "machine/progress_line.hpp"
#include "machine/temporary_folder.hpp"
#include "machine/write_file.hpp"
#include "methods/integrate_compiled.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstring>

namespace lagen {

namespace {

/// Not zero where SIGINT, SIGTERM or SIGHUP came. A handler can reach nothing but a static object.
volatile std::sig_atomic_t interrupt_raised = 0;
extern "C" void raise_interrupt_flag(int)
{
    interrupt_raised = 1;
}

/// Native doubles that come in pieces of any length.
class DoublesOf {
  public:
    explicit DoublesOf(std::vector<double>& numbers) : numbers_(numbers) {}

    void take(const char* bytes, std::size_t count)
    {
        rest_.append(bytes, count);
        const std::size_t whole = rest_.size() / sizeof(double), before = numbers_.size();
        numbers_.resize(before + whole);
        std::memcpy(numbers_.data() + before, rest_.data(), whole * sizeof(double));
        rest_.erase(0, whole * sizeof(double));
    }

  private:
    std::vector<double>& numbers_;
    std::string rest_;
};

/// Runs a program that was compiled around its model; `show` is called when there are rows. False where it was
/// interrupted.
bool run_program(const std::string& program, const ProgramInput& input, const std::function<void()>& show,
                 RunOutcome& outcome)
{
    const TemporaryFolder folder(shared_temporary_folder(), "lagen-run"); // an argument list has a limit
    const std::string job = folder.file("job"), report = folder.file("report");
    write_file(job, detail::packed(job_of(input)));
    DoublesOf rows(outcome.table.numbers);
    const ProcessResult result = run_process({program, job, report}, [&](const char* bytes, std::size_t count) {
        rows.take(bytes, count);
        show();
    });
    require_started(result, program);
    const bool interrupted = result.interrupted || result.exit_code == static_cast<int>(ExitCode::interrupted);
    if (!interrupted && result.exit_code != 0) refuse_end(result);
    if (detail::RunReport told; detail::read_packed(report.c_str(), told))
        static_cast<detail::RunReport&>(outcome) = std::move(told);
    else if (!interrupted) // one that was killed wrote none
        throw InternalError("the program of a scene gave no report");
    return !interrupted;
}

/// Integrates over the compiled model of this path; its rows go to `rows` one after another.
bool run_in_process(const std::string& path, const ProgramInput& input, const detail::RowTaker& rows,
                    RunOutcome& outcome)
{
    interrupt_raised = 0;
    const InterruptsAnswered answered(raise_interrupt_flag); // also those that were held back before
    const std::string not_loaded =
        integrate_compiled(path, input.method_type, job_of(input), rows, &interrupt_raised, outcome);
    if (!not_loaded.empty())
        throw MachineError(fmt::format("the compiled model could not be loaded: {}", not_loaded),
                           fmt::format("remove '{}' to have it compiled again", path));
    return !is_interrupted(outcome);
}

} // namespace

bool is_uninterrupted(const std::function<void()>& work)
try {
    work();
    return true;
} catch (const InterruptedError&) {
    return false;
}

void integrate_scene(const std::string& program, const ProgramInput& input, RunOutcome& outcome)
{
    const auto start = static_cast<double>(input.times.start), end = static_cast<double>(input.times.end);
    ProgressLine progress;
    Table& table = outcome.table;
    const auto show = [&] {
        const double time = table.last_time();
        if (std::isfinite(time))
            progress.show(
                [&] { return fmt::format("{:3.0f} %  t = {:.6g}", 100 * (time - start) / (end - start), time); });
    };
    const auto take = [&](std::span<const double> row) {
        table.numbers.insert(table.numbers.end(), row.begin(), row.end());
        show();
    };
    const bool whole = program.ends_with(".so") ? run_in_process(program, input, take, outcome)
                                                : run_program(program, input, show, outcome);
    progress.clear();
    table.numbers.resize(table.count() * table.columns.size()); // whole rows of one that was killed
    if (!whole) {
        outcome.status = "interrupted";
        throw InterruptedError("lagen: interrupted, nothing was written");
    }
}

} // namespace lagen
