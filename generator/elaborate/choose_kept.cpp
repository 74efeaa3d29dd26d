// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/choose_kept.hpp"

#include "graph/calculus/differentiate.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t most_kept_choices = 5000;
constexpr std::size_t listed_minors = 3;

/// The factors of a minor that the domain does not keep from zero, without signs and exponents.
void append_open(BuildWorkspace& work, const Tree& minor, std::vector<Tree>& open)
{
    switch (minor->kind) {
    case TreeKind::number: return;
    case TreeKind::multiply:
        for (const Tree& factor : minor->arguments) append_open(work, factor, open);
        return;
    case TreeKind::negate:
    case TreeKind::divide:
    case TreeKind::power: return append_open(work, minor->arguments[0], open);
    default: break;
    }
    if (!ZeroDecider(work.graph(), work.setting()).proves_nonzero(work.lower(minor))) open.push_back(minor);
}

/// "v_x, v_th"
std::string listed_names(const std::vector<Symbol>& symbols, const Places& places)
{
    return comma_list(places, [&](std::size_t place) { return symbols[place].name; });
}

} // namespace

Places ConstraintRows::solved(const Places& kept) const
{
    Places out;
    for (std::size_t a = 0; a < r; ++a)
        if (std::ranges::find(kept, a) == kept.end()) out.push_back(a);
    return out;
}

NodeId ConstraintRows::minor(Graph& graph, const Places& kept) const
{
    return determinant_of(graph, B, r, first_places(m), solved(kept));
}

KeptChoice choose_free(BuildWorkspace& work, const ConstraintRows& rows, const std::vector<Symbol>& coordinates,
                       const Places& wanted)
{
    Graph& graph = work.graph();
    KeptChoice choice;
    Places kept = wanted.empty() ? first_places(rows.r - rows.m) : wanted;
    std::size_t tried = 0, listed = 0;
    do {
        const NodeId minor = rows.minor(graph, kept);
        if (graph.is_zero(minor)) continue;
        if (ZeroDecider(graph, work.setting()).proves_nonzero(minor)) {
            choice.kept = kept;
            return choice;
        }
        const Tree text = work.readable(minor);
        if (text == nullptr) continue;
        std::vector<Tree> open;
        append_open(work, text, open);
        if (open.empty()) open = {text}; // the product is not shown, though its factors are
        if (choice.open.empty() || open.size() < choice.open.size()) choice.open = std::move(open);
        if (++listed <= listed_minors)
            choice.minors += fmt::format("{}{} (keeping {})", listed == 1 ? "" : ", ", to_text(text),
                                         listed_names(coordinates, kept));
    } while (wanted.empty() && ++tried < most_kept_choices && next_places(kept, rows.r));
    if (listed > listed_minors) choice.minors += ", ..";
    return choice;
}

std::vector<std::size_t> choose_kept(const Model& model)
{
    const std::vector<Symbol>& ambient = ambient_fibre(model);
    const std::vector<Tree>& constraints = model.algebroid.constraints;
    const std::size_t r = ambient.size(), m = constraints.size();
    if (m >= r || m > determinant_limit)
        throw ModelError(fmt::format("the constraints are {} on {} ambient fibre coordinates", m, r),
                         model.algebroid.where,
                         fmt::format("at most {}, and fewer than the coordinates, are solved for", determinant_limit));
    BuildWorkspace work(model);
    std::vector<NodeId> Y;
    for (const Symbol& symbol : ambient) Y.push_back(work.graph().input(symbol.name));
    ConstraintRows rows{{}, m, r};
    for (const Tree& constraint : constraints)
        for (const NodeId slope : gradient(work.graph(), work.lower(constraint), Y)) rows.B.push_back(slope);
    const KeptChoice choice = choose_free(work, rows, ambient);
    if (choice.kept) return *choice.kept;
    if (choice.minors.empty()) return first_places(r - m);
    throw MathematicsError(
        fmt::format("the constraints of model '{}' are not proved to leave {} of its ambient fibre coordinates free at "
                    "every point of the domain: the minors are {}",
                    model.name, r - m, choice.minors),
        "[fibre] coordinates = [..] keeps coordinates where their minor is not 0; [algebroid.sections] need none");
}

} // namespace lagen
