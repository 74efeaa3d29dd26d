// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/plot.hpp"

#include "commands/line/options.hpp"
#include "commands/machine/gnuplot.hpp"
#include "commands/machine/process.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lagen {

namespace {

// Pixels.
constexpr int width = 900;
constexpr int panel_height = 270; ///< with the gap below it
constexpr int panel_gap = 26;
constexpr int top_margin = 44;
constexpr int bottom_margin = 58;
constexpr int left_margin = 84;

// Characters.
constexpr std::size_t longest_title = 110;
constexpr std::size_t legend_lines = 10; ///< that fit beside a panel
constexpr std::size_t longest_name = 28;

/// The rows as gnuplot reads them: blanks for commas; an empty field becomes a gap.
std::string data_block(const Table& table)
{
    std::string text = "$rows << LAGEN_END\n";
    for (const std::string_view line : table.lines()) {
        for (const std::string_view field : fields(line)) text.append(field.empty() ? "?" : field).append(" ");
        text += '\n';
    }
    return text + "LAGEN_END\n";
}

bool begins_character(char c)
{
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

std::size_t characters_of(const std::string& text)
{
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

/// At most so many characters, the last three of them dots where some were cut off.
std::string shortened(const std::string& text, std::size_t most)
{
    if (characters_of(text) <= most) return text;
    std::size_t seen = 0;
    const auto cut =
        std::find_if(text.begin(), text.end(), [&](char c) { return begins_character(c) && ++seen > most - 3; });
    return std::string(text.begin(), cut) + "...";
}

std::string with_unit(const std::string& text, const std::string& unit)
{
    return unit.empty() || unit == "1" ? text : fmt::format("{} [{}]", text, unit);
}

/// The unit of all columns, or "" where they differ or have none.
std::string shared_unit(const Panel& panel)
{
    for (const std::string& unit : panel.units)
        if (unit != panel.units.front()) return "";
    return panel.units.empty() ? "" : panel.units.front();
}

/// What the legend calls the k-th column of a panel.
std::string legend_of(const Table& table, const Panel& panel, std::size_t k)
{
    const std::string name = shortened(table.columns[panel.columns[k]], longest_name);
    return shared_unit(panel).empty() && k < panel.units.size() ? with_unit(name, panel.units[k]) : name;
}

/// How many columns of a panel its legend names; one line of it says how many more there are.
std::size_t named_columns(const Panel& panel)
{
    return panel.columns.size() <= legend_lines ? panel.columns.size() : legend_lines - 1;
}

/// Pixels to the right of the panels for the longest legend.
int legend_width(const Table& table, const std::vector<Panel>& panels)
{
    std::size_t longest = 0;
    for (const Panel& panel : panels)
        for (std::size_t k = 0; k < named_columns(panel); ++k)
            longest = std::max(longest, characters_of(legend_of(table, panel, k)));
    return 60 + 8 * static_cast<int>(std::min<std::size_t>(longest, longest_name + 12));
}

/// The colours, then the same dashed and dotted.
std::string line_styles()
{
    constexpr auto& colours = picture_colours;
    std::string text;
    for (std::size_t k = 0; k < 3 * colours.size(); ++k)
        text += fmt::format("set linetype {} linecolor rgb '{}' linewidth 1.8 pointtype 7 dashtype {}\n", k + 1,
                            colours[k % colours.size()], k / colours.size() + 1);
    return text + fmt::format("set linetype cycle {}\n", 3 * colours.size());
}

/// Where the k-th panel stands, in fractions of the picture; all have the same left and right edges.
std::string place_of(std::size_t k, int height)
{
    const auto from_top = [&](std::size_t panels, int pixels) {
        return 1 - static_cast<double>(top_margin + pixels + panel_height * static_cast<int>(panels)) / height;
    };
    return fmt::format("set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n", from_top(k, 0),
                       from_top(k + 1, -panel_gap));
}

std::string panel_text(const Table& table, const Panel& panel, bool last, const std::string& time_unit)
{
    std::string text = fmt::format("set ylabel {}\n", gnuplot_text(with_unit(panel.label, shared_unit(panel))));
    text +=
        last ? fmt::format("set format x '%g'\nset xlabel {}\n", gnuplot_text(with_unit(table.columns[0], time_unit)))
             : "set format x ''\n";
    text += "plot ";
    const char* separator = "";
    const std::size_t named = named_columns(panel);
    for (std::size_t k = 0; k < panel.columns.size(); ++k) {
        text += fmt::format("{}$rows using 1:{} with {} linetype {} {}", separator, panel.columns[k] + 1,
                            table.count == 1 ? "points" : "lines", k + 1,
                            k < named ? "title " + gnuplot_text(legend_of(table, panel, k)) : "notitle");
        separator = ", \\\n     ";
    }
    if (named < panel.columns.size())
        text += fmt::format("{}NaN with lines linecolor rgb '#ffffff' title {}", separator,
                            gnuplot_text(fmt::format("and {} more", panel.columns.size() - named)));
    return text + "\n";
}

std::string script_of(const Table& table, const std::vector<Panel>& panels, const std::string& title,
                      const std::string& extension, const std::string& picture, const std::string& time_unit)
{
    const int height = top_margin + panel_height * static_cast<int>(panels.size()) + bottom_margin - panel_gap;
    const double right = 1 - static_cast<double>(legend_width(table, panels)) / width;
    std::string script = gnuplot_terminal(extension, width, height);
    script += fmt::format("set output {}\nset datafile missing '?'\n", gnuplot_text(picture)) + data_block(table);
    script += line_styles();
    script += fmt::format("set multiplot title {}\n", gnuplot_text(shortened(title, longest_title)));
    script += fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n",
                          static_cast<double>(left_margin) / width, right);
    script += fmt::format("set key at screen {:.5f}, graph 1 left top Left reverse samplen 2 width -1\n", right + 0.01);
    script += "set grid linecolor rgb '#dddddd' linetype 1 linewidth 0.8 dashtype 1\n"
              "set border 3 linecolor rgb '#444444'\nset tics nomirror out scale 0.6\nset autoscale xfix\n"
              "set ylabel offset 0.5,0\n";
    for (std::size_t k = 0; k < panels.size(); ++k)
        script += place_of(k, height) + panel_text(table, panels[k], k + 1 == panels.size(), time_unit);
    return script + "unset multiplot\nunset output\n";
}

bool is_picture(const std::string& path)
{
    const std::string extension = picture_extension(path);
    return extension == ".svg" || extension == ".png" || extension == ".pdf";
}

} // namespace

void require_no_picture(const std::string& path)
{
    if (is_picture(path))
        throw UsageError(fmt::format("lagen run: --output writes the rows as CSV; a picture is `--plot {}`", path));
}

void require_plot_format(const std::string& path)
{
    if (!is_picture(path))
        throw UsageError(
            fmt::format("lagen run: --plot needs a file that ends in .svg, .png or .pdf, found '{}'", path));
    if (find_program("gnuplot").empty())
        throw MachineError("error: gnuplot was not found\nhint: --plot draws with gnuplot; install gnuplot-nox");
}

void plot_table(const Table& table, const std::vector<Panel>& panels, const std::string& title, const std::string& path,
                const std::string& time_unit)
{
    require_plot_format(path);
    if (table.count == 0 || panels.empty()) throw MachineError("error: there is nothing to plot: the run gave no rows");
    draw_picture(path, [&](const std::string& picture) {
        return script_of(table, panels, title, picture_extension(path), picture, time_unit);
    });
}

} // namespace lagen
