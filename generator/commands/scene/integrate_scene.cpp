// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/integrate_scene.hpp"

#include "commands/machine/process.hpp"
#include "commands/machine/progress.hpp"
#include "commands/machine/temporary_folder.hpp"
#include "commands/machine/write_file.hpp"
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

/// What an interrupted program left: whole rows, and its report, unless it was killed.
void take_what_is_left(const std::string& report_file, RunOutcome& outcome)
{
    std::string& rows = outcome.table.rows;
    rows.erase(rows.rfind('\n') + 1); // npos + 1 is 0
    outcome.table.count = outcome.table.lines().size();
    std::error_code ignored;
    if (std::filesystem::exists(report_file, ignored)) read_report(content_of_file(report_file), outcome);
    outcome.status = "interrupted";
}

} // namespace

bool is_uninterrupted(const std::function<void()>& work)
try {
    work();
    return true;
} catch (const InterruptedError&) {
    return false;
}

void integrate_scene(const std::string& program, ProgramInput input, RunOutcome& outcome)
{
    const TemporaryFolder folder(shared_temporary_folder(), "lagen-run");
    use_folder(folder, input);
    Progress progress(static_cast<double>(input.times.start), static_cast<double>(input.times.end));
    const ProcessResult result =
        run_process(program_arguments(program, input), [&](const char* bytes, std::size_t count) {
            outcome.table.rows.append(bytes, count);
            progress.show(outcome.table.rows);
        });
    progress.clear();
    require_started(result, program);
    if (result.interrupted || result.exit_code == static_cast<int>(ExitCode::interrupted)) {
        take_what_is_left(input.report_file, outcome);
        throw InterruptedError("lagen: interrupted, nothing was written");
    }
    if (result.exit_code != 0 && result.exit_code != 1) refuse_end(result);
    read_report(content_of_file(input.report_file), outcome);
    outcome.table.count = outcome.table.lines().size();
}

} // namespace lagen
