// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen generate`: the C++ header of a model.
#include "commands/command.hpp"
#include "commands/options.hpp"
#include "commands/write_file.hpp"
#include "pipeline.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

const CommandSyntax syntax{"generate",
                           "MODEL",
                           "Writes the C++ header of a model: right-hand side, mass matrix, energy, momentum, "
                           "constraints, observables, events.",
                           {{"output,o", "FILE", "the header; standard output without it"},
                            {"form", "FORM", "lagrange", "lagrange"},
                            {"only", "KERNELS", "these kernels alone, e.g. rhs,energy"},
                            {"set", "NAME=VALUE", "a parameter's value (may be repeated)"},
                            {"unchecked", nullptr, "go on although the model is refuted; the header says so"},
                            {"depfile", "FILE", "write a dependency file for make or ninja (needs --output)"}}};

/// A path as make and ninja read it in a dependency file.
std::string escaped(const std::string& path)
{
    std::string text;
    for (const char c : path) {
        if (c == ' ' || c == '#' || c == '\\') text += '\\';
        if (c == '$') text += '$';
        text += c;
    }
    return text;
}

} // namespace

ExitCode run_generate(Arguments arguments)
{
    const Options options(syntax, arguments);
    if (options.help()) return ExitCode::done;
    (void)options.choice("form", {"lagrange"});
    if (options.has("depfile") && !options.has("output")) throw UsageError("lagen generate: --depfile needs --output");
    const std::string model = options.positional()[0];
    const CheckedModel checked = load(model, options.settings(), options.has("unchecked"));
    for (const std::string& warning : checked.warnings) write_standard_error(fmt::format("warning: {}\n", warning));
    GenerateRequest request;
    request.only = split_list(options.get("only"));
    const std::string output = options.has("output") ? options.get("output") : "-";
    write_file(output, generate(checked, request).header);
    if (options.has("depfile"))
        write_file(options.get("depfile"), fmt::format("{}: {}\n", escaped(output), escaped(model)));
    return ExitCode::done;
}

} // namespace lagen
