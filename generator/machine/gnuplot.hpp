// SPDX-License-Identifier: GPL-2.0-or-later
/// Pictures by gnuplot: what all scripts share.
#pragma once

#include <array>
#include <functional>
#include <string>

namespace lagen {

/// Eight colours that colour-blind readers tell apart [Okabe-Ito 2008].
inline constexpr std::array picture_colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                               "#e69f00", "#56b4e9", "#000000", "#b8a800"};

/// A gnuplot string that shows exactly these characters (enhanced text is off).
[[nodiscard]] std::string gnuplot_text(const std::string& text);

/// ".svg", ".png", ".pdf", or what else `path` ends in.
[[nodiscard]] std::string picture_extension(const std::string& path);

/// Width and height in pixels; enhanced text is off.
[[nodiscard]] std::string gnuplot_terminal(const std::string& extension, int width, int height);

/// Draws `path` by the script, which is told the file to write. Throws MachineError where gnuplot is missing or fails.
void draw_picture(const std::string& path, const std::function<std::string(const std::string& picture)>& script);

} // namespace lagen
