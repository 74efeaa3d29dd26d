// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/choose_kept.hpp"

#include "elaborate/build_workspace.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/calculus/places.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t most_kept_choices = 5000;
constexpr std::size_t listed_minors = 3;

/// "v_x, v_th"
std::string listed_names(const std::vector<Symbol>& symbols, const std::vector<std::size_t>& places)
{
    std::string text;
    for (const std::size_t place : places) text += (text.empty() ? "" : ", ") + symbols[place].name;
    return text;
}

} // namespace

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
    Graph& graph = work.graph();
    std::vector<NodeId> Y, B;
    for (const Symbol& symbol : ambient) Y.push_back(graph.input(symbol.name));
    for (const Tree& constraint : constraints)
        for (const NodeId slope : gradient(graph, work.lower(constraint), Y)) B.push_back(slope);
    Places kept = first_places(r - m);
    std::string minors;
    std::size_t tried = 0, listed = 0;
    do {
        std::vector<std::size_t> solved;
        for (std::size_t a = 0; a < r; ++a)
            if (std::ranges::find(kept, a) == kept.end()) solved.push_back(a);
        const NodeId minor = determinant_of(graph, B, r, first_places(m), solved);
        if (graph.is_zero(minor)) continue;
        if (ZeroDecider(graph, work.setting()).proves_nonzero(minor)) return kept;
        const Tree text = work.readable(minor);
        if (text != nullptr && ++listed <= listed_minors)
            minors += fmt::format("{}{} (keeping {})", minors.empty() ? "" : ", ", to_text(text),
                                  listed_names(ambient, kept));
    } while (++tried < most_kept_choices && next_places(kept, r));
    if (listed == 0) return first_places(r - m);
    throw MathematicsError(
        fmt::format("the constraints of model '{}' are not proved to leave {} of its ambient fibre coordinates free at "
                    "every point of the domain: the minors are {}{}",
                    model.name, r - m, minors, listed > listed_minors ? ", .." : ""),
        "[fibre] coordinates = [..] keeps coordinates where their minor is not 0; [algebroid.sections] need none");
}

} // namespace lagen
