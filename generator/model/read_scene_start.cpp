// SPDX-License-Identifier: GPL-2.0-or-later
/// What a scene starts from: initial values and parameters.
#include "model/scene_reader.hpp"

#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

/// Replaces the entry of the same name or appends.
void put(std::vector<NamedTree>& list, NamedTree entry)
{
    const auto same = [&](const NamedTree& other) { return other.name == entry.name; };
    const auto place = std::find_if(list.begin(), list.end(), same);
    if (place == list.end()) {
        list.push_back(std::move(entry));
    } else {
        *place = std::move(entry);
    }
}

bool has_role(const ModelReader& reader, const std::string& name, Role role)
{
    const Names::Entry* entry = reader.names.find(name);
    return entry != nullptr && entry->role == role;
}

} // namespace

void read_initial(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'initial' of scene '{}'", scene.name));
    std::vector<NamedTree> own;
    for (const TomlEntry& entry : block.value.entries) {
        const Names::Entry* declared = reader.names.find(entry.name());
        const bool state = declared != nullptr && (declared->role == Role::base || declared->role == Role::fibre ||
                                                   declared->role == Role::momentum);
        if (!state) {
            std::vector<std::string> known = reader.names.of(Role::base);
            for (const Role role : {Role::fibre, Role::momentum}) {
                const std::vector<std::string> more = reader.names.of(role);
                known.insert(known.end(), more.begin(), more.end());
            }
            throw ModelError(
                fmt::format("scene '{}' gives an initial value to '{}', which is no coordinate of the model",
                            scene.name, entry.name()),
                entry.where(), hint_for(entry.name(), known, "coordinates"));
        }
        const std::string what = fmt::format("the initial value of '{}'", entry.name());
        own.push_back(NamedTree{entry.name(), over_parameters(reader, entry.value, what), entry.where()});
    }
    const auto gives = [&](Role role) {
        return std::any_of(own.begin(), own.end(),
                           [&](const NamedTree& each) { return has_role(reader, each.name, role); });
    };
    for (const auto& [given, other] : {std::pair{Role::momentum, Role::fibre}, {Role::fibre, Role::momentum}}) {
        if (!gives(given) || gives(other)) continue;
        std::erase_if(scene.initial,
                      [&, role = other](const NamedTree& each) { return has_role(reader, each.name, role); });
    }
    for (NamedTree& entry : own) put(scene.initial, std::move(entry));
}

void read_scene_parameters(const ModelReader& reader, Scene& scene, const TomlEntry& block)
{
    const TableReader table(block.value, fmt::format("'parameters' of scene '{}'", scene.name));
    for (const TomlEntry& entry : block.value.entries) {
        if (!has_role(reader, entry.name(), Role::parameter)) {
            throw ModelError(
                fmt::format("scene '{}' sets '{}', which is no parameter of the model", scene.name, entry.name()),
                entry.where(), hint_for(entry.name(), reader.names.of(Role::parameter), "parameters"));
        }
        const std::string what = fmt::format("the value of parameter '{}'", entry.name());
        put(scene.parameters, NamedTree{entry.name(), over_parameters(reader, entry.value, what), entry.where()});
    }
}

void require_complete(const ModelReader& reader, const Scene& scene)
{
    std::set<std::string> given;
    for (const NamedTree& each : scene.initial) given.insert(each.name);
    const auto missing_of = [&](const std::vector<Symbol>& symbols) {
        std::vector<std::string> out;
        for (const Symbol& symbol : symbols) {
            if (!given.contains(symbol.name)) out.push_back(symbol.name);
        }
        return out;
    };
    const Fibre& fibre = reader.model.fibre;
    const std::vector<std::string> no_fibre = missing_of(fibre.coordinates);
    const std::vector<std::string> no_momentum = missing_of(fibre.momenta);
    const bool some_fibre = no_fibre.size() < fibre.coordinates.size();
    const bool some_momenta = no_momentum.size() < fibre.momenta.size();
    if (some_fibre && some_momenta) {
        throw ModelError(fmt::format("scene '{}' mixes fibre coordinates and momenta in 'initial'", scene.name),
                         scene.where, "give every fibre coordinate or every momentum");
    }
    std::vector<std::string> missing = missing_of(reader.model.base.coordinates);
    const std::vector<std::string>& rest = some_momenta ? no_momentum : no_fibre;
    if (!scene.rest || some_momenta) missing.insert(missing.end(), rest.begin(), rest.end());
    if (missing.empty()) return;
    const bool fibre_left_out = !rest.empty() && !some_momenta;
    throw ModelError(fmt::format("scene '{}' leaves out the initial value{} of {}", scene.name,
                                 missing.size() > 1 ? "s" : "", comma_list(missing)),
                     scene.where, fibre_left_out ? "rest = true sets the fibre coordinates left out to zero" : "");
}

void require_acyclic_scene(const ModelReader& reader, const Scene& scene)
{
    if (scene.parameters.empty()) return;
    std::vector<NamedTree> values;
    for (const Parameter& parameter : reader.model.parameters) {
        values.push_back(NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    for (const NamedTree& own : scene.parameters) put(values, own);
    require_acyclic(values);
}

} // namespace lagen
