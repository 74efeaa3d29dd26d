// SPDX-License-Identifier: GPL-2.0-or-later
/// The mistakes of tests/errors with what lagen says about each, and the page that shows them by theme.
#pragma once

#include <string>
#include <vector>

namespace lagen::errors {

/// One mistake: a bad model and its message, or a call of the program and all that it prints.
struct Example {
    std::string name; ///< of its files, e.g. "size_cycle" or "commands/set_unknown"
    std::string text; ///< what the file NAME.txt holds
};

/// The names of one line of themes.txt and those below it.
struct Theme {
    std::string title;
    std::vector<std::string> names; ///< in the order of the page
};

/// tests/errors of the source tree.
[[nodiscard]] const std::string& examples_folder();

/// Every NAME.txt of tests/errors (themes.txt is none) and of tests/errors/commands, sorted by name.
[[nodiscard]] std::vector<Example> read_examples();

/// themes.txt: a line "# title" opens a theme, every other line names an example.
[[nodiscard]] std::vector<Theme> read_themes();

/// The Markdown of docs/messages.md. A name without an example is left out.
[[nodiscard]] std::string messages_page(const std::vector<Theme>& themes, const std::vector<Example>& examples);

} // namespace lagen::errors
