// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/rough_term.hpp"

#include "proof/sloped_functions.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::proof {

namespace {

constexpr slong term_bits = 256;
/// Boxes of 2^-40, 2^-60 and 2^-80, in each of which slopes that vanish as |x|^(1/5) are a sixteenth of those before:
/// what jumps stays as large. Around a point that is known exactly one box as small as one likes has no jump in it that
/// is more than rounding.
constexpr slong boxes[] = {40, 60, 80}, least_box = 1 << 20;
constexpr double much_smaller = 0x1p-4, negligible_radius = 0x1p-150, rounding = 0x1p-180;

using Nodes = std::vector<NodeId>;

std::vector<Ball> in_box(const SlopedFunctions& functions, const std::vector<Ball>& at, slong exponent)
{
    std::vector<Ball> box = at;
    for (Ball& each : box) arb_add_error_2exp_si(each.get(), -exponent);
    NewtonEquations found = functions.at(box, term_bits);
    std::ranges::move(found.value.entries, std::back_inserter(found.slope.entries));
    return found.slope.entries;
}

/// Whether it has no more of a radius than rounding gives it, or a part of the one before.
bool is_narrow(const Ball& ball, double before)
{
    const double size = std::fabs(arf_get_d(arb_midref(ball.get()), ARF_RND_NEAR)), radius = radius_of(ball);
    return std::isfinite(size) && std::isfinite(radius) && std::isfinite(before) &&
           radius <= much_smaller * before + negligible_radius + rounding * size;
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
        const auto narrow = [](const Ball& ball) { return is_narrow(ball, 0); };
        if (exactly) return std::ranges::all_of(in_box(sloped, at, least_box), narrow);
        std::vector<double> before;
        for (const slong exponent : boxes) {
            const std::vector<Ball> found = in_box(sloped, at, exponent);
            for (std::size_t k = 0; k < before.size(); ++k)
                if (!is_narrow(found[k], before[k])) return false;
            before.clear();
            for (const Ball& ball : found) before.push_back(radius_of(ball));
        }
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
