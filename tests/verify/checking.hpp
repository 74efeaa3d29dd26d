// SPDX-License-Identifier: GPL-2.0-or-later
/// What the tests of `verify` share: a model text in, lines about its checks out.
#pragma once

#include "elaborate/make_frame.hpp"
#include "support/stages.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <set>

namespace lagen {

inline ModelReport verified_text(const std::string& text, const std::vector<NamedTree>& extra = {})
{
    return verify(read_model_text("test.toml", "name = \"test\"\n" + text, {}, choosers()), extra);
}

/// "anchor(w1, w2, g3) proved"
inline std::string line_of(const Check& check)
{
    std::string line = check.name + "(";
    for (std::size_t k = 0; k < check.indices.size(); ++k) line += (k == 0 ? "" : ", ") + check.indices[k];
    return line + ") " + to_text(check.decision.status);
}

inline std::vector<std::string> lines_of(const Report& verified)
{
    std::vector<std::string> lines;
    for (const Check& check : verified.structure.checks) lines.push_back(line_of(check));
    return lines;
}

/// The distinct hints of a model in order.
inline std::vector<std::string> hints_of(const Report& verified)
{
    std::vector<std::string> hints;
    std::set<std::string> seen = {""};
    for (const Check& check : verified.structure.checks)
        if (seen.insert(check.hint).second) hints.push_back(check.hint);
    return hints;
}

/// The largest certified bound of a residual of the structure equations, at `points` points other than those of a
/// decision, by enclosures alone.
inline double largest_structure_residual(const System& system, std::size_t points)
{
    Graph graph = system.graph;
    ProofBudget other;
    other.seed = 1;
    const ZeroDecider decider(graph, proof_setting(graph, system), other);
    BaseGradient partial(graph, system.algebroid.x);
    double largest = 0;
    for (const Residual& residual : structure_equations(partial, system.algebroid, system.functions).residuals)
        largest = std::max(largest, decider.largest_bound(residual.value, points));
    return largest;
}

} // namespace lagen
