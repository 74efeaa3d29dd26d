// SPDX-License-Identifier: GPL-2.0-or-later
/// Reading a morphism file: its models first, then the map, whose values are written over the source and whose keys
/// are the target's.
#include "model/morphism.hpp"

#include "expression/find_part.hpp"
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"
#include "model/read_file.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <functional>

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
        for (const Symbol& each : parameter_symbols(morphism.source)) out.names.insert(each.name);
        for (const std::vector<Symbol>* list : lists)
            for (const Symbol& each : *list) out.names.insert(each.name);
        return out;
    }

    [[nodiscard]] static std::vector<Tree> close(const Legal& legal, const TomlValue& value, const Shape& shape,
                                                 const std::string& what)
    {
        const Tree tree = read_array_expression(value, what);
        const ArrayValue closed = legal.scope.close_array(tree);
        const Tree bad =
            find_name(closed.entries, [&](const std::string& name) { return !legal.names.contains(name); });
        if (bad != nullptr)
            throw ModelError(fmt::format("{} may not depend on '{}'", what, bad->name),
                             bad->where.file ? bad->where : value.where, "allowed here: " + legal.noun);
        return fit_values(closed, shape, what, value.where);
    }

    /// One tree a symbol of the target; null where the table leaves one out.
    [[nodiscard]] std::vector<Tree> read(const TomlEntry& table, const std::vector<Symbol>& symbols, const char* noun,
                                         const Legal& legal) const
    {
        const std::string title = fmt::format("'{}' of [morphism]", table.name());
        const TableReader reader(table.value, title);
        std::vector<Tree> out(symbols.size());
        for (const TomlEntry& entry : table.value.entries) {
            const ResolvedKey key = require_key(symbols, entry.key, title, noun, &morphism.target.scope);
            const std::string what = fmt::format("the value of '{}'", key.name);
            const std::vector<Tree> values = close(legal, entry.value, key.shape, what);
            for (std::size_t k = 0; k < values.size(); ++k) {
                Tree& place = out[key.indices[k]];
                if (place)
                    throw ModelError(fmt::format("{} names '{}' twice", title, symbols[key.indices[k]].name),
                                     entry.where(), "keep one of them");
                place = values[k];
            }
        }
        return out;
    }

    [[nodiscard]] std::vector<Tree> read_all(const TomlEntry* table, const char* key, const SourceRange& where,
                                             const std::vector<Symbol>& symbols, const char* noun,
                                             const Legal& legal) const
    {
        if (table == nullptr) {
            if (symbols.empty()) return {};
            throw ModelError(
                fmt::format("[morphism] has no key '{}'", key), where,
                fmt::format("{} = {{ {} = \"..\" }}, a line a {} of the target", key, symbols[0].name, noun));
        }
        std::vector<Tree> out = read(*table, symbols, noun, legal);
        for (std::size_t k = 0; k < symbols.size(); ++k)
            if (!out[k])
                throw ModelError(
                    fmt::format("'{}' of [morphism] leaves out the {} '{}' of the target", key, noun, symbols[k].name),
                    table->where());
        return out;
    }
};

std::string path_beside(const MorphismFile& morphism, const TomlValue& value, const std::string& what)
{
    const fs::path name = read_text(value, what);
    if (name.empty()) throw ModelError(fmt::format("{} names no file", what), value.where);
    return (fs::path(morphism.file->name).parent_path() / name).lexically_normal().string();
}

std::shared_ptr<const SourceFile> file_beside(const MorphismFile& morphism, const TomlValue& value,
                                              const std::string& what)
{
    const std::string path = path_beside(morphism, value, what);
    try {
        return std::make_shared<const SourceFile>(SourceFile{path, read_file(path)});
    } catch (const ModelError& failure) {
        throw ModelError(failure.diagnostic().message, value.where, "paths are relative to the file they stand in");
    }
}

Model read_end(const MorphismFile& morphism, const TomlEntry* entry, const char* key, const SourceRange& where,
               const std::vector<Setting>& settings, const Choosers& choosers)
{
    if (entry == nullptr)
        throw ModelError(fmt::format("[morphism] has no key '{}'", key), where,
                         fmt::format("{} = \"model.toml\", or compose = [\"first.toml\", \"second.toml\"]", key));
    const auto file = file_beside(morphism, entry->value, fmt::format("'{}' of [morphism]", key));
    return read_model_text(file->name, file->text, settings, choosers);
}

