// SPDX-License-Identifier: GPL-2.0-or-later
/// Curves as they are written, and the [scene.NAME.plot] blocks.
#include "model/read_curve.hpp"

#include "expression/parse.hpp"
#include "model/complaints.hpp"
#include "model/read_values.hpp"

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
    throw complain::unknown_word("a column", text.text, place_of(text), known, "momenta of symmetries");
}

/// The observable "reaction.Y" of a nonholonomic model; nothing for every other text.
std::optional<std::string> reaction_named(const Model& model, const Excerpt& text)
{
    constexpr std::string_view prefix = "reaction.";
    if (!is_nonholonomic(model) || !text.text.starts_with(prefix)) return std::nullopt;
    const std::string coordinate = text.text.substr(prefix.size());
    const std::vector<Symbol>& ambient = ambient_fibre(model);
    if (std::ranges::find(ambient, coordinate, &Symbol::name) != ambient.end()) return text.text;
    throw complain::names_no("a reaction", coordinate, "ambient fibre coordinate", place_of(text),
                             hint_for(coordinate, declared_names(ambient), "ambient fibre coordinates"));
}

/// The curves of each panel: a string is one, and so is a list of strings.
void read_panels(const ModelReader& reader, Plot& plot, const Item& given)
{
    plot.panels.clear();
    for (const TomlValue& item : given.value().items) {
        std::vector<Excerpt> texts;
        if (item.kind == TomlKind::string) texts.push_back(item.text);
        for (const TomlValue& each : item.items) texts.push_back(each.text);
        std::vector<PlotCurve> curves;
        for (const Excerpt& text : texts)
            std::ranges::move(read_curve(reader.model, reader.arrows, text), std::back_inserter(curves));
        if (curves.empty()) throw complain::needs("a panel of " + given.title(), "a curve", item.where);
        add_panel(plot, std::move(curves));
    }
}

} // namespace

std::vector<NamedTree> observed_columns(const Model& model, const Scope& scope, const Excerpt& text)
{
    const SourceRange where = place_of(text);
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
    const SourceRange where = place_of(text);
    std::vector<std::vector<NamedTree>> coordinates;
    std::size_t count = 1;
    const std::vector<Excerpt> parts = split_at_commas(text, ':');
    if (parts.size() != 2 && parts.size() != 3)
        throw complain::wrong_number(fmt::format("coordinates of the curve {}", quote(text.text)), parts.size(),
                                     "a picture", "two or three with colons between them", where,
                                     "\"t:x\" is a graph, \"x:y\" a curve in the plane, \"x:y:z\" one in space");
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
    if (count > most_curves) throw complain::too_many("the picture", count, "curves", most_curves, curves.back().where);
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

Plot read_plot(const ModelReader& reader, Plot plot, const Item& block)
{
    if (const Item given = block.at("curves")) read_panels(reader, plot, given);
    if (const Item given = block.at("equal")) plot.equal = given.value().boolean;
    if (const Item given = block.at("points")) plot.points = given.value().boolean;
    const Item sphere = block.at("sphere");
    if (sphere) plot.sphere = sphere.value().boolean;
    if (plot.panels.empty()) throw complain::missing(block.title(), {"curves"}, block.where(), block.row().hint);
    if (sphere && std::ranges::none_of(plot.panels, is_in_space))
        throw complain::needs(sphere.title(), "a curve in space", sphere.where(),
                              "a curve in space has three coordinates: \"x:y:z\"");
    return plot;
}

} // namespace lagen
