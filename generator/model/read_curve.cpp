// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/read_curve.hpp"

#include "expression/parse.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t most_curves = 1000;

/// The observable "momentum.s" of a symmetry s; null for every other text.
const NamedTree* momentum_named(const Model& model, const Excerpt& text)
{
    constexpr std::string_view prefix = "momentum.";
    if (!text.text.starts_with(prefix)) return nullptr;
    std::vector<std::string> known;
    for (const NamedTree& observable : model.observables) {
        if (observable.name == text.text) return &observable;
        if (observable.name.starts_with(prefix)) known.push_back(observable.name);
    }
    throw ModelError(fmt::format("there is no symmetry called '{}'", text.text.substr(prefix.size())),
                     text.range(0, text.text.size()), hint_for(text.text, known, "momenta"));
}

/// The observable "reaction.Y" of a nonholonomic model; nothing for every other text.
std::optional<std::string> reaction_named(const Model& model, const Excerpt& text)
{
    constexpr std::string_view prefix = "reaction.";
    if (!is_nonholonomic(model) || !text.text.starts_with(prefix)) return std::nullopt;
    const std::string coordinate = text.text.substr(prefix.size());
    const std::vector<Symbol>& ambient = ambient_fibre(model);
    if (std::ranges::find(ambient, coordinate, &Symbol::name) != ambient.end()) return text.text;
    throw ModelError(fmt::format("there is no ambient fibre coordinate called '{}'", coordinate),
                     text.range(0, text.text.size()),
                     hint_for(coordinate, declared_names(ambient), "ambient fibre coordinates"));
}

/// The parts between colons.
std::vector<Excerpt> parts_of(const Excerpt& text)
{
    std::vector<Excerpt> parts;
    for (std::size_t begin = 0; begin <= text.text.size();) {
        const std::size_t end = std::min(text.text.find(':', begin), text.text.size());
        parts.push_back(trimmed(text, begin, end));
        begin = end + 1;
    }
    return parts;
}

} // namespace

std::vector<NamedTree> observed_columns(const Model& model, const Scope& scope, const Excerpt& text)
{
    const SourceRange where = text.range(0, text.text.size());
    const Excerpt inner = trimmed(text, 0, text.text.size());
    if (const auto* momentum = momentum_named(model, inner)) return {{momentum->name, momentum->value, where}};
    if (const auto reaction = reaction_named(model, inner)) return {{*reaction, name(*reaction, where), where}};
    const ArrayValue value = scope.close_array(parse_expression(text), true);
    std::vector<NamedTree> columns;
    for (std::size_t k = 0; k < value.entries.size(); ++k)
        columns.push_back({value_name(inner.text, value.shape, k), value.entries[k], where});
    return columns;
}

std::vector<PlotCurve> read_curve(const Model& model, const Scope& scope, const Excerpt& text)
{
    const SourceRange where = text.range(0, text.text.size());
    std::vector<std::vector<NamedTree>> coordinates;
    std::size_t count = 1;
    const std::vector<Excerpt> parts = parts_of(text);
    if (parts.size() != 2 && parts.size() != 3)
        throw ModelError(fmt::format("the curve {} has {} coordinate{}, where two or three with colons between them "
                                     "are required",
                                     quote(text.text), parts.size(), parts.size() == 1 ? "" : "s"),
                         where, "\"t:x\" is a graph, \"x:y\" a curve in the plane, \"x:y:z\" one in space");
    for (const Excerpt& part : parts) {
        coordinates.push_back(observed_columns(model, scope, part));
        const std::size_t entries = coordinates.back().size();
        if (entries != 1 && count != 1 && entries != count)
            throw ModelError(
                fmt::format("the curve {} has coordinates of {} and of {} entries", quote(text.text), count, entries),
                where, "vectors of one length make a curve an entry");
        count = std::max(count, entries);
    }
    std::vector<PlotCurve> curves(count);
    for (std::size_t k = 0; k < count; ++k) {
        curves[k].where = where;
        for (const auto& entries : coordinates)
            curves[k].coordinates.push_back(entries.size() == 1 ? entries[0] : entries[k]);
    }
    return curves;
}

bool is_in_space(const std::vector<PlotCurve>& panel)
{
    return panel.front().coordinates.size() == 3;
}

void add_panel(Plot& plot, std::vector<PlotCurve> curves)
{
    std::size_t count = curves.size();
    for (const auto& panel : plot.panels) count += panel.size();
    if (count > most_curves)
        throw ModelError(fmt::format("the picture has {} curves, more than {}", count, most_curves),
                         curves.back().where);
    for (const PlotCurve& curve : curves)
        if (curve.coordinates.size() != curves.front().coordinates.size())
            throw ModelError("a curve in space stands beside one in the plane", curve.where,
                             "give them panels of their own: curves = [\"x:y\", \"x:y:z\"]");
    plot.panels.push_back(std::move(curves));
}

std::vector<NamedTree> plot_coordinates(const Scene& scene)
{
    std::vector<NamedTree> coordinates;
    if (!scene.plot) return coordinates;
    for (const auto& panel : scene.plot->panels)
        for (const PlotCurve& curve : panel)
            for (const NamedTree& coordinate : curve.coordinates)
                if (coordinate.name != "t") coordinates.push_back(coordinate);
    return coordinates;
}

} // namespace lagen
