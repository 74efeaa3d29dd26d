// SPDX-License-Identifier: GPL-2.0-or-later
/// What a scene starts from: initial values and parameters.
#include "model/scene_reader.hpp"

#include "expression/parse_family.hpp"
#include "model/dependency_order.hpp"
#include "model/scene_form.hpp"
#include "model/scene_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

bool is_among(const std::vector<Symbol>& symbols, const std::string& name)
{
    return index_of(symbols, name) < symbols.size();
}

[[noreturn]] void refuse_initial(const ModelReader& reader, const Scene& scene, const TomlEntry& entry)
{
    std::vector<std::string> known = reader.names.of(Role::base);
    const Fibre& fibre = reader.model.fibre;
    for (const std::vector<std::string>& more :
         {declared_names(fibre.coordinates), declared_names(fibre.momenta), reader.names.of(Role::state)})
        known.insert(known.end(), more.begin(), more.end());
    std::string hint;
    if (std::ranges::find(reader.rates, entry.name(), &CoordinateRate::rate) != reader.rates.end())
        hint = fmt::format("it follows from the fibre coordinates: {}",
                           fmt::join(declared_names(fibre.coordinates), ", "));
    else if (!reader.model.control && !is_nonholonomic(reader.model))
        hint = hint_for_rate(entry.name(), reader.rates);
    if (hint.empty()) hint = hint_for_momentum(entry.name(), reader.rates);
    if (hint.empty()) hint = hint_for(entry.name(), known, "coordinates");
    throw ModelError(fmt::format("scene '{}' gives an initial value to '{}', which is no coordinate of the model",
                                 scene.name, entry.name()),
                     entry.where(), hint);
}

} // namespace

void read_initial(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'initial' of scene '{}'", scene.name));
    const Model& model = reader.model;
    GivenValues given("the initial value of");
    const std::vector<Symbol> states = state_symbols(model);
    for (const TomlEntry& entry : block.value.entries) {
        bool found = false;
        for (const auto* symbols : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta, &states}) {
            const std::optional<ResolvedKey> key = resolve_key(*symbols, entry_key(entry.key, model.scope));
            if (!key) continue;
            given.add(reader, entry, *key, *symbols);
            found = true;
            break;
        }
        if (!found) refuse_initial(reader, scene, entry);
    }
    std::vector<NamedTree> own = std::move(given.list);
    const auto gives = [&](const std::vector<Symbol>& lanes) {
        return std::ranges::any_of(own, [&](const NamedTree& each) { return is_among(lanes, each.name); });
    };
    const auto drop = [&](const std::vector<Symbol>& given, const std::vector<Symbol>& other) {
        if (!gives(given) || gives(other)) return;
        std::erase_if(scene.initial, [&](const NamedTree& each) { return is_among(other, each.name); });
    };
    drop(model.fibre.momenta, model.fibre.coordinates);
    drop(model.fibre.coordinates, model.fibre.momenta);
    put_all(scene.initial, std::move(own));
}

void read_scene_parameters(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'parameters' of scene '{}'", scene.name));
    const std::vector<Symbol> symbols = parameter_symbols(reader.model);
    GivenValues given("the value of parameter");
    for (const TomlEntry& entry : block.value.entries) {
        const std::optional<ResolvedKey> key = resolve_key(symbols, entry_key(entry.key, reader.model.scope));
        if (!key) {
            throw ModelError(
                fmt::format("scene '{}' sets '{}', which is no parameter of the model", scene.name, entry.name()),
                entry.where(), hint_for(entry.name(), reader.names.of(Role::parameter), "parameters"));
        }
        given.add(reader, entry, *key, symbols);
    }
    put_all(scene.parameters, std::move(given.list));
}

void require_complete(const ModelReader& reader, const Scene& scene)
{
    const std::set<std::string> given = given_names(scene.initial);
    const Fibre& fibre = reader.model.fibre;
    const Missing no_fibre = missing_of(fibre.coordinates, given);
    const Missing no_momentum = missing_of(fibre.momenta, given);
    const bool some_fibre = no_fibre.count < fibre.coordinates.size();
    const bool some_momenta = no_momentum.count < fibre.momenta.size();
    if (some_fibre && some_momenta) {
        throw ModelError(fmt::format("scene '{}' mixes fibre coordinates and momenta in 'initial'", scene.name),
                         scene.where, "give every fibre coordinate or every momentum");
    }
    Missing missing = missing_of(reader.model.base.coordinates, given);
    const bool momenta = some_momenta || is_form(form_of(reader.model, scene), FormKind::pontryagin);
    const Missing& rest = momenta ? no_momentum : no_fibre;
    if (!scene.rest || momenta) missing.add(rest);
    if (missing.count == 0) return;
    const bool fibre_left_out = rest.count > 0 && !momenta && !scene.rest;
    const bool costate_sought = momenta && reader.model.control && reader.model.control->boundary;
    throw ModelError(fmt::format("scene '{}' leaves out the initial value{} of {}", scene.name,
                                 missing.count > 1 ? "s" : "", missing.text()),
                     scene.where,
                     fibre_left_out ? "rest = true sets the fibre coordinates left out to zero"
                     : costate_sought
                         ? "nothing solves [control.boundary] yet: a run starts from all coordinates and momenta"
                         : "");
}

void require_acyclic_scene(const ModelReader& reader, const Scene& scene)
{
    if (scene.parameters.empty()) return;
    std::vector<NamedTree> values;
    for (const Parameter& parameter : reader.model.parameters) {
        values.push_back(NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    put_all(values, scene.parameters);
    (void)dependency_order(values, "parameters");
}

} // namespace lagen
