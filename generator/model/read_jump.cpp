// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/read_jump.hpp"

#include "expression/parse_family.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

bool stands_in(const std::vector<NamedTree>& jump, const std::vector<Symbol>& symbols)
{
    return std::ranges::any_of(jump,
                               [&](const NamedTree& each) { return index_of(symbols, each.name) < symbols.size(); });
}

[[noreturn]] void refuse_name(const ModelReader& reader, const TomlEntry& entry, const std::string& title)
{
    std::vector<std::string> known = declared_names(reader.model.base.coordinates);
    for (const std::vector<std::string>& more :
         {declared_names(reader.model.fibre.coordinates), declared_names(reader.model.fibre.momenta),
          declared_names(state_symbols(reader.model))})
        known.insert(known.end(), more.begin(), more.end());
    throw ModelError(fmt::format("the jump of {} sets '{}', which is no coordinate, momentum or first-order state",
                                 title, entry.name()),
                     entry.where(), hint_for(entry.name(), known, "coordinates"));
}

/// Refuses a name that nothing but the motion itself may change.
void require_free(const ModelReader& reader, const std::string& name, const TomlEntry& entry, const std::string& title)
{
    for (const Tree& constraint : reader.model.base.constraints) {
        if (!mentions(constraint, name)) continue;
        throw ModelError(fmt::format("the jump of {} sets '{}', which the constraint {} = 0 holds", title, name,
                                     to_text(constraint)),
                         entry.where(), "let it set fibre coordinates or momenta");
    }
    const std::size_t state = index_of(state_symbols(reader.model), name);
    for (const Reconstruction& g : reader.model.reconstructions)
        if (g.holds(state))
            throw ModelError(
                fmt::format("the jump of {} sets '{}', an entry of a matrix of the group {}", title, name, g.group),
                entry.where(), "let it set fibre coordinates, which the matrix follows");
}

} // namespace

std::vector<NamedTree> read_jump(const ModelReader& reader, const TomlEntry& block, const std::string& title)
{
    const TableReader table(block.value, "'jump' of " + title);
    const Model& model = reader.model;
    if (model.control)
        throw ModelError(
            fmt::format("{} has a 'jump', but the costates of [control] jump by the condition that the motion is the "
                        "best one",
                        title),
            block.where(), "leave the jump out, or the model without [control]");
    const std::vector<Symbol> states = state_symbols(model);
    std::vector<NamedTree> jump;
    for (const TomlEntry& entry : block.value.entries) {
        bool found = false;
        for (const auto* symbols : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta, &states}) {
            const std::optional<ResolvedKey> key = resolve_key(*symbols, entry_key(entry.key, model.scope));
            if (!key || found) continue;
            found = true;
            const std::string what = fmt::format("'{}' in the jump of {}", key->name, title);
            const ArrayValue closed = reader.observer.close_array(read_array_expression(entry.value, what), true);
            const std::vector<Tree> values = fit_values(closed, key->shape, what, entry.value.where);
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::string& name = (*symbols)[key->indices[k]].name;
                require_free(reader, name, entry, title);
                if (std::ranges::find(jump, name, &NamedTree::name) != jump.end())
                    throw ModelError(fmt::format("the jump of {} sets '{}' twice", title, name), entry.where(),
                                     "keep one of them");
                jump.push_back({name, values[k], entry.where()});
            }
        }
        if (!found) refuse_name(reader, entry, title);
    }
    if (stands_in(jump, model.fibre.coordinates) && stands_in(jump, model.fibre.momenta))
        throw ModelError(fmt::format("the jump of {} sets fibre coordinates and momenta", title), block.where(),
                         "keep one kind: each follows from the other");
    return jump;
}

} // namespace lagen
