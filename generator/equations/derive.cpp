// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/derive.hpp"

#include "equations/cartan.hpp"
#include "equations/control_variations.hpp"
#include "equations/discrete.hpp"
#include "equations/exterior.hpp"
#include "equations/hamilton.hpp"
#include "equations/invariants.hpp"
#include "equations/lagrange.hpp"
#include "equations/lagrangian_cartan.hpp"
#include "equations/nonholonomic.hpp"
#include "equations/poisson.hpp"
#include "equations/pontryagin.hpp"
#include "equations/variations.hpp"
#include "equations/written/indexed_equations.hpp"
#include "equations/written/vector_equations.hpp"
#include "model/form.hpp"
#include "model/scene_form.hpp"

namespace lagen {

std::vector<std::string> derivation_names()
{
    std::vector<std::string> names = form_names();
    for (const char* more : {"exterior", "cartan", "poisson", "invariants", "variations", "reaction", "projected"})
        names.emplace_back(more);
    return names;
}

namespace {

constexpr std::size_t most_written = 50'000; ///< nodes of equations that sums and vectors are sought in

EquationSet derive_constrained(const std::string& form, const Model& model, const System& system,
                               const std::vector<Tree>& brackets, Definitions definitions)
{
    if (form == "reaction") return derive_reaction(model, system);
    if (form == "projected") return derive_projected(model, system);
    if (form == entry_of(FormKind::lagrange).name) return derive_nonholonomic(model, system, definitions);
    if (form == entry_of(FormKind::hamilton).name) return derive_constrained_hamilton(model, system);
    if (form == "poisson") return derive_almost_poisson(model, system, brackets);
    throw MathematicsError("the form '" + form + "' of a nonholonomic model is not derived yet",
                           "lagrange, hamilton, poisson, reaction and projected are");
}

} // namespace

EquationSet derive(const std::string& form, const Model& model, const System& system, const Report& report,
                   const std::vector<Tree>& brackets, Definitions definitions)
{
    const WrittenAlgebroid& algebroid = system.written.algebroid;
    if (system.distribution) return derive_constrained(form, model, system, brackets, definitions);
    if (form == "reaction" || form == "projected")
        throw MathematicsError("the form '" + form + "' is of nonholonomic models, and '" + model.name + "' is none",
                               "[algebroid] kind = \"nonholonomic\"");
    if (form == "exterior") return derive_exterior(model, system);
    if (form == "poisson") return derive_poisson(model, system, report.mechanics.regularity, brackets, definitions);
    if (form == "invariants") return derive_invariants(model, system, report.mechanics.regularity);
    if (form == "variations")
        return system.control && !system.lagrangian ? derive_control_variations(model, system)
                                                    : derive_variations(model, system);
    if (form == "cartan") {
        const bool discrete = system.discrete && (system.discrete->written || !system.lagrangian);
        return discrete ? derive_cartan(model, system)
                        : derive_lagrangian_cartan(model, system, report.mechanics.regularity);
    }
    switch (form_named(form).kind) {
    case FormKind::lagrange: return derive_lagrange(model, algebroid, report.mechanics.regularity, definitions);
    case FormKind::hamilton: return derive_hamilton(model, algebroid, report.mechanics.regularity, definitions);
    case FormKind::pontryagin: return derive_pontryagin(model, algebroid, report.control.maximum, definitions);
    case FormKind::discrete: return derive_discrete(model, system);
    }
    throw InternalError("a form without equations");
}

EquationSet with_written_blocks(EquationSet equations, const Model& model)
{
    std::size_t nodes = 0;
    for (const EquationBlock& block : equations.blocks)
        for_each_tree(block, [&](const Tree& tree) { nodes += written_nodes(tree); });
    if (nodes > most_written) return equations; // minutes for what nobody reads
    write_vectors(equations, model);
    write_by_index(equations, model);
    return equations;
}

} // namespace lagen
