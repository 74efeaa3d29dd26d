// SPDX-License-Identifier: GPL-2.0-or-later
/// Random sections and forms with polynomial coefficients, and the decision that a form vanishes.
#pragma once

#include "elaborate/elaborate.hpp"
#include "geometry/form.hpp"
#include "support/dice.hpp"
#include "verify/proof_setting.hpp"

namespace lagen {

/// A quadratic polynomial of the base coordinates with small integer coefficients; a number where M is a point.
inline NodeId random_function(Graph& graph, const System& system, testing::Dice& dice)
{
    const auto coefficient = [&] { return graph.constant(static_cast<long>(dice.below(7)) - 3); };
    NodeId f = coefficient();
    for (const NodeId x : system.algebroid.x) {
        const NodeId other = system.algebroid.x[dice.below(system.n())];
        f = graph.add(f, graph.multiply(graph.add(coefficient(), graph.multiply(coefficient(), other)), x));
    }
    return f;
}

inline Section random_section(Graph& graph, const System& system, testing::Dice& dice)
{
    Section s;
    for (std::size_t a = 0; a < system.r(); ++a) s.push_back({a, random_function(graph, system, dice)});
    return s;
}

inline ExteriorForm random_form(Graph& graph, const System& system, std::size_t degree, testing::Dice& dice)
{
    ExteriorForm w{degree, {}};
    for (std::size_t set = 0; set < (std::size_t{1} << system.r()); ++set) {
        FormIndex index;
        for (std::size_t a = 0; a < system.r(); ++a)
            if (set >> a & 1U) index.push_back(a);
        if (index.size() == degree) w.components[index] = random_function(graph, system, dice);
    }
    return w;
}

/// Whether every component is proved to be zero.
inline bool vanishes(Graph& graph, const System& system, const ExteriorForm& w)
{
    const ZeroDecider decider(graph, proof_setting(graph, system));
    for (const auto& [index, value] : w.components)
        if (!graph.is_zero(value) && decider.decide(value).status != ProofStatus::proved) return false;
    return true;
}

} // namespace lagen
