// SPDX-License-Identifier: GPL-2.0-or-later
/// Reading a morphism file: its models first, then the map, whose values are written over the source and whose keys
/// are the target's.
#include "model/morphism.hpp"

#include "expression/find_part.hpp"
#include "expression/rewrite.hpp"
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace lagen {

namespace {

namespace fs = std::filesystem;

constexpr int deepest_composition = 8;

struct MapReader {
    const MorphismFile& morphism;

    /// The names that values of one table may depend on.
    struct Legal {
        Scope scope;
        std::set<std::string> names;
        std::string noun; ///< "base coordinates and parameters of the source"
    };

    [[nodiscard]] Legal legal(std::initializer_list<const std::vector<Symbol>*> lists, std::string noun) const
    {
        Legal out{morphism.source.scope, {}, std::move(noun)};
        for (const Symbol& each : symbols_of(morphism.source, Role::parameter)) out.names.insert(each.name);
        for (const std::vector<Symbol>* list : lists)
            for (const Symbol& each : *list) out.names.insert(each.name);
        return out;
    }

    [[nodiscard]] static std::vector<Tree> close(const Legal& legal, const Item& item, const Shape& shape,
                                                 const TreesByName& indices = {})
    {
        const Tree parsed = replace_names(read_array_expression(item.value(), item.title()), indices);
        const ArrayValue closed = legal.scope.close_array(parsed);
        const Tree bad =
            find_name(closed.entries, [&](const std::string& name) { return !legal.names.contains(name); });
        if (bad != nullptr)
            throw complain::may_not_depend(item.title(), fmt::format("'{}'", bad->name),
                                           bad->where.file ? bad->where : item.value().where,
                                           "allowed here: " + legal.noun);
        return fit_values(closed, shape, item.title(), item.value().where);
    }

    /// One tree a symbol of the target; null where the table leaves one out.
    [[nodiscard]] std::vector<Tree> read(const Item& table, const std::vector<Symbol>& symbols, const char* noun,
                                         const Legal& legal) const
    {
        std::vector<Tree> out(symbols.size());
        read_table(
            table, symbols, noun, morphism.target.scope,
            [&](const Item& item, const RunningKey& each) { return close(legal, item, each.key.shape, each.indices); },
            [&](std::size_t k, const Tree& value, const Item&) { out[k] = value; });
        return out;
    }

    [[nodiscard]] std::vector<Tree> read_all(const Item& block, const char* key, const std::vector<Symbol>& symbols,
                                             const char* noun, const Legal& legal) const
    {
        const Item table = block.at(key);
        if (!table) {
            if (symbols.empty()) return {};
            throw complain::missing(
                block.title(), {key}, block.where(),
                fmt::format("{} = {{ {} = \"..\" }}, a line a {} of the target", key, symbols[0].name, noun));
        }
        std::vector<Tree> out = read(table, symbols, noun, legal);
        for (std::size_t k = 0; k < symbols.size(); ++k)
            if (!out[k])
                throw complain::leaves_out(
                    table.title(), fmt::format("the {} '{}' of the target", noun, symbols[k].name), table.where());
        return out;
    }
};

/// A morphism hands this down to its parts.
struct Reading {
    const std::vector<Setting>& settings;
    const Choosers& choosers;
    int depth = 0; ///< how many morphisms this one is a part of
};

Model read_end(const Item& block, const char* key, const std::vector<Setting>& settings, const Choosers& choosers)
{
    const Item item = block.at(key);
    if (!item) throw complain::missing(block.title(), {key}, block.where(), row_below(block.row(), key)->hint);
    const auto file = file_named(item.value(), item.title());
    return read_model_text(file->name, file->text, settings, choosers);
}

/// Where both have the groupoids: W' by rows.
std::vector<Tree> read_element(const MapReader& reader, const Item& item)
{
    const MorphismFile& morphism = reader.morphism;
    for (const Model* model : {&morphism.source, &morphism.target})
        if (!model->groupoid)
            throw complain::needs("'element' of [morphism]", "a [groupoid] of " + model->name, item.where(),
                                  "it is of a morphism of groupoids");
    const GroupoidBlock& from = *morphism.source.groupoid;
    if (!morphism.target.groupoid->has_group())
        throw complain::takes_no("a morphism to " + morphism.target.name, "element", item.where(),
                                 "the arrows of the target have no group part");
    MapReader::Legal legal = reader.legal({&morphism.source.base.coordinates, &from.next, &from.element},
                                          "coordinates of an arrow and parameters of the source");
    add_to_scope(legal.scope, morphism.source, Role::element | Role::next);
    return MapReader::close(legal, item, morphism.target.groupoid->generators[0].shape);
}

std::vector<Tree> read_controls(const MapReader& reader, const Item& block)
{
    const Model &from = reader.morphism.source, &to = reader.morphism.target;
    const Item controls = block.at("controls");
    if (!controls && !(from.control && to.control)) return {};
    for (const Model* model : {&from, &to})
        if (!model->control)
            throw complain::needs(controls.title(), "[control] of " + model->name, controls.where(),
                                  "it is of two control problems");
    if (controls) {
        MapReader::Legal legal = reader.legal({&from.base.coordinates, &from.control->controls},
                                              "base coordinates, controls, t and parameters of the source");
        legal.names.insert("t");
        add_to_scope(legal.scope, from, Role::control);
        return reader.read_all(block, "controls", to.control->controls, "control", legal);
    }
    std::vector<Tree> same;
    for (const Symbol& control : to.control->controls) {
        if (index_of(from.control->controls, control.name) == from.control->controls.size())
            throw complain::missing(
                block.title(), {"controls"}, block.where(),
                fmt::format("the control '{0}' of {1} is none of {2}: controls = {{ {0} = \"..\" }}", control.name,
                            to.name, from.name));
        same.push_back(name(control.name));
    }
    return same;
}

std::vector<MorphismFile> read_stages(const Item& compose, const Reading& reading);
MorphismFile read_equal(const MorphismFile& morphism, const Item& item, const Reading& reading);

MorphismFile read_morphism_file(const std::shared_ptr<const SourceFile>& file, const Reading& reading)
{
    MorphismFile morphism;
    morphism.file = file;
    TomlEntry document;
    document.value = parse_toml(file);
    for (const TomlEntry& entry : document.value.entries)
        if (entry.name() != "name" && entry.name() != "title" && entry.name() != "morphism" &&
            entry.name() != "compose")
            throw complain::unknown_key(entry.name(), "the morphism", entry.where(),
                                        {"name", "morphism", "compose", "title"});
    const Item top(document);
    require_shape(top);
    morphism.name = top.at("name") ? top.at("name").text() : fs::path(file->name).stem().string();
    const Item block = top.at("morphism");
    const Item compose = block ? block.at("compose") : top.at("compose");
    if (compose) morphism.stages = read_stages(compose, reading);
    if (!compose) {
        morphism.source = read_end(block, "source", reading.settings, reading.choosers);
        morphism.target = read_end(block, "target", {}, reading.choosers);
    }
    if (const Item equals = block.at("equals")) morphism.equals = {read_equal(morphism, equals, reading)};
    if (compose) return morphism;

    const MapReader reader{morphism};
    const Model& from = morphism.source;
    const Model& to = morphism.target;
    const std::vector<Symbol>& x = from.base.coordinates;
    morphism.base = reader.read_all(block, "base", to.base.coordinates, "base coordinate",
                                    reader.legal({&x}, "base coordinates and parameters of the source"));
    const Item element = block.at("element");
    if (element) morphism.element = read_element(reader, element);
    const bool of_groupoids = from.groupoid && to.groupoid && (element || !to.groupoid->has_group());
    if (block.at("fibre") || !of_groupoids)
        morphism.fibre = reader.read_all(
            block, "fibre", ambient_fibre(to), is_nonholonomic(to) ? "ambient fibre coordinate" : "fibre coordinate",
            reader.legal({&x, &ambient_fibre(from)},
                         is_nonholonomic(from)
                             ? "base coordinates, ambient fibre coordinates and parameters of the source"
                             : "base coordinates, fibre coordinates and parameters of the source"));
    morphism.parameters = reader.read(block.at("parameters"), free_parameters(to), "parameter",
                                      reader.legal({}, "parameters of the source"));
    morphism.controls = read_controls(reader, block);
    return morphism;
}

void require_joint(const std::vector<MorphismFile>& before, const MorphismFile& next, const SourceRange& where)
{
    if (before.empty()) return;
    const std::string& end = before.back().target.file->name;
    const std::string& start = next.source.file->name;
    if (end == start) return;
    throw ModelError(fmt::format("the morphism before {} ends at {}, and its source is {}", quote(next.file->name),
                                 quote(end), quote(start)),
                     where);
}

/// The morphism that a value names; `what` is how messages call the value.
MorphismFile read_part(const TomlValue& value, const char* what, const Reading& reading)
{
    if (reading.depth >= deepest_composition)
        throw ModelError(fmt::format("morphisms are made of each other more than {} deep", deepest_composition),
                         value.where, "a file may not be part of itself");
    const auto file = file_named(value, what);
    if (!is_morphism(file)) throw ModelError(fmt::format("{} has no [morphism]", quote(file->name)), value.where);
    return read_morphism_file(file, {reading.settings, reading.choosers, reading.depth + 1});
}

std::vector<MorphismFile> read_stages(const Item& compose, const Reading& reading)
{
    const std::vector<Setting> none; // settings are of the first source
    std::vector<MorphismFile> stages;
    for (const TomlValue& item : compose.value().items) {
        MorphismFile stage = read_part(item, "an entry of 'compose'",
                                       {stages.empty() ? reading.settings : none, reading.choosers, reading.depth});
        std::vector<MorphismFile> parts = std::move(stage.stages);
        if (parts.empty()) parts.push_back(std::move(stage));
        require_joint(stages, parts.front(), item.where);
        std::ranges::move(parts, std::back_inserter(stages));
    }
    return stages;
}

/// A morphism between the same two models.
MorphismFile read_equal(const MorphismFile& morphism, const Item& item, const Reading& reading)
{
    MorphismFile other = read_part(item.value(), "'equals' of [morphism]", reading);
    const auto ends = [](const MorphismFile& each) {
        return fmt::format("from {} to {}", quote(source_of(each).file->name), quote(target_of(each).file->name));
    };
    if (ends(other) != ends(morphism))
        throw ModelError(fmt::format("{} leads {}, and this morphism leads {}", quote(other.file->name), ends(other),
                                     ends(morphism)),
                         item.value().where, "maps are equal where they have the same two ends");
    return other;
}

} // namespace

const Model& source_of(const MorphismFile& morphism)
{
    return morphism.stages.empty() ? morphism.source : morphism.stages.front().source;
}

const Model& target_of(const MorphismFile& morphism)
{
    return morphism.stages.empty() ? morphism.target : morphism.stages.back().target;
}

bool is_morphism(const std::shared_ptr<const SourceFile>& file)
{
    const TomlValue document = parse_toml(file);
    return std::ranges::any_of(document.entries, [](const TomlEntry& entry) {
        return entry.name() == "morphism" || entry.name() == "compose";
    });
}

MorphismFile read_morphism(const std::shared_ptr<const SourceFile>& file, const std::vector<Setting>& settings,
                           const Choosers& choosers)
{
    return read_morphism_file(file, {settings, choosers});
}

} // namespace lagen
