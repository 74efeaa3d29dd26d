// SPDX-License-Identifier: GPL-2.0-or-later
/// The Lagrangians of included files, with their forces and dissipation, become the model's where it has neither a
/// Lagrangian nor a Hamiltonian nor a control problem of its own. A frame e'_a = A_a^b e_b pulls all of them back: L' =
/// L and R' = R at y^b = A_a^b y'^a, Q'_a = A_a^b Q_b. Hamiltonians and control problems of files are left where they
/// are: their momenta and their sigma would need the inverse of A.
#include "expression/rewrite.hpp"
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

Tree in_model(const IncludedModel& included, const Tree& tree)
{
    std::map<std::string, Tree> replacements = included.velocities;
    replacements.insert(included.renamed.begin(), included.renamed.end());
    return replace_names(tree, replacements);
}

/// The files below `draft` that L can come from. A prolongation has no use for one: there it would be a function on the
/// base.
void append_files(std::vector<const IncludedModel*>& files, bool& complete, const ModelReader& reader,
                  const AlgebroidDraft& draft)
{
    if (draft.kind == nullptr) {
        files.push_back(&reader.included[draft.included]);
        return;
    }
    if (draft.kind->kind == AlgebroidKind::prolongation || draft.of.empty()) complete = false;
    for (const AlgebroidDraft& inner : draft.of) append_files(files, complete, reader, inner);
}

Tree sum_or_nothing(const std::vector<Tree>& terms)
{
    return terms.empty() ? nullptr : terms.size() == 1 ? terms[0] : add(terms);
}

/// Q_a of a block, null where it is zero.
std::vector<Tree> forces_of(const ModelReader& reader, const AlgebroidDraft& draft, const AlgebroidBlock& block)
{
    if (block.kind == AlgebroidKind::nonholonomic) return forces_of(reader, draft.of[0], block.of[0]);
    std::vector<Tree> forces(block.fibre.size());
    if (draft.kind == nullptr) {
        const IncludedModel& included = reader.included[draft.included];
        for (const ComponentEntry& force : included.model.forces)
            forces[force.section] = in_model(included, force.value);
    } else if (block.kind == AlgebroidKind::product) {
        auto next = forces.begin();
        for (std::size_t k = 0; k < block.of.size(); ++k)
            for (Tree& force : forces_of(reader, draft.of[k], block.of[k])) *next++ = std::move(force);
    } else if (block.kind == AlgebroidKind::frame) {
        const std::vector<Tree> inner = forces_of(reader, draft.of[0], block.of[0]);
        std::vector<std::vector<Tree>> terms(forces.size());
        for (const SectionEntry& entry : block.sections)
            if (inner[entry.inner]) terms[entry.section].push_back(product_of(entry.value, inner[entry.inner]));
        for (std::size_t a = 0; a < forces.size(); ++a) forces[a] = sum_or_nothing(terms[a]);
    }
    return forces;
}

/// Forces do not come without the inputs in them.
void refuse_lost_inputs(const IncludedModel& file)
{
    const std::vector<Symbol> inputs = input_symbols(file.model);
    for (const ComponentEntry& force : file.model.forces)
        for (const std::string& name : names_in(force.value))
            if (index_of(inputs, name) < inputs.size())
                throw ModelError(fmt::format("the forces of '{}' depend on its input '{}', and [inputs] do not come "
                                             "with the forces of a file",
                                             file.model.file->name, name),
                                 file.of->where, "give this model [inputs] and [forces] of its own");
}

/// Forces do not come without what they follow from.
void refuse_lost_states(const IncludedModel& file)
{
    const std::vector<std::string> states = names_of(state_symbols(file.model));
    for (const ComponentEntry& force : file.model.forces)
        for (const std::string& name : names_in(force.value))
            if (std::ranges::find(states, name) != states.end())
                throw ModelError(fmt::format("the forces of '{}' depend on its first-order state '{}', and [states] "
                                             "do not come with the forces of a file",
                                             file.model.file->name, name),
                                 file.of->where, "give this model [states] and [forces] of its own");
}

} // namespace

void inherit_mechanics(ModelReader& reader)
{
    const MechanicsBlocks& own = reader.mechanics;
    if (own.lagrangian != nullptr || own.hamiltonian != nullptr || own.control != nullptr) return;
    std::vector<const IncludedModel*> files;
    bool complete = true;
    append_files(files, complete, reader, *reader.draft);
    const auto has_none = [](const IncludedModel* file) { return file->model.lagrangian == nullptr; };
    if (!complete || files.empty() || std::ranges::any_of(files, has_none)) return;
    std::vector<Tree> lagrangians, dissipations;
    for (const IncludedModel* file : files) {
        lagrangians.push_back(in_model(*file, file->model.lagrangian));
        if (file->model.dissipation) dissipations.push_back(in_model(*file, file->model.dissipation));
    }
    const SourceRange where = files.front()->of->where;
    reader.lagrangian = sum_or_nothing(lagrangians);
    reader.model.lagrangian_where = where;
    if (own.dissipation == nullptr) reader.dissipation = sum_or_nothing(dissipations);
    if (own.forces != nullptr) return;
    for (const IncludedModel* file : files) {
        refuse_lost_states(*file);
        refuse_lost_inputs(*file);
    }
    const std::vector<Tree> forces = forces_of(reader, *reader.draft, reader.model.algebroid);
    for (std::size_t a = 0; a < forces.size(); ++a)
        if (forces[a]) reader.inherited_forces.push_back({a, forces[a], where});
}

} // namespace lagen
