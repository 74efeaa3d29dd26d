// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/integrate_scene.hpp"

#include "commands/machine/process.hpp"
#include "commands/machine/progress.hpp"
#include "commands/machine/temporary_folder.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/scene_in_process.hpp"
#include "diagnostic.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace lagen {

namespace {

/// As driver.hpp reads them.
std::string rows_text(const std::vector<std::vector<double>>& rows)
{
    std::string text;
    for (const std::vector<double>& row : rows) text += fmt::format("{}\n", fmt::join(row, " "));
    return text;
}

/// Times, inputs and report go through files: an argument list has a limit.
void use_folder(const TemporaryFolder& folder, ProgramInput& input)
{
    input.at_file = folder.file("times");
    input.report_file = folder.file("report");
    input.inputs_file = folder.file("inputs");
    if (!input.held_inputs.empty()) write_file(input.inputs_file, rows_text(input.held_inputs));
    if (input.times.kind != Sampling::Kind::at) return;
    std::string times;
    for (const long double time : input.times.at) times += fmt::format("{}\n", static_cast<double>(time));
    write_file(input.at_file, times);
}

/// Keeps the whole rows of an interrupted run.
[[noreturn]] void end_interrupted(RunOutcome& outcome)
{
    std::string& rows = outcome.table.rows;
    rows.erase(rows.rfind('\n') + 1); // npos + 1 is 0
    outcome.table.count = outcome.table.lines().size();
    outcome.status = "interrupted";
    throw InterruptedError("lagen: interrupted, nothing was written");
}

/// Runs a program that was compiled around its model; its rows go to `take`. False where it was interrupted.
bool run_program(const std::string& program, ProgramInput input, const std::function<void(std::string_view)>& take,
                 RunOutcome& outcome)
{
    const TemporaryFolder folder(shared_temporary_folder(), "lagen-run");
    use_folder(folder, input);
    const ProcessResult result =
        run_process(program_arguments(program, input),
                    [&](const char* bytes, std::size_t count) { take(std::string_view(bytes, count)); });
    require_started(result, program);
    const bool interrupted = result.interrupted || result.exit_code == static_cast<int>(ExitCode::interrupted);
    if (!interrupted && result.exit_code != 0 && result.exit_code != 1) refuse_end(result);
    std::error_code ignored; // one that was killed wrote no report
    if (!interrupted || std::filesystem::exists(input.report_file, ignored))
        read_report(content_of_file(input.report_file), outcome);
    return !interrupted;
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
    Progress progress(static_cast<double>(input.times.start), static_cast<double>(input.times.end));
    const auto take = [&](std::string_view rows) {
        outcome.table.rows.append(rows);
        progress.show(outcome.table.rows);
    };
    const bool whole = is_compiled_model(program) ? integrate_in_process(program, input, take, outcome)
                                                  : run_program(program, input, take, outcome);
    progress.clear();
    if (!whole) end_interrupted(outcome);
    outcome.table.count = outcome.table.lines().size();
}

} // namespace lagen
