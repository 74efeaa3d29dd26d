// SPDX-License-Identifier: GPL-2.0-or-later
/// The blocks that make a mechanical system of an algebroid: [lagrangian], [hamiltonian], [forces], [dissipation].
#include "model/components.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// The only key of a block, parsed.
Tree read_function(const TomlEntry& block, const char* key, const std::string& what, SourceRange& where)
{
    const std::string title = fmt::format("[{}]", block.name());
    TableReader table(block.value, title);
    const TomlEntry* entry = table.take(key);
    table.finish();
    if (entry == nullptr)
        throw ModelError(fmt::format("{} has no key '{}'", title, key), block.where(),
                         fmt::format("{} {} = \"..\"", title, key));
    where = entry->value.where;
    return read_expression(entry->value, fmt::format("{} '{}'", what, key));
}

/// Every run tracks the energy without being asked, and the other two are there under these names.
void refuse_built_in_invariants(const ModelReader& reader)
{
    const MechanicsBlocks& blocks = reader.mechanics;
    if (blocks.lagrangian == nullptr && blocks.hamiltonian == nullptr && blocks.control == nullptr) return;
    for (const auto& [key, value] : reader.invariants)
        if (key.text == "energy" || key.text == "lagrangian" || key.text == "hamiltonian")
            throw ModelError(fmt::format("the invariant '{0}' bears the name of the {0} of the model", key.text),
                             key.range(0, key.text.size()),
                             "choose another name; every run tracks the energy without being asked");
}

/// Pontryagin's equations have no place for forces: they would be passed over in silence.
void refuse_lone_forces(const MechanicsBlocks& blocks)
{
    if (blocks.control == nullptr || blocks.lagrangian != nullptr || blocks.hamiltonian != nullptr) return;
    for (const TomlEntry* block : {blocks.forces, blocks.dissipation})
        if (block != nullptr)
            throw ModelError(fmt::format("[{}] stands beside [control], where the model has neither [lagrangian] nor "
                                         "[hamiltonian] for it to act on",
                                         block->name()),
                             block->where(), "what acts on a system that is controlled is a part of sigma");
}

} // namespace

void declare_mechanics(ModelReader& reader)
{
    refuse_built_in_invariants(reader);
    refuse_lone_forces(reader.mechanics);
    const MechanicsBlocks& blocks = reader.mechanics;
    if (blocks.lagrangian != nullptr)
        reader.lagrangian = read_function(*blocks.lagrangian, "L", "the Lagrangian", reader.model.lagrangian_where);
    if (blocks.hamiltonian != nullptr)
        reader.hamiltonian = read_function(*blocks.hamiltonian, "H", "the Hamiltonian", reader.model.hamiltonian_where);
    SourceRange where;
    if (blocks.dissipation != nullptr)
        reader.dissipation = read_function(*blocks.dissipation, "R", "the Rayleigh function", where);
}

void read_mechanics(ModelReader& reader)
{
    Model& model = reader.model;
    const Role fibre = is_nonholonomic(model) ? Role::ambient : Role::fibre;
    const auto velocity = {Role::time, Role::parameter, Role::base, fibre};
    const auto pushing = {Role::time, Role::parameter, Role::base, fibre, Role::state, Role::input};
    const auto phase = {Role::time, Role::parameter, Role::base, Role::momentum};
    if (reader.lagrangian) model.lagrangian = reader.close(reader.lagrangian, velocity, "the Lagrangian");
    if (reader.hamiltonian) model.hamiltonian = reader.close_mechanical(reader.hamiltonian, phase, "the Hamiltonian");
    if (reader.dissipation)
        model.dissipation = reader.close_mechanical(reader.dissipation, velocity, "the Rayleigh function");
    if (reader.mechanics.forces != nullptr)
        model.forces = read_components(reader, *reader.mechanics.forces, {"[forces]", "the force on", pushing, true});
    for (const ComponentEntry& force : reader.inherited_forces)
        model.forces.push_back({force.section, reader.mechanical.close(force.value, true), force.where});
}

} // namespace lagen
