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
    ContentHash hash;
    for (const char* option : {"scene", "form", "t-end", "at", "unchecked"})
        hash.add(options.has(option) ? option : "").add(options.get(option));
    for (const Setting& setting : options.settings())
        hash.add(setting.binds ? "bind" : "set").add(setting.name).add(setting.value.text);
    for (const Setting& setting : options.named("initial"))
        hash.add("initial").add(setting.name).add(setting.value.text);
    Model charted = model; // the same whether parameters are bound yet or not
    for (Parameter& parameter : charted.parameters) parameter.bound = false;
    add_model(hash, charted);
    return kept_file(hash.add("chart"));
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
