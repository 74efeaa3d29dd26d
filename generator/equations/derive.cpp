// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/derive.hpp"

#include "analysis/find_invariants.hpp"
#include "equations/derivations.hpp"
#include "equations/symbolic_model.hpp"
#include "equations/written/indexed_equations.hpp"
#include "equations/written/vector_equations.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "model/model.hpp"
#include "model/scene_form.hpp"
#include "typeset/equation_set.hpp"
#include "verify/verify.hpp"

#include <fmt/format.h>

namespace lagen {

std::vector<std::string> derivation_names()
{
    std::vector<std::string> names = form_names();
    for (const char* more : {"exterior", "cartan", "poisson", "invariants", "variations", "reaction", "projected"})
        names.emplace_back(more);
    return names;
}

namespace {

// Invariants of Hamilton's equations that are found without help: `derive --form invariants`.

/// Each function of the ansatz of analysis/find_invariants.hpp with rate zero, with the statement that it is.
/// Throws MathematicsError where the model has no H in closed form, or one with explicit time.
EquationSet derive_invariants(const Model& model, const System& system, const Regularity& regularity)
{
    Graph graph = system.graph;
    std::optional<HamiltonianNodes> H;
    const bool somewhere = regularity.kind == Regularity::Kind::generically_regular;
    if (system.hamiltonian || (system.lagrangian && (somewhere || regularity.kind == Regularity::Kind::regular)))
        H = closed_hamiltonian(graph, system, regularity.newton_start);
    if (!H)
        throw MathematicsError(
            fmt::format(
                "invariants are sought among functions of points and momenta, and model '{}' has no Hamiltonian "
                "in closed form",
                model.name),
            "check --invariant decides a function that is given");
    const NodeId only[] = {H->value};
    if (!system.forces.empty())
        throw MathematicsError(
            fmt::format("invariants are sought of motions without forces, and model '{}' has them", model.name),
            "check --invariant decides a function that is given");
    const bool autonomous = !depends_on_any(graph, only, std::vector<NodeId>{system.time});
    SymbolicModel symbolic(model, system.written.algebroid, {});
    EquationSet set = symbolic.empty_set("invariants");
    EquationBlock block{autonomous ? "invariants beside H" : "invariants without t",
                        "Ḟ = 0 along Hamilton's equations, F of degree 2 at most in the momenta",
                        R"(\dot F = 0)",
                        {}};
    std::size_t count = 0;
    for (const FoundInvariant& found : find_invariants(graph, system, *H)) {
        const std::string name = fmt::format("F{}", ++count);
        block.equations.push_back(
            symbolic.equation(LeftSide::symbol, name, {symbolic.lower(to_tree(graph, found.value))}));
        DecidedStatement statement;
        statement.formula = fmt::format("d{}/dt = 0{}{}", name,
                                        found.for_given_parameters ? ", for the parameter values of the file" : "",
                                        somewhere && !system.hamiltonian ? ", where L is regular" : "");
        statement.latex_formula = fmt::format(R"(\dot F_{{{}}} = 0)", count);
        statement.status = "proved";
        set.statements.push_back(std::move(statement));
    }
    if (count == 0)
        set.title += fmt::format("{}{}", set.title.empty() ? "" : ": ",
                                 autonomous ? "beside H none is found" : "none without t is found");
    set.blocks = {std::move(block)};
    return set;
}

constexpr std::size_t most_written = 15'000; ///< nodes of equations that sums and vectors are sought in

EquationSet derive_constrained(const std::string& form, const Model& model, const System& system,
                               const std::vector<Tree>& brackets, Definitions definitions)
{
    if (form == entry_of(FormKind::lagrange).name) return derive_nonholonomic(model, system, definitions);
    for (const char* known : {"hamilton", "poisson", "reaction", "projected"})
        if (form == known) return derive_nonholonomic_form(form, model, system, brackets, definitions);
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
    case FormKind::lagrange:
        if (definitions == Definitions::kept)
            if (auto long_ones = derive_long_lagrange(model, system, report.mechanics.regularity))
                return std::move(*long_ones);
        return derive_lagrange(model, algebroid, report.mechanics.regularity, definitions);
    case FormKind::hamilton: return derive_hamilton(model, algebroid, report.mechanics.regularity, definitions);
    case FormKind::pontryagin: return derive_pontryagin(model, algebroid, report.control.maximum, definitions);
    case FormKind::discrete: return derive_discrete(model, system);
    case FormKind::first_order: return derive_first_order(model, algebroid, definitions);
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
