// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/kept_chart.hpp"

#include "commands/machine/compile_cache.hpp"
#include "commands/scene/run_record.hpp"
#include "lagen_run/archive.hpp"

namespace lagen {

namespace {

constexpr std::string_view chart_heading = "what `lagen chart` measured, packed\n";

} // namespace

std::string chart_file(const Options& options, const Model& model)
{
    std::vector<std::string> key{"chart",
                                 options.get("scene"),
                                 options.get("form"),
                                 options.get("t-end"),
                                 options.get("at"),
                                 options.has("unchecked") ? "unchecked" : ""};
    for (const Setting& setting : options.settings())
        key.push_back((setting.binds ? "bind " : "set ") + setting.name + "=" + setting.value.text);
    for (const Setting& setting : options.named("initial"))
        key.push_back("initial " + setting.name + "=" + setting.value.text);
    Model charted = model; // the same whether parameters are bound yet or not
    for (Parameter& parameter : charted.parameters) parameter.bound = false;
    return record_file(charted, key);
}

KeptChart kept_chart(const Chart& chart)
{
    return {chart.points, chart.ended_by_event ? "" : chart.shortened};
}

std::optional<KeptChart> find_chart(const std::string& file)
{
    const std::optional<std::string> text = kept_text(file);
    if (!text || !text->starts_with(chart_heading)) return std::nullopt;
    std::string_view bytes = *text;
    bytes.remove_prefix(chart_heading.size());
    KeptChart chart;
    return detail::take_packed(bytes, chart) && bytes.empty() ? std::optional(std::move(chart)) : std::nullopt;
}

void keep_chart(const std::string& file, const KeptChart& chart)
{
    if (!file.empty()) keep_text(file, std::string(chart_heading) + detail::packed(chart));
}

} // namespace lagen
