// SPDX-License-Identifier: GPL-2.0-or-later
#include "mechanics/symplectic.hpp"

#include "geometry/prolongation.hpp"
#include "graph/calculus/differentiate.hpp"

namespace lagen {

namespace {

/// p_a X^a
ExteriorForm horizontal_form(const Graph& graph, const std::vector<NodeId>& p)
{
    ExteriorForm form{1, {}};
    for (std::size_t a = 0; a < p.size(); ++a)
        if (!graph.is_zero(p[a])) form.components.emplace(FormIndex{a}, p[a]);
    return form;
}

void put(const Graph& graph, ExteriorForm& form, std::size_t a, std::size_t b, NodeId value)
{
    if (!graph.is_zero(value)) form.components.emplace(FormIndex{a, b}, value);
}

/// dF/dmu_a and rho_a(F), shape (r) each.
struct Slopes {
    std::vector<NodeId> along_mu, along_anchor;
};

Slopes slopes_of(Graph& graph, const System& system, NodeId F)
{
    Slopes slopes;
    slopes.along_mu = gradient(graph, F, system.mu);
    BaseGradient partial(graph, system.algebroid.x);
    for (const VectorField& rho : system.algebroid.anchor) slopes.along_anchor.push_back(partial.along(rho, F));
    return slopes;
}

} // namespace

SymplecticForms lagrangian_forms(Graph& graph, const System& system, const LagrangianNodes& lagrangian)
{
    const Algebroid& algebroid = system.algebroid;
    const std::vector<NodeId>& p = lagrangian.fibre.momenta;
    const std::size_t r = algebroid.r();
    SymplecticForms forms{prolongation(graph, algebroid, algebroid.y), horizontal_form(graph, p), {2, {}}};
    BaseGradient partial(graph, algebroid.x);
    for (std::size_t a = 0; a < r; ++a) {
        for (std::size_t b = 0; b < r; ++b) put(graph, forms.omega, a, r + b, lagrangian.fibre.W(a, b));
        for (std::size_t b = a + 1; b < r; ++b)
            put(graph, forms.omega, a, b,
                graph.add(
                    graph.subtract(partial.along(algebroid.anchor[b], p[a]), partial.along(algebroid.anchor[a], p[b])),
                    pairing(graph, p, algebroid.C(a, b))));
    }
    return forms;
}

SymplecticForms canonical_forms(Graph& graph, const System& system)
{
    const std::size_t r = system.r();
    SymplecticForms forms{prolongation(graph, system.algebroid, system.mu), horizontal_form(graph, system.mu), {2, {}}};
    for (std::size_t a = 0; a < r; ++a) {
        put(graph, forms.omega, a, r + a, graph.constant(1));
        for (std::size_t b = a + 1; b < r; ++b)
            put(graph, forms.omega, a, b, pairing(graph, system.mu, system.algebroid.C(a, b)));
    }
    return forms;
}

NodeId poisson_bracket(Graph& graph, const System& system, NodeId F, NodeId G)
{
    const Slopes f = slopes_of(graph, system, F), g = slopes_of(graph, system, G);
    std::vector<NodeId> terms{contraction(graph, f.along_mu, g.along_anchor),
                              graph.negate(contraction(graph, g.along_mu, f.along_anchor))};
    for (std::size_t a = 0; a < system.r(); ++a)
        for (std::size_t b = 0; b < system.r(); ++b)
            terms.push_back(graph.multiply(pairing(graph, system.mu, system.algebroid.C(a, b)),
                                           graph.multiply(f.along_mu[a], g.along_mu[b])));
    return graph.sum(terms);
}

Section hamiltonian_section(Graph& graph, const System& system, NodeId F)
{
    const Slopes slopes = slopes_of(graph, system, F);
    Section section;
    for (std::size_t a = 0; a < system.r(); ++a)
        if (!graph.is_zero(slopes.along_mu[a])) section.push_back({a, slopes.along_mu[a]});
    for (std::size_t a = 0; a < system.r(); ++a) {
        std::vector<NodeId> terms{slopes.along_anchor[a]};
        for (std::size_t b = 0; b < system.r(); ++b)
            terms.push_back(graph.multiply(pairing(graph, system.mu, system.algebroid.C(a, b)), slopes.along_mu[b]));
        const NodeId value = graph.negate(graph.sum(terms));
        if (!graph.is_zero(value)) section.push_back({system.r() + a, value});
    }
    return section;
}

} // namespace lagen
