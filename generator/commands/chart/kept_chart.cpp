// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/kept_chart.hpp"

#include "commands/machine/compile_cache.hpp"
#include "commands/scene/run_record.hpp"

namespace lagen {

namespace {

constexpr std::string_view chart_heading = "what `lagen chart` of " LAGEN_VERSION " measured, packed\n";

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
    return kept<KeptChart>(file, chart_heading);
}

void keep_chart(const std::string& file, const KeptChart& chart)
{
    keep(file, chart_heading, chart);
}

} // namespace lagen
