// SPDX-License-Identifier: GPL-2.0-or-later
/// The [control] block: controls, the section sigma, the running cost, bounds, guesses.
#include "model/algebroid_draft.hpp"
#include "model/components.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"
#include "model/total_cost.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t most_controls = 1000; // d2H/du2 has a million entries then

/// An entry of [control] that must be there.
const TomlEntry& require_entry(const TomlEntry& block, const char* key, const char* hint)
{
    TableReader table(block.value, "[control]");
    if (const TomlEntry* entry = table.take(key)) return *entry;
    throw ModelError(fmt::format("[control] has no key '{}'", key), block.where(), hint);
}

/// The two ends of an interval, each a value or a vector of values.
std::pair<const TomlValue*, const TomlValue*> ends_of(const TomlEntry& entry, const std::string& what)
{
    const TomlValue& value = entry.value;
    if (value.kind == TomlKind::array && value.items.size() == 2) return {&value.items[0], &value.items[1]};
    const std::string found = value.kind == TomlKind::array ? fmt::format("an array of {}", value.items.size())
                                                            : std::string(kind_text(value.kind));
    throw ModelError(fmt::format("{} are {}, where a lower and an upper bound are required", what, found), value.where,
                     fmt::format("write {} = [lower, upper]", entry.name()));
}

/// "-inf" or "inf" for no bound, as text or as a number of TOML.
bool is_open(const TomlValue& value, bool lower)
{
    const std::string& text = value.text.text;
    if (value.kind != TomlKind::string && (value.kind != TomlKind::decimal || value.finite)) return false;
    return lower ? text == "-inf" : text == "inf" || text == "+inf";
}

std::vector<ControlBound> read_bounds(const ModelReader& reader, const TomlEntry& block)
{
    const TableReader table(block.value, "'bounds' of [control]");
    const std::vector<Symbol>& controls = reader.model.control->controls;
    std::vector<ControlBound> out;
    for (const TomlEntry& entry : block.value.entries) {
        const ResolvedKey key =
            require_key(controls, entry.key, "'bounds' of [control]", "control", &reader.model.scope);
        const std::string what = fmt::format("the bounds of '{}'", key.name);
        const auto ends = ends_of(entry, what);
        const auto values = [&](const TomlValue& value) {
            if (is_open(value, &value == ends.first)) return std::vector<Tree>(key.indices.size());
            const Tree tree = read_array_expression(value, "a bound of '" + key.name + "'");
            return fit_values(reader.close_array(tree, {Role::parameter}, "a bound of '" + key.name + "'"), key.shape,
                              "a bound of '" + key.name + "'", value.where);
        };
        const std::vector<Tree> lower = values(*ends.first);
        const std::vector<Tree> upper = values(*ends.second);
        for (std::size_t k = 0; k < lower.size(); ++k) {
            const std::string& name = controls[key.indices[k]].name;
            for (const ControlBound& other : out) {
                if (other.control != key.indices[k]) continue;
                throw ModelError(fmt::format("the bounds of '{}' are given twice", name), entry.where(),
                                 "keep one of them");
            }
            if (!lower[k] && !upper[k]) continue; // no bounds at all
            out.push_back(ControlBound{key.indices[k], lower[k], upper[k], entry.where()});
        }
    }
    return out;
}

/// Where the search for the controls begins, a tree a control.
std::vector<Tree> read_guess(const ModelReader& reader, const TomlEntry& block)
{
    const TableReader table(block.value, "'guess' of [control]");
    const std::vector<Symbol>& controls = reader.model.control->controls;
    std::vector<Tree> out(controls.size());
    for (const TomlEntry& entry : block.value.entries) {
        const ResolvedKey key =
            require_key(controls, entry.key, "'guess' of [control]", "control", &reader.model.scope);
        const std::string what = fmt::format("the guess of '{}'", key.name);
        const ArrayValue closed =
            reader.close_mechanical_array(read_array_expression(entry.value, what),
                                          {Role::time, Role::parameter, Role::base, Role::momentum}, what, true);
        const std::vector<Tree> values = fit_values(closed, key.shape, what, entry.value.where);
        for (std::size_t k = 0; k < values.size(); ++k) {
            Tree& guess = out[key.indices[k]];
            if (guess)
                throw ModelError(fmt::format("the guess of '{}' is given twice", controls[key.indices[k]].name),
                                 entry.where(), "keep one of them");
            guess = values[k];
        }
    }
    return out;
}

} // namespace

void declare_control(ModelReader& reader)
{
    const TomlEntry* block = reader.mechanics.control;
    if (block == nullptr) return;
    TableReader table(block->value, "[control]");
    for (const char* key : {"controls", "sigma", "cost", "bounds", "guess", "boundary"}) (void)table.take(key);
    table.finish();
    const TomlEntry& controls = require_entry(*block, "controls", "controls = [\"u1\", \"u2\"]");
    reader.model.control.emplace().where = block->where();
    declare_symbols(reader, read_names(reader, controls, "'controls' of [control]"), Role::control);
    const std::size_t count = reader.model.control->controls.size();
    if (count > most_controls)
        throw ModelError(fmt::format("'controls' of [control] names {} controls, more than {}", count, most_controls),
                         controls.value.where);
    if (count == 0)
        throw ModelError("'controls' of [control] names no control", controls.value.where,
                         "controls = [\"u1\", \"u2\"]");
}

void declare_total_cost(ModelReader& reader)
{
    if (reader.model.control && reader.names.find(total_cost_name) == nullptr)
        declare_symbols(reader, {Symbol{total_cost_name, {}, {}, {}, {}}}, Role::state);
}

void define_cost(ModelReader& reader)
{
    const TomlEntry* block = reader.mechanics.control;
    const TomlEntry* cost = block == nullptr ? nullptr : find_entry(block->value, "cost");
    if (cost == nullptr || reader.names.find("cost") != nullptr) return;
    reader.observer.define(Definition{"cost", {}, read_expression(cost->value, "the cost"), cost->where()});
}

void read_control(ModelReader& reader)
{
    const TomlEntry* block = reader.mechanics.control;
    if (block == nullptr) return;
    Control& control = *reader.model.control;
    const auto roles = {Role::time, Role::parameter, Role::base, Role::control};
    const auto moving = {Role::time, Role::parameter, Role::base, Role::control, Role::input};
    const TomlEntry& sigma = require_entry(*block, "sigma", "sigma = { a = \"..\" } for sigma = sigma^a e_a");
    control.sigma = read_components(reader, sigma, {"'sigma' of [control]", "sigma along", moving, false});
    const TomlEntry& cost = require_entry(*block, "cost", "cost = \"u^2/2\"; cost = 1 asks for the least time");
    control.cost = reader.close_mechanical(read_expression(cost.value, "the cost"), roles, "the cost");
    for (std::size_t k = 0; k < reader.model.states.size(); ++k)
        if (is_total_cost(reader.model, k)) reader.model.states[k].rate = control.cost;
    TableReader table(block->value, "[control]");
    if (const TomlEntry* bounds = table.take("bounds")) control.bounds = read_bounds(reader, *bounds);
    if (const TomlEntry* guess = table.take("guess")) control.guess = read_guess(reader, *guess);
    if (const TomlEntry* boundary = table.take("boundary")) control.boundary = read_boundary(reader, *boundary);
}

} // namespace lagen
