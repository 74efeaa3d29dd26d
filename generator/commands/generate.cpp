// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen generate`: the C++ header of a model.
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "kernels/requested_kernels.hpp"
#include "machine/write_file.hpp"
#include "model/scene_form.hpp"
#include "text/record.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

CommandSyntax generate_syntax(const std::string& form, const std::string& only)
{
    return {"generate",
            "MODEL",
            "Writes the C++ header of a model: right-hand side, mass matrix, energy, momentum, "
            "constraints, observables, events.",
            {{"output,o", "FILE", "the header; standard output without it"},
             {"form", "FORM", form.c_str()},
             {"only", "KERNELS", only.c_str()},
             {"with", "KERNELS", "kernels beside those that every header has, e.g. taylor"},
             {"time-scale", "EXPR", "a kernel time_scale of this function of the state, for lagen::Reversible"},
             {"report", nullptr,
              "on standard error the operations of each kernel as written and as kept, and its costliest terms"},
             option::set,
             option::bind,
             {"unchecked", nullptr, "go on although the model is refuted; the header says so"},
             {"format,f", "FORMAT", "text (the header) or json (what it holds, and the header)", "text"},
             {"depfile", "FILE", "write a dependency file for make or ninja (needs --output)"}}};
}

/// What `--form` may name.
std::string help_for_form()
{
    return form_list() + "; without it the first that the model has of " + default_order();
}

/// What `--only` may name.
std::string help_for_only()
{
    return fmt::format("these kernels alone, e.g. rhs,energy; there are {} (a model has some of them)",
                       fmt::join(kernel_names(), ", "));
}

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

/// One table: of each kernel the operations as written and as kept, and below them its costliest terms.
std::string operations_text(const std::vector<KernelReport>& reports)
{
    constexpr std::size_t most_terms = 3; // of each kernel
    constexpr double least_share = 0.05;  // of a kernel's weight, for a term that is shown
    std::string text = fmt::format("{:<46}{:>6} {:>6} {:>6} {:>9} {:>6} {:>8}\n", "operations", "+ -", "*", "/",
                                   "functions", "solves", "weight");
    for (const KernelReport& kernel : reports) {
        const auto numbers = [](const OperationCount& count) {
            return fmt::format("{:>6} {:>6} {:>6} {:>9} {:>6} {:>8.0f}\n", count.additions, count.multiplications,
                               count.divisions, count.functions, count.solves, count.weight);
        };
        const SimplifyReport& report = kernel.report;
        const std::string written = numbers(report.written), kept = numbers(report.kept);
        text +=
            fmt::format("{:<46}{}", kernel.kernel + (written == kept ? ", kept as written" : ", as written"), written);
        if (written != kept) text += fmt::format("{:<46}{}", "  kept", kept);
        for (std::size_t k = 0; k < std::min(report.costliest.size(), most_terms); ++k) {
            const CostlyTerm& term = report.costliest[k];
            if (term.weight < least_share * report.kept.weight) break;
            text += fmt::format("    weighs {:.0f}, used {}: {}\n", term.weight,
                                term.uses == 1 ? "once" : fmt::format("{} times", term.uses), term.text);
        }
    }
    return text;
}

/// {"model", "form", "class", "hash", "regenerate", "warnings", "kernels": [{"name", "rows", "columns"}], "header"}
Record record_of(const Generated& generated)
{
    const KernelModule& module = generated.module;
    return {
        {"model", module.model},
        {"form", module.form},
        {"class", module.name},
        {"hash", module.hash},
        {"regenerate", module.regenerate},
        {"warnings", module.warnings},
        {"kernels", list_of(module.kernels,
                            [](const Kernel& kernel) {
                                const ArrayShape& shape = kernel.outputs[0].shape;
                                return Record{{"name", kernel.name}, {"rows", shape.rows}, {"columns", shape.columns}};
                            })},
        {"header", generated.header}};
}

} // namespace

ExitCode run_generate(Arguments arguments)
{
    const std::string form = help_for_form();
    const std::string only = help_for_only();
    const Options options(generate_syntax(form, only), arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("form")) (void)options.choice("form", form_names());
    if (options.has("depfile") && !options.has("output")) throw UsageError("--depfile needs --output");
    const CheckedModel checked = loaded(options);
    const std::string made = options.has("form") ? options.get("form") : default_form(checked.model);
    warn(warnings_of(checked, made));
    GenerateRequest request;
    if (options.get("output") != "-") request.output = options.get("output");
    request.report = options.has("report");
    request.form = options.get("form");
    request.only = split_list(options.get("only"));
    if (options.has("only") && request.only.empty())
        throw UsageError("--only names no kernel (see lagen generate --help)");
    request.with = split_list(options.get("with"));
    request.time_scale = time_scale_of(options, checked.model);
    const Generated generated = generate(checked, request);
    if (request.report) write_standard_error(operations_text(generated.reports));
    write_file(options.output(), as_json ? to_json(record_of(generated)) + "\n" : generated.header);
    if (options.has("depfile")) {
        std::string inputs = escaped(checked.model.file->name);
        for (const auto& file : checked.model.included) inputs += " " + escaped(file->name);
        write_file(options.get("depfile"), fmt::format("{}: {}\n", escaped(options.output()), inputs));
    }
    return ExitCode::done;
}

} // namespace lagen
