// SPDX-License-Identifier: GPL-2.0-or-later
/// What a discrete scene starts from: the first arrow g_0 of the groupoid, by its group part `element` and its target
/// `next`, or values of momenta or fibre coordinates in `initial`; and the number of its steps.
#include "model/scene_reader.hpp"

#include "expression/parse_family.hpp"
#include "model/read_values.hpp"
#include "model/scene_values.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// Whether `key` may stand in a scene of this model.
void require_discrete(const Model& model, const Scene& scene, const TomlEntry& entry)
{
    if (!model.discrete)
        throw ModelError(fmt::format("scene '{}' gives '{}', which belongs to discrete scenes, but the model has no "
                                     "[discrete]",
                                     scene.name, entry.name()),
                         entry.where());
    if (entry.name() == "element" && !model.groupoid->has_group())
        throw ModelError(fmt::format("scene '{}' gives 'element', but a pair groupoid has no group part", scene.name),
                         entry.where(), "give 'next', the target of the first arrow");
    if (entry.name() == "next" && !model.groupoid->has_targets())
        throw ModelError(
            fmt::format("scene '{}' gives 'next', but the target of an arrow of this groupoid follows from "
                        "its 'element'",
                        scene.name),
            entry.where(), "leave it out");
}

std::vector<Tree> read_element(const ModelReader& reader, const Scene& scene, const TomlEntry& entry)
{
    const std::string what = fmt::format("'element' of scene '{}'", scene.name);
    const Shape& wanted = reader.model.groupoid->generators[0].shape;
    const ArrayValue closed = reader.close_array(read_array_expression(entry.value, what), {Role::parameter}, what);
    if (closed.shape == wanted) return closed.entries;
    throw ModelError(fmt::format("{} is {}, where {} is required", what, to_text(closed.shape), to_text(wanted)),
                     entry.value.where, "it is a matrix of the group of the groupoid");
}

std::vector<NamedTree> read_target(const ModelReader& reader, const Scene& scene, const TomlEntry& entry)
{
    const std::string title = fmt::format("'next' of scene '{}'", scene.name);
    const TableReader table(entry.value, title);
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    GivenValues given("the next value of");
    for (const TomlEntry& each : entry.value.entries)
        given.add(reader, each, require_key(base, each.key, title, "base coordinate", &reader.model.scope), base);
    return std::move(given.list);
}

[[noreturn]] void refuse_missing(const Scene& scene, const char* what, const Missing& missing)
{
    throw ModelError(fmt::format("scene '{}' leaves out the {} value{} of {}", scene.name, what,
                                 missing.count > 1 ? "s" : "", missing.text()),
                     scene.where);
}

/// The parts of an arrow that its kind has.
void require_parts(const ModelReader& reader, const Scene& scene)
{
    const GroupoidBlock& groupoid = *reader.model.groupoid;
    if (groupoid.has_group() && scene.element.empty())
        throw ModelError(fmt::format("scene '{}' leaves out 'element', the group part of its first arrow", scene.name),
                         scene.where);
    if (!groupoid.has_targets()) return;
    const Missing missing = missing_of(reader.model.base.coordinates, given_names(scene.next));
    if (missing.count > 0) refuse_missing(scene, "next", missing);
}

} // namespace

void read_first_arrow(const ModelReader& reader, Scene& scene, TableReader& table)
{
    const Model& model = reader.model;
    const TomlEntry* element = table.take("element");
    const TomlEntry* next = table.take("next");
    const TomlEntry* steps = table.take("steps");
    for (const TomlEntry* entry : {element, next, steps})
        if (entry != nullptr) require_discrete(model, scene, *entry);
    if (element != nullptr) {
        scene.element = read_element(reader, scene, *element);
        scene.element_where = element->value.where;
    }
    if (next != nullptr) put_all(scene.next, read_target(reader, scene, *next));
    if (steps != nullptr)
        scene.steps = read_count(steps->value, fmt::format("'steps' of scene '{}'", scene.name), 1, 1'000'000'000);
}

void require_first_arrow(const ModelReader& reader, const Scene& scene)
{
    const Model& model = reader.model;
    const std::set<std::string> given = given_names(scene.initial);
    const Missing no_base = missing_of(model.base.coordinates, given);
    const Missing no_fibre = missing_of(model.fibre.coordinates, given);
    const Missing no_momenta = missing_of(model.fibre.momenta, given);
    const bool fibre = no_fibre.count < model.fibre.coordinates.size();
    const bool momenta = no_momenta.count < model.fibre.momenta.size();
    const bool arrow = !scene.element.empty() || !scene.next.empty();
    if (no_base.count > 0) refuse_missing(scene, "initial", no_base);
    if ((arrow && (fibre || momenta)) || (fibre && momenta))
        throw ModelError(fmt::format("scene '{}' starts from {} at once", scene.name,
                                     arrow ? "an arrow and from values of the fibre" : "fibre coordinates and momenta"),
                         scene.where, "give the first arrow, or every momentum, or every fibre coordinate");
    if (arrow) return require_parts(reader, scene);
    if (momenta && no_momenta.count > 0) refuse_missing(scene, "initial", no_momenta);
    if (momenta) return;
    const std::string first = model.groupoid->kind == GroupoidKind::pair     ? "'next'"
                              : model.groupoid->kind == GroupoidKind::atiyah ? "'next' and 'element'"
                                                                             : "'element'";
    if (!fibre && !scene.rest)
        throw ModelError(fmt::format("scene '{}' gives neither its first arrow ({}) nor momenta", scene.name, first),
                         scene.where, "an arrow is the first step; momenta determine it");
    if (!model.lagrangian)
        throw ModelError(
            fmt::format("scene '{}' starts from fibre coordinates, which give momenta by [lagrangian] alone",
                        scene.name),
            scene.where, fmt::format("give {}, or momenta in 'initial'", first));
    if (!scene.rest && no_fibre.count > 0) refuse_missing(scene, "initial", no_fibre);
}

} // namespace lagen
