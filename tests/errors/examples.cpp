// SPDX-License-Identifier: GPL-2.0-or-later
#include "errors/examples.hpp"

#include "support/golden.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace lagen::errors {

namespace {

namespace fs = std::filesystem;

constexpr const char* introduction = R"(# Messages

What `lagen` says about a mistake, one example each. This page is made from `tests/errors`, where every text is tested byte
for byte (`LAGEN_UPDATE_GOLDEN=1` before the test program `test_errors` writes it anew).

A message about a model is one sentence with its place: file, line and column (both from 1, the column in characters), the
line itself with a caret under the mistake, and a hint where a repair suggests itself.

```
pendulum.toml:8:6: error: unknown symbol 'mas'
  L = "mas*v_q^2/2"
       ^~~
hint: did you mean 'mass'?
```

`error` ends the command; `warning` does not. Messages go to standard error, results to standard output. What stands on the
command line is checked like the file, under a name in brackets: `<--set mass>:1:1`. The exit code tells the kinds apart:

| exit code | means |
|---|---|
| 0 | done; of `check`: every claim is proved |
| 1 | the mathematics says no: a claim is refuted, the Lagrangian is degenerate, a run could not go on |
| 2 | `check` could neither prove nor refute a claim |
| 3 | the model file or an expression is wrong, or missing |
| 4 | the command line is wrong |
| 5 | the machine: no compiler, no file to write to, or a defect of lagen (`internal error`: please report it) |
| 130 | interrupted |

Below, the model of an example is the file that its message names, in [tests/errors](../tests/errors) or, where a command
is shown, in [tests/errors/commands](../tests/errors/commands). Messages without a command come from every command that reads
the model, and end it with exit code 3. Left out are failures of the machine whose text depends on it (no headers, a full
disk, what the C++ compiler says).
)";

/// The anchor that Markdown readers give to a heading: lower case, blanks become '-', punctuation goes.
std::string anchor_of(const std::string& title)
{
    std::string anchor;
    for (const char c : title) {
        if (c == ' ') anchor += '-';
        if (c >= 'A' && c <= 'Z') anchor += static_cast<char>(c - 'A' + 'a');
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-') anchor += c;
    }
    return anchor;
}

} // namespace

const std::string& examples_folder()
{
    static const std::string folder = std::string(LAGEN_SOURCE_DIR) + "/tests/errors";
    return folder;
}

std::vector<Example> read_examples()
{
    std::vector<Example> examples;
    for (const char* prefix : {"", "commands/"}) {
        for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(examples_folder()) / prefix)) {
            const fs::path& path = entry.path();
            if (path.extension() != ".txt" || path.filename() == "themes.txt") continue;
            examples.push_back({prefix + path.stem().string(), testing::read_text(path.string())});
        }
    }
    std::ranges::sort(examples, {}, &Example::name);
    return examples;
}

std::vector<Theme> read_themes()
{
    std::vector<Theme> themes;
    std::istringstream lines(testing::read_text(examples_folder() + "/themes.txt"));
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("# ")) themes.push_back({line.substr(2), {}});
        std::istringstream names(line.starts_with("# ") ? "" : line);
        for (std::string name; names >> name && !themes.empty();) themes.back().names.push_back(name);
    }
    return themes;
}

std::string messages_page(const std::vector<Theme>& themes, const std::vector<Example>& examples)
{
    std::string page = introduction;
    page += "\n";
    for (const Theme& theme : themes) page += "- [" + theme.title + "](#" + anchor_of(theme.title) + ")\n";
    for (const Theme& theme : themes) {
        page += "\n## " + theme.title + "\n";
        for (const std::string& name : theme.names) {
            const auto example = std::ranges::lower_bound(examples, name, {}, &Example::name);
            if (example == examples.end() || example->name != name) continue;
            page += "\n```\n" + example->text + "```\n";
        }
    }
    return page;
}

} // namespace lagen::errors
