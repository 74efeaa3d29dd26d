// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/partial_rows.hpp"

#include "commands/machine/write_file.hpp"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>

namespace lagen {

namespace {

/// Devices, pipes and standard output stay what they are.
std::string partial_place(const std::string& output)
{
    std::error_code ignored;
    const auto status = std::filesystem::status(output, ignored);
    const bool is_stream = output == "-" || (exists(status) && !is_regular_file(status));
    return output + (is_stream ? "" : ".partial");
}

} // namespace

ExitCode leave_rows(const Options& options, const Table& rows, const std::vector<std::string>& known,
                    const std::string& report, double t)
{
    const std::string output = options.get("output");
    const bool as_json = options.as_json();
    std::string place = "on standard output";
    if (!output.empty()) {
        const std::string file = partial_place(output);
        write_file(file, output.ends_with(".json") ? report : to_csv(rows, known));
        place = fmt::format("in '{}'", file);
    }
    if (as_json || output.empty()) write_standard_output(as_json ? report : to_csv(rows, known));
    const std::size_t count = rows.count();
    const std::string when = std::isfinite(t) ? fmt::format(" at t = {:.9g}", t) : "";
    write_standard_error(fmt::format("lagen: interrupted{}; {} so far {} {}\n", when,
                                     count == 1 ? "the row" : fmt::format("the {} rows", count),
                                     count == 1 ? "is" : "are", place));
    return ExitCode::interrupted;
}

} // namespace lagen
