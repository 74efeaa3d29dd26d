// SPDX-License-Identifier: GPL-2.0-or-later
/// Backward closure: the derivative of what is wanted, and of each rate and jump of what is kept, by what is left out
/// is 0, behind solves and cancellations.
#include "graph/calculus/differentiate.hpp"
#include "least/reduction.hpp"

#include <algorithm>
#include <map>

namespace lagen {

namespace {

/// Which lanes functions depend on, each pair decided once.
class Dependence {
  public:
    explicit Dependence(Reduction& reduction) : reduction_(reduction) {}

    /// The parameters whose values make `function` free of lane `j`; nothing where it depends on it.
    const std::optional<std::vector<NodeId>>& free_of(NodeId function, std::size_t j)
    {
        const auto [found, is_new] = known_.try_emplace({function, j});
        if (!is_new) return found->second;
        Graph& graph = reduction_.graph();
        const NodeId lane[] = {reduction_.system.lanes[j]};
        const NodeId root[] = {function};
        if (!depends_on_any(graph, root, lane)) return found->second.emplace(), found->second;
        found->second = reduction_.prover.unchanging({function}, {{lane[0], graph.constant(1)}});
        return found->second;
    }

  private:
    Reduction& reduction_;
    std::map<std::pair<NodeId, std::size_t>, std::optional<std::vector<NodeId>>> known_;
};

/// The functions that lane `i` goes by: its rate, and its values behind jumps.
std::vector<NodeId> functions_of(const LaneSystem& system, std::size_t i)
{
    std::vector<NodeId> functions{system.rates[i]};
    for (const std::vector<NodeId>& jump : system.jumps) functions.push_back(jump[i]);
    return functions;
}

struct Closure {
    std::vector<bool> kept;
    std::vector<NodeId> relations; ///< parameters on whose values it rests
};

Closure closure_of(Reduction& reduction, Dependence& dependence, bool with_relations)
{
    const LaneSystem& system = reduction.system;
    Closure closure{std::vector<bool>(system.lanes.size()), {}};
    std::vector<NodeId> open = reduction.wanted(), done;
    const auto depends = [&](NodeId function, std::size_t j) {
        const auto& needed = dependence.free_of(function, j);
        return !needed || (!with_relations && !needed->empty());
    };
    while (!open.empty()) {
        const NodeId function = open.back();
        open.pop_back();
        done.push_back(function);
        for (std::size_t j = 0; j < system.lanes.size(); ++j) {
            if (closure.kept[j] || !depends(function, j)) continue;
            closure.kept[j] = true;
            const std::vector<NodeId> more = functions_of(system, j);
            open.insert(open.end(), more.begin(), more.end());
        }
    }
    for (const NodeId function : done)
        for (std::size_t j = 0; j < system.lanes.size(); ++j)
            if (!closure.kept[j])
                for (const NodeId parameter : *dependence.free_of(function, j))
                    if (std::ranges::find(closure.relations, parameter) == closure.relations.end())
                        closure.relations.push_back(parameter);
    return closure;
}

/// What stands in the place of a lane that nothing depends on: 0 where nothing is known of it, else its start or a
/// sample.
std::optional<NodeId> stand_in(Reduction& reduction, std::size_t i)
{
    Graph& graph = reduction.graph();
    const NodeId lane[] = {reduction.system.lanes[i]};
    const ProofSetting& setting = reduction.prover.setting();
    const bool is_free = !depends_on_any(graph, setting.constraints, lane) &&
                         !depends_on_any(graph, setting.domain, lane) && !depends_on_any(graph, setting.defined, lane);
    if (is_free) return graph.constant(0);
    if (reduction.system.start[i]) return reduction.system.start[i];
    if (reduction.prover.points().empty()) return std::nullopt;
    return graph.constant(Rational(static_cast<double>(reduction.prover.points()[0].at(reduction.name_of(lane[0])))));
}

} // namespace

bool leave_out_unwatched(Reduction& reduction)
{
    Dependence dependence(reduction);
    Closure closure = closure_of(reduction, dependence, false);
    Closure fewer = closure_of(reduction, dependence, true);
    if (std::ranges::count(fewer.kept, true) < std::ranges::count(closure.kept, true)) closure = std::move(fewer);
    Reduction next = reduction;
    next.prover.bind(closure.relations);
    for (std::size_t i = 0; i < closure.kept.size(); ++i) {
        if (closure.kept[i]) continue;
        const NodeId lane = reduction.system.lanes[i];
        const std::optional<NodeId> value = stand_in(reduction, i);
        const auto& start = reduction.system.start[i];
        if (!value || (!next.replace({{lane, *value}}, false) && !(start && next.replace({{lane, *start}}, false))))
            return false; // the others may depend on it
        next.left_out.push_back(lane);
        next.steps.push_back({.rule = "watched", .lane = reduction.name_of(lane), .relations = closure.relations});
    }
    if (next.system.lanes.size() == reduction.system.lanes.size()) return false;
    reduction = std::move(next);
    return true;
}

} // namespace lagen
