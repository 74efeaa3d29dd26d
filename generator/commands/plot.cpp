// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot.hpp"

#include "commands/options.hpp"
#include "commands/process.hpp"
#include "commands/temporary_folder.hpp"
#include "commands/write_file.hpp"

#include <fmt/core.h>

#include <filesystem>

namespace lagen {

namespace {

constexpr int width = 900;
constexpr int panel_height = 300;

std::string extension_of(const std::string& path)
{
    return std::filesystem::path(path).extension().string();
}

/// A gnuplot string that shows exactly these characters (enhanced text is off).
std::string quoted(const std::string& text)
{
    std::string result = "'";
    for (const char c : text) {
        if (c == '\n' || c == '\r') continue;
        result += c == '\'' ? std::string("''") : std::string(1, c);
    }
    return result + "'";
}

std::string terminal(const std::string& extension, int height)
{
    if (extension == ".svg")
        return fmt::format("set terminal svg size {},{} noenhanced font 'sans,13' background rgb 'white'\n", width,
                           height);
    if (extension == ".png")
        return fmt::format("set terminal pngcairo size {},{} noenhanced font 'sans,11'\n", width, height);
    return fmt::format("set terminal pdfcairo size {:.2f},{:.2f} noenhanced font 'sans,11'\n", width / 100.0,
                       height / 100.0);
}

/// The rows as gnuplot reads them: blanks for commas; what is not finite becomes a gap.
std::string data_block(const Table& table)
{
    std::string text = "$rows << LAGEN_END\n";
    for (const std::string_view line : table.lines()) {
        for (const std::string_view field : fields(line)) {
            const bool finite = field.find_first_of("nN") == std::string_view::npos; // nan, inf
            text.append(finite ? field : "?").append(" ");
        }
        text += '\n';
    }
    return text + "LAGEN_END\n";
}

std::string panel_text(const Table& table, const Panel& panel, bool last)
{
    std::string text = fmt::format("set ylabel {}\n{}", quoted(panel.label),
                                   last ? fmt::format("set xlabel {}\n", quoted(table.columns[0])) : "");
    text += "plot ";
    const char* separator = "";
    for (const std::size_t column : panel.columns) {
        text += fmt::format("{}$rows using 1:{} with {} linewidth 1.6 title {}", separator, column + 1,
                            table.count == 1 ? "points" : "lines", quoted(table.columns[column]));
        separator = ", \\\n     ";
    }
    return text + "\n";
}

std::string script_of(const Table& table, const std::vector<Panel>& panels, const std::string& title,
                      const std::string& extension, const std::string& picture)
{
    std::string script = terminal(extension, 60 + panel_height * static_cast<int>(panels.size()));
    script += fmt::format("set output {}\nset datafile missing '?'\n", quoted(picture)) + data_block(table);
    script += fmt::format("set multiplot layout {},1 title {}\nset grid linecolor rgb '#dddddd'\nset key outside right "
                          "top\nset border linecolor rgb "
                          "'#444444'\nset autoscale xfix\n",
                          panels.size(), quoted(title));
    for (std::size_t k = 0; k < panels.size(); ++k) script += panel_text(table, panels[k], k + 1 == panels.size());
    return script + "unset multiplot\nunset output\n";
}

} // namespace

void require_plot_format(const std::string& path)
{
    const std::string extension = extension_of(path);
    if (extension != ".svg" && extension != ".png" && extension != ".pdf")
        throw UsageError(
            fmt::format("lagen run: --plot needs a file that ends in .svg, .png or .pdf, found '{}'", path));
    if (find_program("gnuplot").empty())
        throw MachineError("error: gnuplot was not found\nhint: --plot draws with gnuplot; install gnuplot-nox");
}

void plot_table(const Table& table, const std::vector<Panel>& panels, const std::string& title, const std::string& path)
{
    require_plot_format(path);
    if (table.count == 0 || panels.empty()) throw MachineError("error: there is nothing to plot: the run gave no rows");
    const TemporaryFolder folder(shared_temporary_folder(), "lagen-plot");
    const std::string picture = folder.file("picture" + extension_of(path));
    const std::string script = folder.file("script.gp");
    write_file(script, script_of(table, panels, title, extension_of(path), picture));
    const ProcessResult result = run_process({"gnuplot", script});
    if (result.interrupted) throw Error(ExitCode::interrupted, "lagen: interrupted while drawing");
    if (!result.started || result.exit_code != 0)
        throw MachineError(fmt::format("error: gnuplot failed with exit code {}\n{}", result.exit_code, result.error));
    write_file(path, content_of_file(picture));
}

} // namespace lagen
