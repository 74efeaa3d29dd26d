// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen derive`: the equations, for a person.
#include "equations/derive.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/machine/places.hpp"
#include "commands/machine/write_file.hpp"
#include "emit/json.hpp"
#include "emit/print_equations.hpp"
#include "model/scene_form.hpp"
#include "pipeline.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

const std::string derive_form_help = form_list() +
                                     ", exterior (dx^i and de^a) or cartan (Theta-, Theta+ and Omega_L of [discrete]); "
                                     "without it the first that the model has of " +
                                     default_order();

const CommandSyntax derive_syntax{"derive",
                                  "MODEL",
                                  "Prints the equations of motion.",
                                  {{"form", "FORM", derive_form_help.c_str()},
                                   {"output,o", "FILE", "write there instead of to standard output"},
                                   {"set", "NAME=VALUE", "a parameter's value (may be repeated)"},
                                   {"format,f", "FORMAT", "text, latex or json", "text"}}};

/// The equations of a refuted model say so themselves: they may go on without the error stream.
std::string marked(const std::string& text, const std::string& format, const std::vector<std::string>& warnings)
{
    if (warnings.empty()) return text;
    if (format == "json") {
        JsonWriter json;
        json.begin_object().key("warnings").begin_array();
        for (const std::string& warning : warnings) json.value(warning);
        json.end_array().end_object();
        return json.text().substr(0, json.text().size() - 1) + ", " + text.substr(1);
    }
    std::string mark;
    for (const std::string& warning : warnings)
        mark += fmt::format("{}WARNING: {}\n", format == "latex" ? "% " : "", warning);
    return mark + text;
}

} // namespace

ExitCode run_derive(Arguments arguments)
{
    const Options options(derive_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const std::string format = options.choice("format", {"text", "latex", "json"});
    if (options.has("form")) (void)options.choice("form", derivation_names());
    // A refuted model has equations too, and reading them may show why; they come with the warning.
    const CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), true);
    require_apart(options, checked.model);
    const std::string form = options.has("form") ? options.get("form") : default_form(checked.model);
    const std::vector<std::string> warnings = warnings_of(checked, form);
    for (const std::string& warning : warnings) write_standard_error(fmt::format("warning: {}\n", warning));
    if (is_form(form, FormKind::lagrange) && checked.report.mechanics.regularity.kind == Regularity::Kind::degenerate)
        write_standard_error(
            "warning: the Lagrangian is degenerate: the accelerations are not determined by the equations\n");
    if (is_form(form, FormKind::discrete) && checked.report.mechanics.discrete.kind == Regularity::Kind::degenerate)
        write_standard_error(
            "warning: the discrete Lagrangian is degenerate: the arrow of a step is not determined by the equations\n");
    const EquationSet equations = derive(form, checked.model, checked.system, checked.report);
    const std::string text = marked(format == "text"    ? print_text(equations)
                                    : format == "latex" ? print_latex(equations)
                                                        : print_json(equations),
                                    format, warnings);
    write_file(options.has("output") ? options.get("output") : "-", text.ends_with('\n') ? text : text + "\n");
    return ExitCode::done;
}

} // namespace lagen
