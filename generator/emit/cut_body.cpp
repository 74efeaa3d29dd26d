// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/cut_body.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <set>

namespace lagen {

namespace {

/// A body of so many times the longest part is left whole: only beyond it do compilers take notably longer, and parts
/// cost a little, since what they hand on goes through memory.
constexpr std::size_t largest_whole = 5;

class Cutter {
  public:
    Cutter(const Graph& graph, const std::vector<BodyStep>& steps)
        : graph_(graph), steps_(steps), born_(graph.size(), 0), last_(graph.size(), 0)
    {
        for (std::size_t k = 0; k < steps.size(); ++k) {
            for (const NodeId id : steps[k].defines) born_[id] = k;
            for (const NodeId id : steps[k].needs) last_[id] = k;
        }
    }

    CutBody cut(std::size_t longest)
    {
        CutBody result;
        std::size_t begin = 0;
        for (const std::size_t end : places(longest)) {
            result.parts.push_back(part(begin, end));
            begin = end;
        }
        result.workspace = workspace_;
        return result;
    }

  private:
    /// Where parts end; the last of them is the number of steps.
    [[nodiscard]] std::vector<std::size_t> places(std::size_t longest) const
    {
        const std::size_t count = steps_.size();
        if (longest == 0 || count <= largest_whole * longest) return {count};
        const std::vector<std::size_t> crossing = count_crossing();
        std::vector<std::size_t> ends;
        std::size_t begin = 0;
        while (count - begin > longest) {
            std::size_t best = begin + longest;
            for (std::size_t k = begin + longest / 2; k <= begin + longest; ++k)
                if (crossing[k] < crossing[best]) best = k;
            while (best < count && crossing[best] >= forbidden) ++best;
            ends.push_back(best);
            begin = best;
        }
        if (begin < count) ends.push_back(count);
        return ends;
    }

    /// By step: how many values come from before it and are read from it on; no less than `forbidden` where a
    /// factorisation is one of them.
    [[nodiscard]] std::vector<std::size_t> count_crossing() const
    {
        std::vector<std::size_t> crossing(steps_.size() + 1, 0);
        std::vector<std::size_t> enter(steps_.size() + 1, 0);
        std::vector<std::size_t> leave(steps_.size() + 1, 0);
        for (const BodyStep& step : steps_)
            for (const NodeId id : step.defines) {
                if (last_[id] <= born_[id]) continue;
                const std::size_t weight = graph_.op(id) == Op::factor ? forbidden : 1;
                enter[born_[id] + 1] += weight;
                leave[last_[id] + 1] += weight;
            }
        std::size_t alive = 0;
        for (std::size_t k = 0; k < steps_.size(); ++k) crossing[k] = alive = alive + enter[k] - leave[k];
        return crossing;
    }

    /// The steps from `begin` to `end`; what they read is loaded or recalled before its first reader, what later parts
    /// read is kept after its definition.
    std::vector<BodyStep> part(std::size_t begin, std::size_t end)
    {
        std::vector<BodyStep> result;
        std::set<NodeId> known;
        for (std::size_t k = begin; k < end; ++k) {
            for (const NodeId id : steps_[k].needs) {
                if (!known.insert(id).second) continue;
                if (graph_.op(id) == Op::input) result.push_back({BodyStep::Kind::load, id, 0});
                if (const auto place = place_of_.find(id); place != place_of_.end())
                    result.push_back({BodyStep::Kind::recall, id, place->second});
            }
            result.push_back(steps_[k]);
            for (const NodeId id : steps_[k].defines) {
                known.insert(id);
                if (last_[id] >= end) result.push_back({BodyStep::Kind::keep, id, new_place(id)});
            }
        }
        release(end);
        return result;
    }

    std::size_t new_place(NodeId id)
    {
        std::size_t place = workspace_;
        if (free_.empty()) {
            ++workspace_;
        } else {
            place = free_.top();
            free_.pop();
        }
        return place_of_[id] = place;
    }

    /// The places of values that nothing from step `end` on reads.
    void release(std::size_t end)
    {
        std::erase_if(place_of_, [&](const auto& entry) {
            if (last_[entry.first] >= end) return false;
            free_.push(entry.second);
            return true;
        });
    }

    static constexpr std::size_t forbidden = std::size_t{1} << 32U;

    const Graph& graph_;
    const std::vector<BodyStep>& steps_;
    std::vector<std::size_t> born_; ///< by node: the step that computes it
    std::vector<std::size_t> last_; ///< by node: the last step that reads it
    std::map<NodeId, std::size_t> place_of_;
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> free_;
    std::size_t workspace_ = 0;
};

} // namespace

CutBody cut_body(const Graph& graph, const std::vector<BodyStep>& steps, std::size_t longest)
{
    return Cutter(graph, steps).cut(longest);
}

} // namespace lagen
