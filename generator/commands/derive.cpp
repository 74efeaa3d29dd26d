// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen derive`: the equations, for a person.
#include "equations/derive.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "equations/equation_system.hpp"
#include "equations/written/every_size.hpp"
#include "expression/parse.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "pipeline.hpp"
#include "text/comma_list.hpp"
#include "typeset/print_equations.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

const std::string derive_form_help =
    form_list() +
    ", exterior (dx^i and de^a), cartan (theta_L and omega_L, or Theta-, Theta+ and "
    "Omega_L of [discrete]), poisson (brackets on E*, or on D* of a nonholonomic model), invariants (found, beside H), "
    "variations (of E-paths and the "
    "action, Jacobi's equations; of controlled curves), reaction (reactions of a "
    "nonholonomic model) or projected (its projected brackets); without it the first that the model has of " +
    default_order();

const CommandSyntax derive_syntax{"derive",
                                  "MODEL",
                                  "Prints the equations of motion.",
                                  {{"form", "FORM", derive_form_help.c_str()},
                                   {"expand", nullptr,
                                    "write components, and definitions out in coordinates and parameters; without it "
                                    "vectors are vectors, families stand once, and definitions that are long and occur "
                                    "more than once stay symbols, with a list of what they stand for"},
                                   {"bracket", "F",
                                    "with --form poisson: the bracket {F, G} of two functions of base "
                                    "coordinates and momenta (twice)"},
                                   option::output,
                                   option::set,
                                   {"format,f", "FORMAT", "text, latex or json", "text"}}};

/// Whether a name is a base coordinate, a momentum, a parameter or the time.
bool is_on_dual(const Model& model, const std::string& name)
{
    const auto called = [&](const Symbol& each) { return each.name == name; };
    return std::ranges::any_of(model.base.coordinates, called) || std::ranges::any_of(model.fibre.momenta, called) ||
           std::ranges::any_of(model.parameters, [&](const Parameter& each) { return called(each.symbol); }) ||
           (name == "t" && std::ranges::none_of(model.fibre.coordinates, called));
}

/// The equations of a refuted model say so themselves: they may go on without the error stream.
std::string marked(const std::string& text, const std::string& format, const std::vector<std::string>& warnings)
{
    if (warnings.empty()) return text;
    std::string mark;
    for (const std::string& warning : warnings)
        mark += fmt::format("{}WARNING: {}\n", format == "latex" ? "% " : "", warning);
    return mark + text;
}

/// The functions of --bracket, over coordinates of E*, t and parameters.
std::vector<Tree> bracket_functions(const Options& options, const Model& model, const std::string& form)
{
    const std::vector<std::string> texts = options.all("bracket");
    if (!texts.empty() && form != "poisson") throw UsageError("--bracket goes with --form poisson");
    if (texts.size() % 2 != 0) throw UsageError("--bracket is given twice, for F and G of {F, G}");
    std::vector<Tree> functions;
    for (const std::string& text : texts) {
        const Excerpt excerpt = whole_text("<--bracket>", text);
        functions.push_back(model.observer.close(parse_expression(excerpt)));
        for (const std::string& used : names_in(functions.back()))
            if (!is_on_dual(model, used))
                throw ModelError(
                    fmt::format("'{}' is no function of base coordinates and momenta: it depends on '{}'", text, used),
                    excerpt.range(0, text.size()), "the momenta are " + comma_list(model.fibre.momenta, &Symbol::name));
    }
    return functions;
}

/// The model's default form; of a discrete Lagrangian that a scheme makes, which is not written out, that of its L.
std::string form_to_derive(const Model& model)
{
    return model.discrete && !model.discrete->lagrangian ? "lagrange" : default_form(model);
}

/// Lagrange's equations of long families, from models of fewer entries; nothing where the file holds for its size
/// alone.
std::optional<EquationSet> equations_of_fewer(const CheckedModel& checked)
{
    const auto derive_at = [&](long size) {
        std::vector<Setting> settings = checked.settings;
        const std::string& name = checked.model.sizes[0].name;
        std::erase_if(settings, [&](const Setting& setting) { return setting.name == name; });
        settings.push_back({name, whole_text("<size>", std::to_string(size))});
        const CheckedModel fewer = load(checked.model.file->name, settings, true);
        return with_written_blocks(derive("lagrange", fewer.model, fewer.system, fewer.report), fewer.model);
    };
    try {
        return equations_of_every_size(checked.model, derive_at);
    } catch (const ModelError&) { // values for each of its entries
        return std::nullopt;
    }
}

/// Nobody waits for a flood on a terminal: how much there is, before it comes.
void announce(const std::string& text, const std::string& file)
{
    constexpr std::size_t flood = 1'000'000; // bytes
    if (text.size() < flood || file != "-") return;
    write_standard_error(fmt::format("note: {:.1f} MB of equations follow; -o FILE writes them to a file\n",
                                     static_cast<double>(text.size()) / 1e6));
}

} // namespace

ExitCode run_derive(Arguments arguments)
{
    const Options options(derive_syntax, arguments);
    if (options.help()) return ExitCode::done;
    if (options.get("format") == "sympy")
        throw UsageError("--format is 'sympy', it must be one of text, latex, json",
                         fmt::format("lagen.equations(\"{}\") in Python gives them in SymPy (docs/python.md)",
                                     options.positional()[0]));
    const std::string format = options.choice("format", {"text", "latex", "json"});
    if (options.has("form")) (void)options.choice("form", derivation_names());
    // A refuted model has equations too, and reading them may show why; they come with the warning.
    const CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), true);
    require_apart(options, checked.model);
    const std::string form = options.has("form") ? options.get("form") : form_to_derive(checked.model);
    const std::vector<Tree> brackets = bracket_functions(options, checked.model, form);
    const std::vector<std::string> warnings = warnings_of(checked, form);
    warn(warnings);
    if (is_form(form, FormKind::lagrange) && checked.report.mechanics.regularity.kind == Regularity::Kind::degenerate)
        warn("the Lagrangian is degenerate: the accelerations are not determined by the equations");
    if (is_form(form, FormKind::discrete) && checked.report.mechanics.discrete.kind == Regularity::Kind::degenerate)
        warn("the discrete Lagrangian is degenerate: the arrow of a step is not determined by the equations");
    const bool expanded = options.has("expand");
    const bool by_index = !expanded && format != "json";
    std::optional<EquationSet> fewer;
    if (by_index && is_form(form, FormKind::lagrange)) fewer = equations_of_fewer(checked);
    EquationSet equations = fewer ? std::move(*fewer)
                                  : derive(form, checked.model, checked.system, checked.report, brackets,
                                           expanded ? Definitions::expanded : Definitions::kept);
    if (by_index && !fewer) equations = with_written_blocks(std::move(equations), checked.model);
    std::string text;
    if (format == "json") {
        Record record = record_of(equations);
        record["system"] = record_of(equation_system(checked.model, checked.system));
        add_unless_empty(record, "warnings", warnings);
        text = to_json(record);
    } else {
        text = marked(format == "text" ? print_text(equations) : print_latex(equations), format, warnings);
    }
    announce(text, options.output());
    write_file(options.output(), text.ends_with('\n') ? text : text + "\n");
    return ExitCode::done;
}

} // namespace lagen
