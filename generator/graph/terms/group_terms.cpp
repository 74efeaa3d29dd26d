// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/terms/group_terms.hpp"

#include "graph/core/operators.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>
#include <tuple>

namespace lagen {

namespace {

/// With fewer lanes most of a register of 64 bytes is idle.
constexpr std::size_t fewest_lanes = 6;

/// So many operations on vectors pay for one operand that is put together lane by lane.
constexpr std::size_t operations_for_a_gather = 2;

constexpr int deepest = 100; ///< operations that are followed below a seed

constexpr std::array vector_operations{Op::add, Op::subtract, Op::multiply, Op::divide, Op::negate, Op::sqrt};

class Grouping {
  public:
    Grouping(const Graph& graph, const TermRequest& request) : graph_(graph), request_(request)
    {
        std::vector<NodeId> roots(request.outputs.begin(), request.outputs.end());
        for (const auto& [sum, sides] : request.sums) roots.insert(roots.end(), {sum, sides[0], sides[1]});
        nodes_ = reachable(graph, roots);
        find_shapes();
        users_.resize(graph.size());
        for (const NodeId id : nodes_)
            for (const NodeId operand : graph.operands(id))
                if (users_[operand].empty() || users_[operand].back() != id) users_[operand].push_back(id);
    }

    AlikeGroups find()
    {
        for (const std::vector<NodeId>& seed : seeds()) {
            const std::size_t first = groups_.size();
            if (!group_of(seed, 0)) continue;
            for (std::size_t k = first; k < groups_.size(); ++k) follow_users(k);
            if (!prune(first)) dissolve(first);
        }
        for (AlikeTerms& group : groups_) include_root(group);
        return sorted();
    }

  private:
    using Tuple = std::vector<NodeId>;

    // ---- what is alike ----

    /// Equal for equal operations over operands of equal shapes; of leaves, for a family, and for all numbers.
    void find_shapes()
    {
        std::map<NodeId, std::uint32_t> family;
        for (std::uint32_t k = 0; k < request_.families.size(); ++k)
            for (const NodeId id : request_.families[k]) family[id] = k + 1;
        std::map<std::tuple<Op, std::uint32_t, Tuple>, std::uint32_t> known;
        shapes_.assign(graph_.size(), 0);
        for (const NodeId id : nodes_) {
            const Op op = graph_.op(id);
            Tuple operands;
            for (const NodeId operand : graph_.operands(id)) operands.push_back(shapes_[operand]);
            if (operator_of(op).commutative) std::ranges::sort(operands);
            std::uint32_t payload = graph_.payload(id);
            if (op == Op::constant) payload = 0;
            if (op == Op::input) {
                const auto found = family.find(id);
                if (found == family.end()) operands.push_back(id); // alone
                payload = found == family.end() ? 0 : found->second;
            }
            shapes_[id] =
                known.try_emplace({op, payload, operands}, static_cast<std::uint32_t>(known.size() + 1)).first->second;
        }
    }

    [[nodiscard]] bool is_sum(NodeId id) const { return request_.sums.contains(id); }

    [[nodiscard]] bool is_vector_operation(NodeId id) const
    {
        const Op op = graph_.op(id);
        if (op == Op::power) return std::abs(static_cast<std::int32_t>(graph_.payload(id))) <= 4;
        return is_sum(id) || std::ranges::find(vector_operations, op) != vector_operations.end();
    }

    /// Roots and quotients that are alike, in order of their first nodes.
    [[nodiscard]] std::vector<Tuple> seeds() const
    {
        std::map<std::uint32_t, Tuple> by_shape;
        for (const NodeId id : nodes_)
            if (graph_.op(id) == Op::sqrt || graph_.op(id) == Op::divide) by_shape[shapes_[id]].push_back(id);
        std::vector<Tuple> seeds;
        for (auto& [shape, lanes] : by_shape)
            if (lanes.size() >= fewest_lanes) seeds.push_back(std::move(lanes));
        std::ranges::sort(seeds);
        return seeds;
    }

    // ---- downwards: what lanes are made of ----

