// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/styles.hpp"

#include "commands/machine/gnuplot.hpp"

#include <fmt/core.h>

#include <cstdlib>

namespace lagen {

namespace {

constexpr double thick = 1.6, thin = 0.6;
constexpr double dot_size = 0.4;

std::string colour_of(std::size_t k)
{
    return picture_colours[k % picture_colours.size()];
}

/// Two thirds of the way to white.
std::string pale_colour_of(std::size_t k)
{
    const std::string colour = colour_of(k);
    std::string pale = "#";
    for (const std::size_t at : {1U, 3U, 5U}) {
        const long part = std::strtol(colour.substr(at, 2).c_str(), nullptr, 16);
        pale += fmt::format("{:02x}", 255 - (255 - part) / 3);
    }
    return pale;
}

std::string dashes_of(std::size_t k)
{
    return fmt::format("dashtype {}", k / picture_colours.size() % 3 + 1);
}

} // namespace

std::string line_style(std::size_t k, double width)
{
    return fmt::format("lines linecolor rgb '{}' linewidth {} {}", colour_of(k), width, dashes_of(k));
}

std::string hidden_style(std::size_t k)
{
    return fmt::format("lines linecolor rgb '{}' linewidth 1 {}", pale_colour_of(k), dashes_of(k));
}

std::string point_style(std::size_t k, double size, bool hidden)
{
    return fmt::format("points pointtype 7 pointsize {} linecolor rgb '{}'", size,
                       hidden ? pale_colour_of(k) : colour_of(k));
}

std::vector<Stroke> strokes_of(const std::vector<Polyline>& pieces, bool hidden, std::size_t k, Pen pen)
{
    std::vector<Stroke> strokes;
    if (pen == Pen::line) strokes.push_back({hidden ? hidden_style(k) : line_style(k, thick), pieces, false});
    if (pen == Pen::steps && !hidden) strokes.push_back({line_style(k, thin), pieces, false});
    if (pen != Pen::line) strokes.push_back({point_style(k, dot_size, hidden), pieces, true});
    return strokes;
}

Stroke start_of(const Point& point, std::size_t k)
{
    return {point_style(k, 0.7), {{point}}, true};
}

} // namespace lagen
