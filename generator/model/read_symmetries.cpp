// SPDX-License-Identifier: GPL-2.0-or-later
/// The [symmetries] block: `s = {a = expr}`, sections of E over the base.
#include "model/components.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// p_a s^a
Tree momentum_of(const Model& model, const std::vector<ComponentEntry>& section)
{
    std::vector<Tree> terms;
    for (const ComponentEntry& entry : section)
        terms.push_back(multiply({entry.value, name(model.fibre.momenta[entry.section].name)}));
    return terms.empty() ? number(0) : terms.size() == 1 ? terms[0] : add(std::move(terms));
}

} // namespace

void read_symmetries(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    refuse_nonholonomic(reader, *block);
    Model& model = reader.model;
    if (!model.lagrangian && !model.hamiltonian && !(model.discrete && model.discrete->lagrangian))
        throw ModelError("[symmetries] stands in a model without a function that they could leave invariant",
                         block->where(), "give [lagrangian] L, [hamiltonian] H or [discrete] L");
    const TableReader table(block->value, "[symmetries]");
    for (const TomlEntry& entry : block->value.entries) {
        require_identifier(entry.name(), entry.where(), "a name");
        Symmetry symmetry{entry.name(), entry.where(), {}, nullptr};
        symmetry.section = read_components(reader, entry,
                                           {fmt::format("the symmetry '{}'", entry.name()),
                                            fmt::format("the component of the symmetry '{}' on", entry.name()),
                                            {Role::parameter, Role::base},
                                            false});
        symmetry.momentum = momentum_of(model, symmetry.section);
        model.observables.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
        model.symmetries.push_back(std::move(symmetry));
    }
}

std::vector<NamedTree> conserved_trees(const Model& model)
{
    std::vector<NamedTree> trees = model.invariants;
    if (!model.forces.empty() || model.dissipation || model.control) return trees;
    for (const Symmetry& symmetry : model.symmetries)
        trees.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
    return trees;
}

} // namespace lagen
