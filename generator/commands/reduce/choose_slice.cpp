// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/reduce/choose_slice.hpp"

#include "commands/line/options.hpp"
#include "expression/parse.hpp"
#include "graph/calculus/determinant.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"
#include "graph/core/lower.hpp"
#include "model/families.hpp"
#include "verify/judge.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// Choices of coordinates that are looked at.
constexpr std::size_t most_choices = 2000;

using FixedNodes = std::vector<std::optional<NodeId>>; // of each coordinate; nothing where it cannot be fixed

FixedNodes start_values(Graph& graph, const Model& model)
{
    FixedNodes values(model.base.coordinates.size());
    if (model.scenes.empty()) return values;
    const Scene& scene = find_scene(model, "");
    for (std::size_t i = 0; i < values.size(); ++i)
        if (const auto given = std::ranges::find(scene.initial, model.base.coordinates[i].name, &NamedTree::name);
            given != scene.initial.end())
            values[i] = Lowering(graph)(given->value);
    return values;
}

/// Values of coordinates by name; those that are not named are free.
FixedNodes named_values(Graph& graph, const Model& model, const std::string& text)
{
    FixedNodes values(model.base.coordinates.size());
    const std::vector<Symbol> parameters = parameter_symbols(model);
    for (const std::string& each : split_list(text)) {
        const Setting setting = read_setting("slice", each);
        const auto found = std::ranges::find(model.base.coordinates, setting.name, &Symbol::name);
        if (found == model.base.coordinates.end())
            throw UsageError(fmt::format("'{}' of --slice is no coordinate of model '{}'", setting.name, model.name));
        const Tree value = model.observer.close(parse_expression(setting.value));
        for (const std::string& used : names_in(value))
            if (std::ranges::find(parameters, used, &Symbol::name) == parameters.end())
                throw UsageError(fmt::format("'{}' in --slice is no parameter of model '{}'", used, model.name));
        values[static_cast<std::size_t>(found - model.base.coordinates.begin())] = Lowering(graph)(value);
    }
    return values;
}

} // namespace

Slice choose_slice(Graph& graph, const CheckedModel& checked, const InfinitesimalAction& action,
                   const std::string& group, const std::string& text)
{
    const Model& model = checked.model;
    const System& whole = checked.system;
    const std::size_t size = action.fields.size();
    std::vector<FixedNodes> offers;
    if (text.empty())
        offers = {start_values(graph, model), FixedNodes(whole.n(), graph.constant(0))};
    else
        offers = {named_values(graph, model, text)};
    Replacements start; // a slice that orbits cross there is better than one that they touch
    for (std::size_t i = 0; i < whole.n(); ++i)
        if (offers[0][i]) start.emplace_back(whole.algebroid.x[i], *offers[0][i]);
    std::optional<Slice> crossed, touched;
    Judge judge(graph, proof_setting(graph, whole), {});
    const auto vanishes = [&](NodeId f) { return judge.decide(f).status != ProofStatus::refuted; };
    for (const FixedNodes& values : offers) {
        if (size > whole.n()) break;
        Places choice = first_places(size);
        std::size_t tried = 0;
        do {
            Slice slice{choice, {}};
            for (const std::size_t k : choice)
                if (values[k]) slice.values.push_back(*values[k]);
            if (size > determinant_limit || slice.values.size() < size) continue;
            try {
                const NodeId only[] = {slice_determinant(graph, whole, action, slice)};
                if (graph.is_constant(only[0]) && !graph.is_zero(only[0])) return slice;
                if (crossed || vanishes(only[0])) continue;
                if (!touched) touched = slice;
                if (!vanishes(substitute(graph, only, start)[0])) crossed = slice;
            } catch (const DivisionByZero&) { // the field has no value there
            }
        } while (++tried < most_choices && next_places(choice, whole.n()));
    }
    if (crossed) return *crossed;
    if (touched) return *touched;
    throw MathematicsError(
        fmt::format("no slice {}of its coordinates cuts the orbits of {} on model '{}' in points: the group has "
                    "dimension {}",
                    text.empty() ? "" : fmt::format("'{}' ", text), group, model.name, size),
        "the group acts freely where orbits are as large as it is; --slice 'x=1, y=0' names coordinates and values");
}

} // namespace lagen