    [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> place(NodeId id) const
    {
        const auto found = place_of_.find(id);
        return found == place_of_.end() ? std::nullopt : std::optional(found->second);
    }

    [[nodiscard]] bool is_alike(const Tuple& lanes) const
    {
        const std::set<NodeId> distinct(lanes.begin(), lanes.end());
        return distinct.size() == lanes.size() && std::ranges::all_of(lanes, [&](NodeId id) {
                   return shapes_[id] == shapes_[lanes[0]] && !place_of_.contains(id);
               });
    }

    /// The group of these lanes in this order: one that is there, or a new one.
    std::optional<std::size_t> group_of(const Tuple& lanes, int depth)
    {
        if (const auto first = place(lanes[0]); first && groups_[first->first].lanes == lanes) return first->first;
        if (depth > deepest || !is_vector_operation(lanes[0]) || !is_alike(lanes)) return std::nullopt;
        const std::size_t k = groups_.size();
        groups_.push_back({lanes, {}});
        for (std::size_t l = 0; l < lanes.size(); ++l) place_of_[lanes[l]] = {k, l};
        std::vector<TermOperand> operands;
        for (const Tuple& side : sides_of(lanes)) operands.push_back(operand_of(side, depth + 1));
        groups_[k].operands = std::move(operands);
        return k;
    }

    TermOperand operand_of(const Tuple& lanes, int depth)
    {
        if (std::ranges::all_of(lanes, [&](NodeId id) { return id == lanes[0]; })) return {{}, {lanes[0]}};
        if (const auto group = group_of(lanes, depth)) return {group, {}};
        return {{}, lanes};
    }

    /// Slot by slot, the operands of the lanes; those that commute, as the first lane has them.
    [[nodiscard]] std::vector<Tuple> sides_of(const Tuple& lanes) const
    {
        std::vector<Tuple> sides;
        for (std::size_t l = 0; l < lanes.size(); ++l) {
            std::vector<NodeId> operands(graph_.operands(lanes[l]).begin(), graph_.operands(lanes[l]).end());
            if (is_sum(lanes[l])) operands.assign(request_.sums.at(lanes[l]).begin(), request_.sums.at(lanes[l]).end());
            if (sides.empty()) sides.resize(operands.size());
            const bool commutes =
                operands.size() == 2 && (operator_of(graph_.op(lanes[l])).commutative || is_sum(lanes[l]));
            if (l > 0 && commutes &&
                fits(sides, operands[1], operands[0], l) > fits(sides, operands[0], operands[1], l))
                std::swap(operands[0], operands[1]);
            for (std::size_t k = 0; k < operands.size(); ++k) sides[k].push_back(operands[k]);
        }
        return sides;
    }

    /// How well two operands of the lane l fit to those of the first.
    [[nodiscard]] int fits(const std::vector<Tuple>& sides, NodeId a, NodeId b, std::size_t l) const
    {
        const auto fit = [&](NodeId first, NodeId other) {
            const auto there = place(first), here = place(other);
            const bool aligned = there && here && there->first == here->first && here->second == l;
            return (shapes_[first] == shapes_[other] ? 1 : 0) + (first == other || aligned ? 2 : 0);
        };
        return fit(sides[0][0], a) + fit(sides[1][0], b);
    }

    // ---- upwards: what is made of lanes ----

    /// The shape of a user, the slot of the lane where that matters, and the group in whose same lane the other operand
    /// stands.
    using Role = std::tuple<std::uint32_t, std::size_t, std::size_t>;

    [[nodiscard]] Role role_of(NodeId user, NodeId lane, std::size_t l) const
    {
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        const auto operands = graph_.operands(user);
        const std::size_t slot = operands[0] == lane ? 0 : 1;
        const auto other = operands.size() == 2 ? place(operands[1 - slot]) : std::nullopt;
        return {shapes_[user], operator_of(graph_.op(user)).commutative ? 0 : slot,
                other && other->second == l ? other->first : none};
    }

    /// Groups of users that every lane has as many of.
    void follow_users(std::size_t k)
    {
        const Tuple lanes = groups_[k].lanes;
        std::map<Role, std::vector<Tuple>> users; // by lane
        for (std::size_t l = 0; l < lanes.size(); ++l)
            for (const NodeId user : users_[lanes[l]]) {
                if (place_of_.contains(user) || !is_vector_operation(user)) continue;
                std::vector<Tuple>& by_lane = users[role_of(user, lanes[l], l)];
                by_lane.resize(lanes.size());
                by_lane[l].push_back(user);
            }
        for (const auto& [role, by_lane] : users) {
            const std::size_t count = by_lane[0].size();
            if (!std::ranges::all_of(by_lane, [&](const Tuple& each) { return each.size() == count; })) continue;
            for (std::size_t number = 0; number < count; ++number) {
                Tuple tuple;
                for (const Tuple& each : by_lane) tuple.push_back(each[number]);
                static_cast<void>(group_of(tuple, 0));
            }
        }
    }

    // ---- what pays ----

    [[nodiscard]] static bool is_gathered(const TermOperand& operand)
    {
        return !operand.group && operand.nodes.size() > 1;
    }

    /// Takes out groups that are put together lane by lane and taken apart again: of a cheap operation, with an operand
    /// that is no group, and no group among their users. Answers whether those from `first` on pay then.
    bool prune(std::size_t first)
    {
        for (bool changed = true; changed;) {
            changed = false;
            std::set<std::size_t> read;
            for (const AlikeTerms& group : groups_)
                for (const TermOperand& operand : group.operands)
                    if (operand.group) read.insert(*operand.group);
            for (std::size_t k = groups_.size(); k-- > first && !changed;) {
                const NodeId lane = groups_[k].lanes[0];
                const bool slow = graph_.op(lane) == Op::sqrt || graph_.op(lane) == Op::divide;
                if (read.contains(k) || (slow && !is_sum(lane))) continue;
                const bool gathers = std::ranges::any_of(groups_[k].operands, is_gathered);
                const bool idle = std::ranges::none_of(groups_[k].operands,
                                                       [](const TermOperand& each) { return each.group.has_value(); });
                if (gathers || idle) erase(k), changed = true;
            }
        }
        std::set<Tuple> gathered;
        std::size_t operations = 0;
        for (std::size_t k = first; k < groups_.size(); ++k) {
            ++operations;
            for (const TermOperand& operand : groups_[k].operands)
                if (is_gathered(operand)) gathered.insert(operand.nodes);
        }
        return operations > 0 && operations >= operations_for_a_gather * gathered.size();
    }

    /// No group reads it.
    void erase(std::size_t k)
    {
        for (const NodeId id : groups_[k].lanes) place_of_.erase(id);
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(k));
        for (auto& [id, place] : place_of_)
            if (place.first > k) --place.first;
        for (AlikeTerms& group : groups_)
            for (TermOperand& operand : group.operands)
                if (operand.group && *operand.group > k) --*operand.group;
    }

