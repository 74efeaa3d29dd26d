// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/scene_values.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

namespace lagen {

void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries)
{
    std::unordered_map<std::string, std::size_t> index; // looked up, never iterated
    for (std::size_t k = 0; k < list.size(); ++k) index.emplace(list[k].name, k);
    for (NamedTree& entry : entries) {
        const auto [place, fresh] = index.try_emplace(entry.name, list.size());
        if (fresh) {
            list.push_back(std::move(entry));
        } else {
            list[place->second] = std::move(entry);
        }
    }
}

void GivenValues::add(const ModelReader& reader, const TomlEntry& entry, const ResolvedKey& key,
                      const std::vector<Symbol>& symbols)
{
    const std::string what = fmt::format("{} '{}'", what_, key.name);
    const Tree parsed = read_array_expression(entry.value, what);
    const ArrayValue closed = reader.close_array(parsed, {Role::parameter}, what);
    const std::vector<Tree> values = fit_values(closed, key.shape, what, entry.value.where);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const std::string& name = symbols[key.indices[k]].name;
        const auto [given, fresh] = keys_.try_emplace(name, entry.name());
        if (!fresh) {
            throw ModelError(
                fmt::format("{} '{}' is given twice: by '{}' and by '{}'", what_, name, given->second, entry.name()),
                entry.where(), "keep one of them");
        }
        list.push_back(NamedTree{name, values[k], entry.where()});
    }
}

void Missing::add(const Missing& more)
{
    count += more.count;
    names.insert(names.end(), more.names.begin(), more.names.end());
}

std::string Missing::text() const
{
    constexpr std::size_t most = 20;
    if (names.size() <= most) return comma_list(names);
    const std::vector<std::string> first(names.begin(), names.begin() + most);
    return fmt::format("{} and {} more", comma_list(first), names.size() - most);
}

Missing missing_of(const std::vector<Symbol>& symbols, const std::set<std::string>& given)
{
    Missing out;
    for (const SymbolGroup& group : group_symbols(symbols)) {
        Missing of_group;
        for (std::size_t k = 0; k < group.shape.size(); ++k) {
            const std::string& name = symbols[group.first + k].name;
            if (!given.contains(name)) of_group.names.push_back(name);
        }
        of_group.count = of_group.names.size();
        if (of_group.count == group.shape.size()) of_group.names = {group.name};
        out.add(of_group);
    }
    return out;
}

std::set<std::string> given_names(const std::vector<NamedTree>& entries)
{
    std::set<std::string> names;
    for (const NamedTree& each : entries) names.insert(each.name);
    return names;
}

} // namespace lagen
