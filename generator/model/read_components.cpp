// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/components.hpp"

#include "expression/rewrite.hpp"
#include "model/algebroid_draft.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>
#include <map>

namespace lagen {

std::vector<ComponentEntry> read_components(const ModelReader& reader, const TomlEntry& block,
                                            const ComponentRules& rules)
{
    const TableReader table(block.value, rules.title);
    const std::vector<Symbol>& fibre = ambient_fibre(reader.model);
    std::vector<ComponentEntry> out;
    std::map<std::size_t, std::string> given; // by which key
    const char* noun = is_nonholonomic(reader.model) ? "ambient fibre coordinate" : "fibre coordinate";
    for (const TomlEntry& entry : block.value.entries) {
        const std::vector<RunningKey> keys = require_keys(fibre, entry.key, rules.title, noun, reader.model.scope);
        const Tree parsed = read_array_expression(entry.value, fmt::format("{} '{}'", rules.what, entry.name()));
        for (const RunningKey& each : keys) {
            const ResolvedKey& key = each.key;
            const std::string what = fmt::format("{} '{}'", rules.what, key.name);
            const ArrayValue closed =
                reader.close_mechanical_array(replace_names(parsed, each.indices), rules.roles, what, rules.nonsmooth);
            const std::vector<Tree> values = fit_values(closed, key.shape, what, entry.value.where);
            for (std::size_t k = 0; k < values.size(); ++k) {
                const auto [place, fresh] = given.try_emplace(key.indices[k], entry.name());
                if (!fresh) {
                    throw ModelError(fmt::format("{} '{}' is given twice: by '{}' and by '{}'", rules.what,
                                                 fibre[key.indices[k]].name, place->second, entry.name()),
                                     entry.where(), "keep one of them");
                }
                const bool zero = values[k]->kind == TreeKind::number && values[k]->number == 0;
                if (!zero) out.push_back(ComponentEntry{key.indices[k], values[k], entry.where()});
            }
        }
    }
    return out;
}

} // namespace lagen
