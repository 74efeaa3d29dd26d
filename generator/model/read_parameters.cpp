// SPDX-License-Identifier: GPL-2.0-or-later
/// Parameter values, settings from the command line, and the base's constraints, Casimirs and domain.
#include "model/model_reader.hpp"

#include "expression/parse.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

void apply(ModelReader& reader, const Setting& setting)
{
    for (Parameter& parameter : reader.model.parameters) {
        if (parameter.symbol.name != setting.name) continue;
        parameter.value = reader.close(parse_expression(setting.value), {Role::parameter},
                                       fmt::format("the value set for parameter '{}'", setting.name));
        return;
    }
    const Names::Entry* entry = reader.names.find(setting.name);
    const std::string what = entry != nullptr
                                 ? fmt::format("'{}' is {}, not a parameter", setting.name, role_text(entry->role))
                                 : fmt::format("the model has no parameter '{}' to set", setting.name);
    throw ModelError(what, setting.value.range(0, setting.value.text.size()),
                     hint_for(setting.name, reader.names.of(Role::parameter), "parameters"));
}

/// Strings of the list `key` of [base].
std::vector<Excerpt> base_list(const TomlEntry& block, const char* key)
{
    TableReader table(block.value, "[base]");
    const TomlEntry* entry = table.take(key);
    return entry != nullptr ? read_list(entry->value, fmt::format("'{}' of [base]", key)) : std::vector<Excerpt>{};
}

bool is_strict(Comparison comparison)
{
    return comparison == Comparison::less || comparison == Comparison::greater || comparison == Comparison::not_equal;
}

Tree read_inequality(const ModelReader& reader, const Excerpt& text)
{
    const Tree parsed = parse_comparison(text);
    if (parsed->kind != TreeKind::compare || !is_strict(parsed->comparison)) {
        throw ModelError(fmt::format("the domain condition '{}' is not a strict inequality", text.text),
                         text.range(0, text.text.size()), "use <, > or !=");
    }
    return reader.close(parsed, {Role::parameter, Role::base}, "the domain");
}

} // namespace

void read_parameters(ModelReader& reader, const TomlEntry* block, const std::vector<Setting>& settings)
{
    if (block != nullptr) {
        for (std::size_t k = 0; k < block->value.entries.size(); ++k) {
            const TomlEntry& entry = block->value.entries[k];
            const Tree value = read_expression(entry.value, fmt::format("the parameter '{}'", entry.name()));
            reader.model.parameters[k].value =
                reader.close(value, {Role::parameter}, fmt::format("the value of parameter '{}'", entry.name()));
        }
    }
    for (const Setting& setting : settings) apply(reader, setting);
    std::vector<NamedTree> values;
    for (const Parameter& parameter : reader.model.parameters) {
        values.push_back(NamedTree{parameter.symbol.name, parameter.value, parameter.symbol.where});
    }
    require_acyclic(values);
}

void require_acyclic(const std::vector<NamedTree>& parameters)
{
    std::map<std::string, std::size_t> index;
    for (std::size_t k = 0; k < parameters.size(); ++k) index.emplace(parameters[k].name, k);
    struct Visit {
        std::size_t parameter;
        std::vector<std::string> uses;
        std::size_t next;
    };
    std::set<std::size_t> done;
    std::vector<Visit> path;
    const auto enter = [&](std::size_t k) { path.push_back(Visit{k, names_in(parameters[k].value), 0}); };
    for (std::size_t first = 0; first < parameters.size(); ++first) {
        if (!done.contains(first)) enter(first);
        while (!path.empty()) {
            Visit& top = path.back();
            if (top.next == top.uses.size()) {
                done.insert(top.parameter);
                path.pop_back();
                continue;
            }
            const auto place = index.find(top.uses[top.next++]);
            if (place == index.end() || done.contains(place->second)) continue;
            const std::size_t used = place->second;
            const auto start =
                std::find_if(path.begin(), path.end(), [&](const Visit& v) { return v.parameter == used; });
            if (start == path.end()) {
                enter(used);
                continue;
            }
            std::string cycle;
            for (auto each = start; each != path.end(); ++each) cycle += parameters[each->parameter].name + " -> ";
            throw ModelError(
                fmt::format("the parameters depend on each other in a cycle: {}{}", cycle, parameters[used].name),
                parameters[used].where, "give one of them a value of its own");
        }
    }
}

void read_base(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    Base& base = reader.model.base;
    const auto point = {Role::parameter, Role::base};
    for (const Excerpt& text : base_list(*block, "constraints")) {
        base.constraints.push_back(reader.close(parse_expression(text), point, "a constraint"));
    }
    for (const auto& [key, value] : reader.casimirs) {
        const std::string what = fmt::format("the Casimir '{}'", key.text);
        base.casimirs.push_back(NamedTree{key.text, reader.close(value, point, what), key.range(0, key.text.size())});
    }
    for (const Excerpt& text : base_list(*block, "domain")) base.domain.push_back(read_inequality(reader, text));
}

} // namespace lagen