/// Where both have the groupoids: W' by rows.
std::vector<Tree> read_element(const MapReader& reader, const TomlEntry& entry)
{
    const MorphismFile& morphism = reader.morphism;
    for (const Model* model : {&morphism.source, &morphism.target})
        if (!model->groupoid)
            throw ModelError(
                fmt::format("'element' of [morphism] is of a morphism of groupoids, and {} has no [groupoid]",
                            model->name),
                entry.where());
    const GroupoidBlock& from = *morphism.source.groupoid;
    if (!morphism.target.groupoid->has_group())
        throw ModelError(
            fmt::format("the arrows of {} have no group part that 'element' could give", morphism.target.name),
            entry.where());
    MapReader::Legal legal = reader.legal({&morphism.source.base.coordinates, &from.next, &from.element},
                                          "coordinates of an arrow and parameters of the source");
    add_to_scope(legal.scope, morphism.source, from.element, FamilyRole::element);
    add_to_scope(legal.scope, morphism.source, from.next, FamilyRole::next);
    return MapReader::close(legal, entry.value, morphism.target.groupoid->generators[0].shape, "the element");
}

std::vector<MorphismFile> read_stages(const MorphismFile& morphism, const TomlEntry& compose,
                                      const std::vector<Setting>& settings, const Choosers& choosers, int depth);
MorphismFile read_equal(const MorphismFile& morphism, const TomlEntry& entry, const std::vector<Setting>& settings,
                        const Choosers& choosers, int depth);

