// SPDX-License-Identifier: GPL-2.0-or-later
/// The [control.boundary] block: where a control problem starts, where it ends, and how long it may take.
#include "model/families.hpp"

#include "model/read_values.hpp"
#include "model/table_reader.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// Values of base coordinates; a family's name gives all its entries.
std::vector<NamedTree> read_point(const ModelReader& reader, const TomlEntry& block)
{
    const std::string title = fmt::format("'{}' of [control.boundary]", block.name());
    const TableReader table(block.value, title);
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    std::vector<NamedTree> out;
    for (const TomlEntry& entry : block.value.entries) {
        const ResolvedKey key = require_key(base, entry.key, title, "base coordinate", &reader.model.scope);
        const std::string what = fmt::format("the value of '{}' in {}", key.name, title);
        const ArrayValue closed = reader.close_array(read_array_expression(entry.value, what), {Role::parameter}, what);
        const std::vector<Tree> values = fit_values(closed, key.shape, what, entry.value.where);
        for (std::size_t k = 0; k < values.size(); ++k) {
            const std::string& name = base[key.indices[k]].name;
            if (std::ranges::any_of(out, [&](const NamedTree& each) { return each.name == name; }))
                throw ModelError(fmt::format("{} gives '{}' twice", title, name), entry.where(), "keep one of them");
            out.push_back(NamedTree{name, values[k], entry.where()});
        }
    }
    return out;
}

/// Every base coordinate has a value at the start.
void require_start(const ModelReader& reader, const ControlBoundary& boundary)
{
    std::vector<std::string> missing;
    for (const Symbol& symbol : reader.model.base.coordinates)
        if (std::ranges::none_of(boundary.from, [&](const NamedTree& each) { return each.name == symbol.name; }))
            missing.push_back(symbol.name);
    if (missing.empty()) return;
    throw ModelError(fmt::format("'from' of [control.boundary] leaves out {}", comma_list(missing)), boundary.where,
                     "only 'to' may leave coordinates free");
}

} // namespace

ControlBoundary read_boundary(const ModelReader& reader, const TomlEntry& block)
{
    ControlBoundary boundary;
    boundary.where = block.where();
    TableReader table(block.value, "[control.boundary]");
    table.refuse_later({"to_element"});
    if (const TomlEntry* entry = table.take("from")) boundary.from = read_point(reader, *entry);
    if (const TomlEntry* entry = table.take("to")) boundary.to = read_point(reader, *entry);
    const TomlEntry* duration = table.take("duration");
    if (const TomlEntry* entry = table.take("terminal_cost"))
        boundary.terminal_cost = reader.close_mechanical(read_expression(entry->value, "the terminal cost"),
                                                         {Role::parameter, Role::base}, "the terminal cost");
    table.finish();
    require_start(reader, boundary);
    if (duration == nullptr) return boundary;
    boundary.free_duration = duration->value.kind == TomlKind::string && duration->value.text.text == "free" &&
                             reader.names.find("free") == nullptr;
    const std::string what = "'duration' of [control.boundary]";
    if (!boundary.free_duration)
        boundary.duration = reader.close(read_expression(duration->value, what), {Role::parameter}, what);
    return boundary;
}

} // namespace lagen
