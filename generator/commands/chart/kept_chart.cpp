// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/kept_chart.hpp"

#include "commands/chart/measure.hpp"
#include "commands/machine/compile_cache.hpp"
#include "commands/scene/run_record.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

constexpr const char* chart_heading = "what `lagen chart` measured\nobstacle=";

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
    const std::string heading = chart_heading;
    if (!text || !text->starts_with(heading)) return std::nullopt;
    const std::size_t end = text->find('\n', heading.size());
    if (end == std::string::npos) return std::nullopt;
    return KeptChart{read_points(text->substr(end + 1)), text->substr(heading.size(), end - heading.size())};
}

void keep_chart(const std::string& file, const KeptChart& chart)
{
    if (file.empty()) return;
    std::string text = chart_heading + chart.obstacle + "\n";
    for (const ChartPoint& point : chart.points) {
        text += fmt::format("point={}\nparameter={}\nstatus={}\n", point.method, point.parameter, point.status);
        if (point.error) text += fmt::format("error={}\n", *point.error);
        text += fmt::format("steps={}\nrejected={}\nrhs_calls={}\nseconds={}\n", point.steps, point.rejected,
                            point.rhs_calls, point.seconds);
    }
    keep_text(file, text);
}

} // namespace lagen
