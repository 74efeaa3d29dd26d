// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/reduce/reduced_document.hpp"

#include "diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

ReducedDocument::ReducedDocument(const Model& model, const std::vector<Setting>& settings, const std::string& how)
    : document_(parse_toml(model.file))
{
    forget("name");
    at("title") = toml_string(fmt::format("{}, reduced {}", model.title.empty() ? model.name : model.title, how));
    TomlValue& parameters = at("parameters");
    for (const Setting& setting : settings)
        if (setting.gives_value()) entry_in(parameters, setting.name) = toml_string(setting.value.text);
}

TomlValue* ReducedDocument::find(const std::string& block)
{
    const auto entry = std::ranges::find(document_.entries, block, &TomlEntry::name);
    return entry == document_.entries.end() ? nullptr : &entry->value;
}

void ReducedDocument::forget(const std::string& block)
{
    std::erase_if(document_.entries, [&](const TomlEntry& entry) { return entry.name() == block; });
}

void ReducedDocument::keep(const std::vector<std::string>& blocks)
{
    std::erase_if(document_.entries,
                  [&](const TomlEntry& entry) { return std::ranges::find(blocks, entry.name()) == blocks.end(); });
}

void ReducedDocument::erase(const std::string& block, const std::vector<std::string>& keys)
{
    if (TomlValue* table = find(block))
        std::erase_if(table->entries,
                      [&](const TomlEntry& each) { return std::ranges::find(keys, each.name()) != keys.end(); });
}

void ReducedDocument::drop(const std::vector<std::string>& blocks)
{
    for (const std::string& block : blocks)
        if (std::erase_if(document_.entries, [&](const TomlEntry& entry) { return entry.name() == block; }) > 0)
            dropped_.push_back(fmt::format("[{}]", block));
}

void ReducedDocument::drop(const std::string& block, const std::string& key, const std::string& called)
{
    erase(block, {key});
    dropped_.push_back(called);
}

std::string ReducedDocument::text(const std::string& head)
{
    static const std::vector<std::string> order{"parameters", "sizes",       "base",       "fibre",
                                                "algebroid",  "definitions", "lagrangian", "inputs",
                                                "forces",     "dissipation", "states"};
    const auto place = [&](const TomlEntry& entry) {
        if (entry.value.kind != TomlKind::table) return std::size_t{0};
        const auto found = std::ranges::find(order, entry.name());
        return entry.name() == "scene" ? order.size() + 2 : static_cast<std::size_t>(found - order.begin()) + 1;
    };
    std::ranges::stable_sort(document_.entries, {}, place);
    std::erase_if(document_.entries, [](const TomlEntry& entry) {
        return entry.value.kind == TomlKind::table && entry.value.entries.empty();
    });
    return fmt::format("{}{}\n", head,
                       dropped_.empty() ? "" : fmt::format("# Left out: {}.\n", fmt::join(dropped_, ", "))) +
           print_toml(document_);
}

void require_tangent_lagrangian(const Model& model, const char* reduction)
{
    const auto& over = model.algebroid.over;
    if (model.lagrangian && model.algebroid.kind == AlgebroidKind::tangent &&
        over.size() == model.base.coordinates.size() && std::ranges::is_sorted(over) && !model.groupoid &&
        !model.control)
        return;
    throw MathematicsError(fmt::format("{} takes a Lagrangian on a tangent bundle, and model '{}' is something else",
                                       reduction, model.name),
                           "morphisms of algebroids reduce other models: lagen reduce MORPHISM");
}

TomlValue toml_list(const std::vector<std::string>& texts)
{
    TomlValue list;
    list.kind = TomlKind::array;
    for (const std::string& text : texts) list.items.push_back(toml_string(text));
    return list;
}

} // namespace lagen
