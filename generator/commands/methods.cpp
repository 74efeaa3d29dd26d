// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen methods`: the integrators, and how long their steps may be.
#include "scene/methods.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "machine/write_file.hpp"
#include "scene/linear_limits.hpp"
#include "text/record.hpp"

#include <fmt/core.h>

#include <array>
#include <utility>
#include <vector>

namespace lagen {

namespace {

const CommandSyntax methods_syntax{
    "methods",
    "",
    "Lists the integrators.",
    {{"stability", nullptr,
      "how long their steps may be on linear equations: intervals of the imaginary and real axes"},
     option::format}};

Record record_of(const MethodEntry& entry)
{
    return {{"name", entry.name},         {"order", entry.order},
            {"adaptive", entry.adaptive}, {"separable_only", entry.kind == MethodKind::splitting},
            {"text", entry.text},         {"keeps", entry.keeps},
            {"system", system_of(entry)}};
}

struct StabilityRow {
    std::string name, order;
    LinearLimits limits;
};

/// Those of [discrete] that no variational method is; `trapezoidal` is lobatto:2.
constexpr std::array<std::pair<const char*, const char*>, 5> other_schemes{
    {{"left", "1"}, {"trapezoidal", "2"}, {"lobatto:3", "4"}, {"lobatto:4", "6"}, {"lobatto:5", "8"}}};

std::vector<StabilityRow> stability_rows()
{
    std::vector<StabilityRow> rows;
    const auto add = [&](const char* name, const std::string& order, const std::string& of) {
        if (const LinearLimits* limits = find_limits(of)) rows.push_back({name, order, *limits});
    };
    for (const MethodEntry& method : method_table())
        if (method.kind == MethodKind::series)
            for (const char* order : {"4", "10", "20", "30"}) add(method.name, order, fmt::format("taylor:{}", order));
        else
            add(method.name, method.order, *method.scheme != '\0' ? method.scheme : method.type);
    for (const auto& [scheme, order] : other_schemes) add(scheme, order, scheme);
    return rows;
}

std::string limit_text(const std::optional<double>& limit)
{
    if (!limit) return "-";
    return *limit == no_limit ? "unbounded" : fmt::format("{:.6f}", *limit);
}

Record limit_record(const std::optional<double>& limit)
{
    return limit && *limit == no_limit ? Record("unbounded") : or_null(limit);
}

std::string stability_table_text()
{
    std::string text =
        "Steps h for which nothing grows: h omega from 0 to `imaginary` on x'' = -omega^2 x, h |lambda| from 0 to\n"
        "`real` on x' = lambda x, lambda < 0. Calls of the right-hand side a step, and the first figure over "
        "them.\nVariational methods, and the schemes of [discrete] at the end, are of the first alone.\n\n" +
        fmt::format("{:<14}{:<9}{:>5}{:>12}{:>9}{:>12}\n", "", "order", "calls", "imaginary", "a call", "real");
    for (const auto& [name, order, limits] : stability_rows()) {
        const bool ends = limits.imaginary != no_limit && limits.calls > 0;
        const char* note = limits.l_stable ? "  A-stable, L-stable" : limits.a_stable ? "  A-stable" : "";
        text += fmt::format("{:<14}{:<9}{:>5}{:>12}{:>9}{:>12}{}\n", name, order,
                            limits.calls > 0 ? std::to_string(limits.calls) : "-", limit_text(limits.imaginary),
                            ends ? fmt::format("{:.3f}", limits.imaginary / static_cast<double>(limits.calls)) : "-",
                            limit_text(limits.real), note);
    }
    return text;
}

Record record_of(const StabilityRow& row)
{
    const LinearLimits& limits = row.limits;
    return {{"name", row.name},
            {"order", row.order},
            {"calls", limits.calls > 0 ? Record(limits.calls) : Record()},
            {"imaginary", limit_record(limits.imaginary)},
            {"real", limit_record(limits.real)},
            {"a_stable", limits.a_stable},
            {"l_stable", limits.l_stable}};
}

} // namespace

ExitCode run_methods(Arguments arguments)
{
    const Options options(methods_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    const auto record = [](const auto& each) { return record_of(each); };
    if (options.has("stability")) {
        write_standard_output(as_json ? to_json(list_of(stability_rows(), record)) + "\n" : stability_table_text());
        return ExitCode::done;
    }
    if (as_json) {
        write_standard_output(to_json(list_of(method_table(), record)) + "\n");
        return ExitCode::done;
    }
    std::string text;
    for (const MethodEntry& entry : method_table()) {
        const std::string keeps = entry.keeps, system = system_of(entry);
        text += fmt::format("{:<17}order {:<8}{:<10}{}{}{}\n", entry.name, entry.order,
                            entry.adaptive ? "tolerance" : "step", entry.text, keeps.empty() ? "" : ", " + keeps,
                            system.empty() ? "" : fmt::format(" (for {} only)", system));
    }
    write_standard_output(text);
    return ExitCode::done;
}

} // namespace lagen
