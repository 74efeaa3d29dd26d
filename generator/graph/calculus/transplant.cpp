// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/calculus/transplant.hpp"

namespace lagen {

namespace {

class Transplant {
  public:
    Transplant(Graph& to, const Graph& from, const std::map<NodeId, NodeId>& inputs)
        : to_(to), from_(from), inputs_(inputs)
    {
    }

    void move(NodeId id)
    {
        switch (from_.op(id)) {
        case Op::constant: moved_[id] = to_.constant(from_.value(id)); return;
        case Op::pi: moved_[id] = to_.pi(); return;
        case Op::input: moved_[id] = input(id); return;
        case Op::factor: return;
        case Op::solve: solutions_[id] = solve(id); return;
        case Op::component: moved_[id] = solutions_.at(from_.operands(id)[0])[from_.payload(id)]; return;
        default: moved_[id] = to_.make(from_.op(id), from_.payload(id), all(from_.operands(id))); return;
        }
    }
    [[nodiscard]] NodeId operator[](NodeId id) const { return moved_.at(id); }

  private:
    [[nodiscard]] NodeId input(NodeId id) const
    {
        const auto found = inputs_.find(id);
        return found != inputs_.end() ? found->second : to_.input(from_.input_name(id));
    }
    [[nodiscard]] std::vector<NodeId> all(std::span<const NodeId> ids) const
    {
        std::vector<NodeId> out;
        for (const NodeId id : ids) out.push_back(moved_.at(id));
        return out;
    }
    [[nodiscard]] std::vector<NodeId> solve(NodeId id) const
    {
        const auto operands = from_.operands(id);
        const NodeId factor = operands[0];
        return to_.solve(all(from_.operands(factor)), all(operands.subspan(1)),
                         static_cast<MatrixStructure>(from_.payload(factor)));
    }

    Graph& to_;
    const Graph& from_;
    const std::map<NodeId, NodeId>& inputs_;
    std::map<NodeId, NodeId> moved_;
    std::map<NodeId, std::vector<NodeId>> solutions_;
};

} // namespace

std::vector<NodeId> transplant(Graph& to, const Graph& from, std::span<const NodeId> outputs,
                               const std::map<NodeId, NodeId>& inputs)
{
    Transplant map(to, from, inputs);
    for (const NodeId id : reachable(from, outputs)) map.move(id);
    std::vector<NodeId> result;
    for (const NodeId output : outputs) result.push_back(map[output]);
    return result;
}

} // namespace lagen
