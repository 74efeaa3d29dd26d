// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/rough_term.hpp"

#include "proof/sloped_functions.hpp"

#include <algorithm>

namespace lagen::proof {

namespace {

constexpr slong term_bits = 256;
/// Boxes of 2^-40 and 2^-80: slopes that vanish as |x|^(1/5) are seen to. Around a point that is known exactly the
/// second one may be as small as one likes.
constexpr slong wide_box = 40, narrow_box = 80, least_box = 1 << 20;
constexpr double much_smaller = 0x1p-8, negligible_radius = 0x1p-150;

using Nodes = std::vector<NodeId>;

std::vector<Ball> in_box(const SlopedFunctions& functions, const std::vector<Ball>& at, slong exponent)
{
    std::vector<Ball> box = at;
    for (Ball& each : box) arb_add_error_2exp_si(each.get(), -exponent);
    NewtonEquations found = functions.at(box, term_bits);
    std::ranges::move(found.value.entries, std::back_inserter(found.slope.entries));
    return found.slope.entries;
}

/// What a sum, a multiple or a component of a solution is made of; nothing of anything else.
Nodes terms_of(const Graph& graph, NodeId f)
{
    const auto all = [&](NodeId id) { return Nodes(graph.operands(id).begin(), graph.operands(id).end()); };
    Nodes of = all(f);
    switch (graph.op(f)) {
    case Op::add:
    case Op::subtract:
    case Op::negate: return of;
    case Op::multiply: return graph.is_constant(of[0]) ? of : Nodes();
    case Op::divide: return graph.is_constant(of[1]) ? of : Nodes();
    case Op::component: {
        Nodes system = all(of[0]);
        const Nodes matrix = all(system[0]);
        system.erase(system.begin());
        system.insert(system.end(), matrix.begin(), matrix.end());
        return system;
    }
    default: return {};
    }
}

} // namespace

std::optional<NodeId> rough_term(Graph& graph, const Nodes& functions, const Nodes& z, const std::vector<Ball>& at,
                                 bool exactly)
{
    const auto smooth = [&](const Nodes& some) {
        const SlopedFunctions sloped(graph, some, z);
        const std::vector<Ball> first = in_box(sloped, at, wide_box);
        const std::vector<Ball> then = in_box(sloped, at, exactly ? least_box : narrow_box);
        for (std::size_t k = 0; k < first.size(); ++k)
            if (!first[k].is_finite() || radius_of(then[k]) > much_smaller * radius_of(first[k]) + negligible_radius)
                return false;
        return true;
    };
    if (smooth(functions)) return std::nullopt;
    Nodes terms = functions;
    std::optional<NodeId> term;
    while (true) {
        const auto found = std::ranges::find_if(terms, [&](NodeId each) { return !smooth({each}); });
        if (found == terms.end()) return term;
        term = *found;
        terms = terms_of(graph, *term);
    }
}

} // namespace lagen::proof
