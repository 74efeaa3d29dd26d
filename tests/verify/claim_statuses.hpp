// SPDX-License-Identifier: GPL-2.0-or-later
/// Verdicts on claims about a model, in a line.
#pragma once

#include "verify/checking.hpp"

#include "expression/parse.hpp"

namespace lagen {

inline Report verified_with(const std::string& text, const std::vector<std::string>& claims)
{
    const Model model = read_model_text("test.toml", text);
    std::vector<NamedTree> closed;
    for (const std::string& claim : claims)
        closed.push_back({claim, model.observer.close(parse_expression(whole_text("<claim>", claim))), {}});
    return verify(model, closed);
}

/// "proved where x != 0 and y > 0"
inline std::string status_of(const Check& check)
{
    std::string text = to_text(check.decision.status);
    for (std::size_t k = 0; k < check.where.size(); ++k) text += (k == 0 ? " where " : " and ") + check.where[k];
    return text;
}

/// The statuses of claims to be conserved, in their order, as "proved, refuted, proved where x != 0".
inline std::string statuses(const std::string& model, const std::vector<std::string>& claims)
{
    std::string line;
    for (const Check& check : verified_with(model, claims).structure.checks)
        if (check.name == "invariant") line += (line.empty() ? "" : ", ") + status_of(check);
    return line;
}

/// Why the first undecided check is that; empty where none is.
inline std::string first_obstacle(const std::string& model, const std::vector<std::string>& claims)
{
    for (const Check& check : verified_with(model, claims).structure.checks)
        if (check.decision.status == ProofStatus::undecided) return check.decision.evidence;
    return "";
}

} // namespace lagen