MorphismFile read_morphism_file(const std::shared_ptr<const SourceFile>& file, const std::vector<Setting>& settings,
                                const Choosers& choosers, int depth)
{
    MorphismFile morphism;
    morphism.file = file;
    const TomlValue document = parse_toml(file);
    TableReader top(document, "the morphism");
    const TomlEntry* name = top.take("name");
    const TomlEntry* block = top.take("morphism");
    const TomlEntry* alone = top.take("compose");
    if (const TomlEntry* title = top.take("title")) (void)read_text(title->value, "the title");
    top.finish();
    morphism.name = name != nullptr ? read_text(name->value, "the name") : fs::path(file->name).stem().string();

    if (block == nullptr) {
        morphism.stages = read_stages(morphism, *alone, settings, choosers, depth);
        return morphism;
    }
    TableReader table(block->value, "[morphism]");
    const TomlEntry* equals = table.take("equals");
    if (const TomlEntry* compose = table.take("compose")) {
        table.finish();
        morphism.stages = read_stages(morphism, *compose, settings, choosers, depth);
        if (equals != nullptr) morphism.equals = {read_equal(morphism, *equals, settings, choosers, depth)};
        return morphism;
    }
    const TomlEntry* source = table.take("source");
    const TomlEntry* target = table.take("target");
    const TomlEntry* base = table.take("base");
    const TomlEntry* fibre = table.take("fibre");
    const TomlEntry* parameters = table.take("parameters");
    const TomlEntry* controls = table.take("controls");
    const TomlEntry* element = table.take("element");
    table.finish();
    morphism.source = read_end(morphism, source, "source", block->where(), settings, choosers);
    morphism.target = read_end(morphism, target, "target", block->where(), {}, choosers);
    if (equals != nullptr) morphism.equals = {read_equal(morphism, *equals, settings, choosers, depth)};

    const MapReader reader{morphism};
    const Model& from = morphism.source;
    const Model& to = morphism.target;
    const std::vector<Symbol>& x = from.base.coordinates;
    morphism.base = reader.read_all(base, "base", block->where(), to.base.coordinates, "base coordinate",
                                    reader.legal({&x}, "base coordinates and parameters of the source"));
    if (element != nullptr) morphism.element = read_element(reader, *element);
    const bool of_groupoids = from.groupoid && to.groupoid && (element != nullptr || !to.groupoid->has_group());
    if (fibre != nullptr || !of_groupoids)
        morphism.fibre = reader.read_all(
            fibre, "fibre", block->where(), ambient_fibre(to),
            is_nonholonomic(to) ? "ambient fibre coordinate" : "fibre coordinate",
            reader.legal({&x, &ambient_fibre(from)},
                         is_nonholonomic(from)
                             ? "base coordinates, ambient fibre coordinates and parameters of the source"
                             : "base coordinates, fibre coordinates and parameters of the source"));
    if (parameters != nullptr)
        morphism.parameters =
            reader.read(*parameters, free_parameters(to), "parameter", reader.legal({}, "parameters of the source"));
    morphism.parameters.resize(free_parameters(to).size());
    if (controls == nullptr && !(from.control && to.control)) return morphism;
    for (const Model* model : {&from, &to})
        if (!model->control)
            throw ModelError(fmt::format("'controls' of [morphism] is of two control problems, and {} has no [control]",
                                         model->name),
                             controls->where());
    MapReader::Legal legal =
        reader.legal({&x, &from.control->controls}, "base coordinates, controls, t and parameters of the source");
    legal.names.insert("t");
    add_to_scope(legal.scope, from, from.control->controls, FamilyRole::control);
    if (controls != nullptr) {
        morphism.controls =
            reader.read_all(controls, "controls", block->where(), to.control->controls, "control", legal);
        return morphism;
    }
    for (const Symbol& control : to.control->controls) {
        if (std::ranges::find(from.control->controls, control.name, &Symbol::name) == from.control->controls.end())
            throw ModelError(fmt::format("[morphism] has no key 'controls', and the control '{}' of {} is none of {}",
                                         control.name, to.name, from.name),
                             block->where(), fmt::format("controls = {{ {} = \"..\" }}", control.name));
        morphism.controls.push_back(lagen::name(control.name));
    }
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

/// The morphism that a value of this one names; `what` is how messages call the value.
MorphismFile read_part(const MorphismFile& morphism, const TomlValue& value, const char* what,
                       const std::vector<Setting>& settings, const Choosers& choosers, int depth)
{
    const auto file = file_beside(morphism, value, what);
    if (!is_morphism(file)) throw ModelError(fmt::format("{} has no [morphism]", quote(file->name)), value.where);
    return read_morphism_file(file, settings, choosers, depth + 1);
}

std::vector<MorphismFile> read_stages(const MorphismFile& morphism, const TomlEntry& compose,
                                      const std::vector<Setting>& settings, const Choosers& choosers, int depth)
{
    if (depth >= deepest_composition)
        throw ModelError(fmt::format("morphisms are composed of each other more than {} deep", deepest_composition),
                         compose.where(), "a file may not be part of itself");
    if (compose.value.kind != TomlKind::array || compose.value.items.size() < 2)
        throw ModelError("'compose' of [morphism] needs at least two morphism files", compose.value.where,
                         "compose = [\"first.toml\", \"second.toml\"]");
    std::vector<MorphismFile> stages;
    for (const TomlValue& item : compose.value.items) {
        MorphismFile stage = read_part(morphism, item, "an entry of 'compose'",
                                       stages.empty() ? settings : std::vector<Setting>{}, choosers, depth);
        std::vector<MorphismFile> parts = std::move(stage.stages);
        if (parts.empty()) parts.push_back(std::move(stage));
        require_joint(stages, parts.front(), item.where);
        std::ranges::move(parts, std::back_inserter(stages));
    }
    return stages;
}

/// A morphism between the same two models.
MorphismFile read_equal(const MorphismFile& morphism, const TomlEntry& entry, const std::vector<Setting>& settings,
                        const Choosers& choosers, int depth)
{
    if (depth >= deepest_composition)
        throw ModelError(fmt::format("morphisms are made of each other more than {} deep", deepest_composition),
                         entry.where(), "a file may not be part of itself");
    MorphismFile other = read_part(morphism, entry.value, "'equals' of [morphism]", settings, choosers, depth);
    const auto ends = [](const MorphismFile& each) {
        return fmt::format("from {} to {}", quote(source_of(each).file->name), quote(target_of(each).file->name));
    };
    if (ends(other) != ends(morphism))
        throw ModelError(fmt::format("{} leads {}, and this morphism leads {}", quote(other.file->name), ends(other),
                                     ends(morphism)),
                         entry.value.where, "maps are equal where they have the same two ends");
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
    return find_entry(document, "morphism") != nullptr || find_entry(document, "compose") != nullptr;
}

MorphismFile read_morphism(const std::shared_ptr<const SourceFile>& file, const std::vector<Setting>& settings,
                           const Choosers& choosers)
{
    return read_morphism_file(file, settings, choosers, 0);
}

} // namespace lagen