    void dissolve(std::size_t first)
    {
        groups_.resize(first);
        std::erase_if(place_of_, [&](const auto& entry) { return entry.second.first >= first; });
    }

    // ---- x^(-3/2) ----

    [[nodiscard]] AlikeTerms* operand_group(const AlikeTerms& group, std::size_t k)
    {
        return group.operands[k].group ? &groups_[*group.operands[k].group] : nullptr;
    }

    [[nodiscard]] bool is_read_once(const AlikeTerms& group) const
    {
        return std::ranges::all_of(group.lanes, [&](NodeId id) {
            return users_[id].size() == 1 && std::ranges::find(request_.outputs, id) == request_.outputs.end();
        });
    }

    /// 1/(x sqrt(x)) is quicker, and rounded less often, as one operation.
    void include_root(AlikeTerms& quotient)
    {
        if (graph_.op(quotient.lanes[0]) != Op::divide || quotient.operands[0].nodes.size() != 1 ||
            !graph_.is_one(quotient.operands[0].nodes[0]))
            return;
        AlikeTerms* product = operand_group(quotient, 1);
        if (product == nullptr || graph_.op(product->lanes[0]) != Op::multiply || !is_read_once(*product)) return;
        for (const std::size_t k : {0U, 1U}) {
            AlikeTerms* root = operand_group(*product, k);
            if (root == nullptr || graph_.op(root->lanes[0]) != Op::sqrt || !is_read_once(*root) ||
                root->operands != std::vector{product->operands[1 - k]})
                continue;
            quotient.operands = root->operands;
            quotient.is_inverse_cube = root->is_included = product->is_included = true;
            return;
        }
    }

    /// By the first lane: nodes are numbered after their operands.
    AlikeGroups sorted()
    {
        std::vector<std::size_t> order(groups_.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        std::ranges::sort(order, {}, [&](std::size_t k) { return groups_[k].lanes[0]; });
        std::vector<std::size_t> rank(order.size());
        for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = k;
        AlikeGroups result;
        for (const std::size_t k : order) {
            for (TermOperand& operand : groups_[k].operands)
                if (operand.group) operand.group = rank[*operand.group];
            result.groups.push_back(std::move(groups_[k]));
        }
        for (const auto& [id, place] : place_of_) result.place_of[id] = {rank[place.first], place.second};
        return result;
    }

    const Graph& graph_;
    const TermRequest& request_;
    std::vector<NodeId> nodes_; ///< ascending
    std::vector<std::uint32_t> shapes_;
    std::vector<std::vector<NodeId>> users_; ///< by node
    std::vector<AlikeTerms> groups_;
    std::map<NodeId, std::pair<std::size_t, std::size_t>> place_of_;
};

} // namespace

AlikeGroups group_terms(const Graph& graph, const TermRequest& request)
{
    return Grouping(graph, request).find();
}

} // namespace lagen
