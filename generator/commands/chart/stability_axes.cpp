// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/chart/stability_axes.hpp"

#include "commands/line/options.hpp"
#include "commands/line/values.hpp"
#include "commands/scene/scene_options.hpp"
#include "model/families.hpp"
#include "model/plain_names.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

constexpr std::uint64_t most_cells = 1'000'000;
constexpr const char* initial_prefix = "initial.";

[[noreturn]] void refuse_over(const std::string& text, const std::string& what)
{
    throw UsageError(fmt::format("--over {}: {}", text, what));
}

/// The name as the model has it.
std::string name_in_model(const Setting& setting, const std::string& text, const Model& model, const Scene& scene)
{
    const std::optional<std::string> starts = initial_name(setting.name);
    const std::string name = starts.value_or(setting.name);
    const std::vector<Symbol> symbols = starts ? initial_symbols(model, scene) : free_parameters(model);
    const std::optional<ResolvedKey> key = resolve_key(symbols, name);
    if (key && key->shape.rank == Rank::scalar) return (starts ? initial_prefix : "") + key->name;
    throw ModelError(starts ? fmt::format("scene '{}' has no single initial value '{}' to chart over", scene.name, name)
                            : fmt::format("the model has no single parameter '{}' to chart over", name),
                     whole_text("<--over>", text).range(0, setting.name.size()),
                     hint_for_key(symbols, name, starts ? "initial values" : "parameters"));
}

StabilityAxis axis_from(const std::string& text, const Model& model)
{
    const Setting setting = read_setting("over", text);
    const std::vector<Excerpt> parts = parts_of_range(setting.value);
    if (parts.size() != 3) refuse_over(text, "a range is FIRST:LAST:COUNT");
    GridAxis grid{end_of_range(model, "over", parts[0]), end_of_range(model, "over", parts[1]), 0};
    const std::optional<std::uint64_t> count = read_whole(parts[2].text);
    if (!count || *count == 0 || *count > most_cells)
        refuse_over(text, fmt::format("the number of points is '{}', where a whole number from 1 to {} is required",
                                      parts[2].text, most_cells));
    grid.count = *count;
    StabilityAxis axis{setting.name, {}};
    for (std::uint64_t k = 0; k < grid.count; ++k) axis.values.push_back(grid.at(k));
    return axis;
}

} // namespace

std::vector<StabilityAxis> stability_axes(const std::string& over, const Model& model, const Scene& scene)
{
    const std::vector<std::string> texts = split_list(over);
    if (texts.empty() || texts.size() > 2 || !texts[0].starts_with("step="))
        throw UsageError("--stability needs --over step=FIRST:LAST:COUNT, and behind a comma at most one range more, "
                         "of a parameter or of initial.NAME");
    std::vector<StabilityAxis> axes;
    for (const std::string& text : texts) axes.push_back(axis_from(text, model));
    for (const double step : axes[0].values)
        if (!(step > 0)) refuse_over(texts[0], fmt::format("a step of {} is not positive", step));
    if (axes.size() == 1) return axes;
    if (axes[1].values.size() * axes[0].values.size() > most_cells)
        refuse_over(over, fmt::format("the chart has more than {} points", most_cells));
    axes[1].name = name_in_model(read_setting("over", texts[1]), texts[1], model, scene);
    const std::optional<std::string> starts = initial_name(axes[1].name);
    axes[1].heading =
        (starts ? initial_prefix : "") + plain_names({starts.value_or(axes[1].name)}, all_names(model))[0];
    return axes;
}

std::optional<std::string> initial_name(const std::string& name)
{
    const std::string_view prefix = initial_prefix;
    return name.starts_with(prefix) ? std::optional(name.substr(prefix.size())) : std::nullopt;
}

std::vector<ColumnPlace> column_places(const std::vector<StabilityAxis>& axes)
{
    if (axes.size() < 2) return {{}};
    const std::optional<std::string> starts = initial_name(axes[1].name);
    std::vector<ColumnPlace> places;
    for (const double value : axes[1].values) {
        ColumnPlace& place = places.emplace_back();
        (starts ? place.initial : place.parameters)[starts.value_or(axes[1].name)] = static_cast<long double>(value);
    }
    return places;
}

} // namespace lagen
