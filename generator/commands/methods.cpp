// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen methods`: the integrators, and how long their steps may be.
#include "commands/scene/methods.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/linear_limits.hpp"
#include "emit/json.hpp"

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
     {"format,f", "FORMAT", "text or json", "text"}}};

void method_json(JsonWriter& json, const MethodEntry& entry)
{
    json.begin_object()
        .key("name")
        .value(entry.name)
        .key("order")
        .value(entry.order)
        .key("adaptive")
        .value(entry.adaptive);
    json.key("separable_only").value(entry.kind == MethodKind::splitting).key("text").value(entry.text);
    json.key("keeps").value(entry.keeps).key("system").value(system_of(entry)).end_object();
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

void limit_json(JsonWriter& json, const char* key, const std::optional<double>& limit)
{
    json.key(key);
    if (!limit)
        json.null();
    else if (*limit == no_limit)
        json.value("unbounded");
    else
        json.value(*limit);
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

std::string stability_table_json()
{
    JsonWriter json;
    json.begin_array();
    for (const auto& [name, order, limits] : stability_rows()) {
        json.begin_object().key("name").value(name).key("order").value(order).key("calls");
        if (limits.calls > 0)
            json.value(limits.calls);
        else
            json.null();
        limit_json(json, "imaginary", limits.imaginary);
        limit_json(json, "real", limits.real);
        json.key("a_stable").value(limits.a_stable).key("l_stable").value(limits.l_stable).end_object();
    }
    json.end_array();
    return json.text() + "\n";
}

} // namespace

ExitCode run_methods(Arguments arguments)
{
    const Options options(methods_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.choice("format", {"text", "json"}) == "json";
    if (options.has("stability")) {
        write_standard_output(as_json ? stability_table_json() : stability_table_text());
        return ExitCode::done;
    }
    if (as_json) {
        JsonWriter json;
        json.begin_array();
        for (const MethodEntry& entry : method_table()) method_json(json, entry);
        json.end_array();
        write_standard_output(json.text() + "\n");
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
