// SPDX-License-Identifier: GPL-2.0-or-later
#include "reduction/reduced_document.hpp"

#include "expression/parse.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {
namespace {

/// Whether one of these functions is applied in a tree as parsed.
bool applies(const Tree& tree, const std::set<std::string>& functions)
{
    if (tree->kind == TreeKind::apply && functions.contains(tree->name)) return true;
    return std::ranges::any_of(tree->arguments, [&](const Tree& each) { return applies(each, functions); });
}

/// "a", "[a, b]", "[[a, b], [c, d]]"
std::string array_text(const ArrayValue& value)
{
    if (value.shape.rank == Rank::scalar) return to_text(value.entries[0]);
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < value.shape.rows; ++i) {
        std::vector<std::string> row;
        for (std::size_t j = 0; j < value.shape.columns; ++j)
            row.push_back(to_text(value.entries[i * value.shape.columns + j]));
        const std::string text = fmt::format("{}", fmt::join(row, ", "));
        rows.push_back(value.shape.rank == Rank::matrix ? "[" + text + "]" : text);
    }
    return fmt::format("[{}]", fmt::join(rows, ", "));
}

} // namespace

void ReducedDocument::write_out_rates(const Model& model)
{
    std::set<std::string> rates{"Dt"}; // and functions of the model that are made of it
    for (std::size_t before = 0; before != rates.size();) {
        before = rates.size();
        for (const Definition& each : model.definitions)
            if (!each.parameters.empty() && applies(each.body, rates)) rates.insert(each.name);
    }
    for (const Definition& each : model.definitions) {
        if (!applies(each.body, rates)) continue;
        if (each.parameters.empty())
            entry_in(at("definitions"), each.name) =
                toml_string(array_text(model.observer.close_array(each.body, true)));
        else
            std::erase_if(at("definitions").entries,
                          [&](const TomlEntry& entry) { return entry.name().starts_with(each.name + "("); });
    }
    for (const char* block : {"forces", "dissipation", "states", "observables", "invariants"}) {
        TomlValue* table = find(block);
        if (table == nullptr) continue;
        for (TomlEntry& entry : table->entries) {
            if (entry.value.kind != TomlKind::string) continue;
            const Tree tree = parse_expression(whole_text(block, entry.value.text.text));
            if (!applies(tree, rates)) continue;
            try {
                entry.value = toml_string(array_text(model.observer.close_array(tree, true)));
            } catch (const UnknownSymbol&) { // a running index: the reader of the file says what it makes of the rate
            }
        }
    }
}

ReducedDocument::ReducedDocument(const CheckedModel& whole, const std::string& how)
    : document_(parse_toml(whole.model.file))
{
    const Model& model = whole.model;
    forget("name");
    at("title") = toml_string(fmt::format("{}, reduced {}", model.title.empty() ? model.name : model.title, how));
    TomlValue& parameters = at("parameters");
    for (const Setting& setting : whole.settings)
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
