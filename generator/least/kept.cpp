// SPDX-License-Identifier: GPL-2.0-or-later
/// An invariant set that holds the exact start: lanes that keep their value, and lanes that are equal or opposite to
/// another one. On it the rate of a lane minus that of what stands for it is 0, and the rates are Lipschitz there, so
/// that the motion through the start is the one on the set. A short motion in numbers proposes the set; only what is
/// proved of it stays.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/operators.hpp"
#include "least/reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace lagen {

namespace {

using Numbers = std::vector<long double>;

/// A lane and what stands for it: its start, or plus or minus another lane.
struct Tie {
    std::size_t lane = 0;
    std::optional<std::size_t> other = {}; ///< none: its start
    bool opposite = false;
};

/// The motion from the start for a short time, in numbers.
class ShortMotion {
  public:
    explicit ShortMotion(const Reduction& reduction) : graph_(reduction.graph()), system_(reduction.system)
    {
        inputs_ = reduction.prover.parameter_numbers();
        if (system_.start_time) start_ = evaluate<long double>(graph_, std::vector{*system_.start_time}, inputs_)[0];
        inputs_[graph_.input_name(system_.time)] = start_;
    }

    /// States one after another; empty where a number is not finite, or an input is not known.
    [[nodiscard]] std::vector<Numbers> states(const std::vector<StartConstant>& constants)
    {
        for (const NodeId input : graph_.inputs())
            if (!inputs_.contains(graph_.input_name(input))) inputs_[graph_.input_name(input)] = 0.375L;
        for (const StartConstant& constant : constants)
            inputs_[graph_.input_name(constant.input)] =
                constant.value ? evaluate<long double>(graph_, std::vector{*constant.value}, inputs_)[0] : 0.625L;
        Numbers s;
        for (const std::optional<NodeId>& start : system_.start)
            s.push_back(start ? evaluate<long double>(graph_, std::vector{*start}, inputs_)[0] : 0.4375L);
        const Numbers first = rates_at(s, 0);
        long double speed = 1;
        for (std::size_t i = 0; i < s.size(); ++i) speed = std::max(speed, std::abs(first[i]) / (1 + std::abs(s[i])));
        std::vector<Numbers> states{s};
        const long double h = 0.02L / speed;
        for (int k = 0; k < 24; ++k) states.push_back(s = step(s, static_cast<long double>(k) * h, h));
        for (const Numbers& state : states)
            if (!std::ranges::all_of(state, [](long double each) { return std::isfinite(each); })) return {};
        return states;
    }

  private:
    [[nodiscard]] Numbers rates_at(const Numbers& s, long double t)
    {
        for (std::size_t i = 0; i < s.size(); ++i) inputs_[graph_.input_name(system_.lanes[i])] = s[i];
        inputs_[graph_.input_name(system_.time)] = start_ + t;
        return evaluate<long double>(graph_, system_.rates, inputs_);
    }

    /// A step of the classical method of order 4.
    [[nodiscard]] Numbers step(const Numbers& s, long double t, long double h)
    {
        std::array<Numbers, 4> k;
        const std::array<long double, 4> c{0, 0.5L, 0.5L, 1}, b{1, 2, 2, 1};
        Numbers next = s;
        for (std::size_t stage = 0; stage < 4; ++stage) {
            Numbers place = s;
            if (stage > 0)
                for (std::size_t i = 0; i < s.size(); ++i) place[i] += c[stage] * h * k[stage - 1][i];
            k[stage] = rates_at(place, t + c[stage] * h);
            for (std::size_t i = 0; i < s.size(); ++i) next[i] += h * b[stage] * k[stage][i] / 6;
        }
        return next;
    }

    const Graph& graph_;
    const LaneSystem& system_;
    NamedNumbers inputs_;
    long double start_ = 0; ///< time of the start
};

/// The ties that a short motion keeps, to rounding.
std::vector<Tie> ties_seen(const Reduction& reduction)
{
    const std::vector<Numbers> states = ShortMotion(reduction).states(reduction.constants);
    if (states.empty()) return {};
    const auto& start = reduction.system.start;
    const auto holds = [&](auto difference) {
        return std::ranges::all_of(states, [&](const Numbers& s) {
            const auto [value, scale] = difference(s);
            return std::abs(value) <= 1e-15L * (1 + std::abs(scale));
        });
    };
    std::vector<Tie> ties;
    for (std::size_t i = 0; i < start.size(); ++i) {
        if (!start[i]) continue;
        if (holds([&](const Numbers& s) { return std::pair(s[i] - states[0][i], s[i]); })) {
            ties.push_back({i});
            continue;
        }
        for (std::size_t r = 0; r < i; ++r) {
            const bool is_tied = std::ranges::find(ties, r, &Tie::lane) != ties.end();
            if (!start[r] || is_tied) continue;
            const bool equal = holds([&](const Numbers& s) { return std::pair(s[i] - s[r], s[r]); });
            const bool opposite = holds([&](const Numbers& s) { return std::pair(s[i] + s[r], s[r]); });
            if (!equal && !opposite) continue;
            ties.push_back({i, r, !equal});
            break;
        }
    }
    return ties;
}

/// A set of ties and what is proved of it.
class InvariantSet {
  public:
    InvariantSet(Reduction& reduction, std::vector<Tie> ties) : reduction_(reduction), ties_(std::move(ties)) {}

    /// Drops ties until the set is proved to be invariant; false where nothing is left.
    bool settle()
    {
        while (!ties_.empty()) {
            const std::size_t before = ties_.size();
            if (!try_ties()) return false;
            if (ties_.size() == before) return true;
        }
        return false;
    }

