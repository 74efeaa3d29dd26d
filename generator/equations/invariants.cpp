// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/invariants.hpp"

#include "equations/symbolic_model.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "verify/find_invariants.hpp"

#include <fmt/format.h>

namespace lagen {

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

} // namespace lagen
