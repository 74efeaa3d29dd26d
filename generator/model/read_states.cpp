// SPDX-License-Identifier: GPL-2.0-or-later
/// The [states] block: `z = rate`, first-order states and quadratures beside the algebroid.
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

namespace lagen {

void declare_states(ModelReader& reader)
{
    if (reader.states == nullptr) return;
    const TableReader table(reader.states->value, "[states]");
    for (const TomlEntry& entry : reader.states->value.entries)
        declare_symbols(reader, read_declaration(reader, entry.key).symbols, Role::state);
}

void read_states(ModelReader& reader)
{
    if (reader.states == nullptr) return;
    const Role ambient = is_nonholonomic(reader.model) ? Role::ambient : Role::fibre;
    const auto roles = {Role::time, Role::parameter, Role::base,  Role::fibre,
                        ambient,    Role::momentum,  Role::state, Role::input};
    std::vector<FirstOrderState>& states = reader.model.states;
    auto next = states.begin();
    for (const TomlEntry& entry : reader.states->value.entries) {
        const DeclaredKey key = read_declaration(reader, entry.key);
        const std::string what = fmt::format("the rate of the state '{}'", key.name);
        const ArrayValue closed =
            reader.close_mechanical_array(read_array_expression(entry.value, what), roles, what, true);
        for (Tree& rate : fit_values(closed, key.shape, what, entry.value.where)) (next++)->rate = std::move(rate);
    }
}

} // namespace lagen