    /// Lets go lanes that stay on a set without them: their rate is 0 wherever they start.
    void release()
    {
        for (std::size_t k = ties_.size(); k-- > 0;) {
            if (ties_[k].other) continue;
            std::vector<Tie> fewer = ties_;
            const std::size_t lane = fewer[k].lane;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
            InvariantSet without(reduction_, fewer);
            if (fewer.empty() || !without.settle() || without.ties_.size() != fewer.size()) continue;
            const auto rate = substitute_where_defined(reduction_.get().graph(), std::vector{system().rates[lane]},
                                                       without.replacements());
            Prover there = reduction_.get().prover;
            if (!rate || !there.restrict_to(without.replacements(), {}) || !there.vanishing(*rate)) continue;
            *this = std::move(without);
        }
    }

    [[nodiscard]] const std::vector<Tie>& ties() const { return ties_; }
    [[nodiscard]] const std::vector<NodeId>& relations() const { return relations_; }
    [[nodiscard]] NodeId value_of(const Tie& tie) const
    {
        if (!tie.other) return *system().start[tie.lane];
        const NodeId other = system().lanes[*tie.other];
        return tie.opposite ? reduction_.get().graph().negate(other) : other;
    }
    [[nodiscard]] Replacements replacements() const
    {
        Replacements values;
        for (const Tie& tie : ties_) values.emplace_back(system().lanes[tie.lane], value_of(tie));
        return values;
    }

  private:
    [[nodiscard]] const LaneSystem& system() const { return reduction_.get().system; }

    /// `values` of all lanes minus what stands for the lane of the tie.
    [[nodiscard]] NodeId defect(const Tie& tie, const std::vector<NodeId>& values, bool of_rates) const
    {
        Graph& graph = reduction_.get().graph();
        const NodeId value = values[tie.lane];
        if (tie.other)
            return tie.opposite ? graph.add(value, values[*tie.other]) : graph.subtract(value, values[*tie.other]);
        return of_rates ? value : graph.subtract(value, *system().start[tie.lane]);
    }

    /// Keeps the ties that are proved on the set of all of them; false where the set is no place for a proof.
    bool try_ties()
    {
        Graph& graph = reduction_.get().graph();
        const Replacements values = replacements();
        Prover there = reduction_.get().prover;
        const auto rates = substitute_where_defined(graph, system().rates, values);
        if (!rates || !there.restrict_to(values, {})) return false;
        std::vector<std::vector<NodeId>> jumps;
        for (const std::vector<NodeId>& jump : system().jumps) {
            const auto behind = substitute_where_defined(graph, jump, values);
            if (!behind) return false;
            jumps.push_back(*behind);
        }
        relations_.clear();
        std::erase_if(ties_, [&](const Tie& tie) {
            std::vector<NodeId> defects{defect(tie, *rates, true)};
            for (const std::vector<NodeId>& jump : jumps) defects.push_back(defect(tie, jump, false));
            if (tie.other) {
                std::vector<NodeId> starts;
                for (const auto& start : system().start) starts.push_back(start.value_or(graph.constant(0)));
                defects.push_back(defect(tie, starts, false));
            }
            const auto needed = there.vanishing(defects);
            if (!needed) return true;
            there.bind(*needed);
            relations_.insert(relations_.end(), needed->begin(), needed->end());
            return false;
        });
        return true;
    }

    std::reference_wrapper<Reduction> reduction_;
    std::vector<Tie> ties_;
    std::vector<NodeId> relations_;
};

bool jumps_in_value(Op op)
{
    const Smoothness smoothness = operator_of(op).smoothness;
    return smoothness == Smoothness::stepped || smoothness == Smoothness::chosen;
}

/// True where the rates have finite slopes at the start in the lanes that are tied, and do not jump with them.
bool are_lipschitz(Reduction& reduction, const std::vector<Tie>& ties)
{
    Graph& graph = reduction.graph();
    const LaneSystem& system = reduction.system;
    std::vector<NodeId> tied;
    for (const Tie& tie : ties) tied.push_back(system.lanes[tie.lane]);
    const std::vector<bool> depends = depends_on(graph, tied);
    for (const NodeId node : reachable(graph, system.rates))
        if (node < depends.size() && depends[node] && jumps_in_value(graph.op(node))) return false;
    Replacements start;
    for (std::size_t i = 0; i < system.lanes.size(); ++i)
        if (system.start[i]) start.emplace_back(system.lanes[i], *system.start[i]);
    const std::vector<NodeId> slopes = joined_rows(jacobian(graph, system.rates, tied));
    const auto there = substitute_where_defined(graph, slopes, start);
    if (!there) return false;
    for (NamedNumbers point : reduction.prover.points()) {
        const std::vector<long double> numbers = evaluate<long double>(graph, *there, point);
        if (!std::ranges::all_of(numbers, [](long double each) { return std::isfinite(each); })) return false;
    }
    return !reduction.prover.points().empty();
}

} // namespace

bool keep_invariant_set(Reduction& reduction)
{
    InvariantSet set(reduction, ties_seen(reduction));
    if (set.ties().empty() || !set.settle()) return false;
    set.release();
    if (!are_lipschitz(reduction, set.ties())) return false;
    Reduction next = reduction;
    next.prover.bind(set.relations());
    for (const Tie& tie : set.ties())
        next.steps.push_back({.rule = "kept",
                              .lane = reduction.name_of(reduction.system.lanes[tie.lane]),
                              .value = set.value_of(tie),
                              .relations = set.relations()});
    if (!next.replace(set.replacements(), true)) return false;
    reduction = std::move(next);
    return true;
}

} // namespace lagen
