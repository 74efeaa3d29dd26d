// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/exact_flows.hpp"

#include "graph/calculus/differentiate.hpp"
#include "mechanics/momentum_balance.hpp"
#include "verify/proof_setting.hpp"
#include "verify/singular_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lagen {

namespace {

constexpr std::size_t most_derivatives = 6; ///< A^j z that are looked at
constexpr std::size_t longest_text = 400;   ///< of one that is looked at: no flow that is shorter than its series

using Momenta = std::vector<std::size_t>;

class FlowBuilder {
  public:
    FlowBuilder(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian)
        : graph_(graph), system_(system), hamiltonian_(hamiltonian), lanes_(system.algebroid.x),
          time_(graph.input("time along a field"))
    {
        lanes_.insert(lanes_.end(), system.mu.begin(), system.mu.end());
        flows_.length = graph.input("length of a flow");
        setting_ = proof_setting(graph, system);
        setting_.variables.push_back(flows_.length);
        for (const NodeId mu : system.mu)
            if (std::ranges::find(setting_.variables, mu) == setting_.variables.end()) setting_.variables.push_back(mu);
        decider_ = ZeroDecider::make(graph, setting_);
    }

    ExactFlows build()
    {
        if (!find_parts()) flows_.parts.clear();
        return std::move(flows_);
    }

  private:
    // Each of these is false where it meets an obstacle.

    bool refuse(std::string obstacle)
    {
        flows_.obstacle = std::move(obstacle);
        return false;
    }

    bool find_parts()
    {
        if (!hamiltonian_.implicit.empty()) return refuse("the velocities are solved for in every call");
        std::vector<NodeId> base_and_time = system_.algebroid.x;
        base_and_time.push_back(system_.time);
        for (std::size_t a = 0; a < system_.r(); ++a)
            if (const auto other = dependence(hamiltonian_.y[a], base_and_time))
                return refuse(fmt::format("{} depends on {}", velocity(a), graph_.input_name(*other)));
        std::vector<Momenta> groups;
        if (!add_kick() || !group_momenta(groups)) return false;
        if (!std::ranges::all_of(groups, [this](const Momenta& group) { return add_group(group); })) return false;
        if (flows_.parts.empty()) return refuse("H is constant");
        const bool moves_alone = flows_.parts.size() == 1;
        return !moves_alone || !depends_on_any(graph_, flows_.parts[0].increments, std::array{system_.time}) ||
               refuse("its only part depends on t");
    }

    [[nodiscard]] std::string velocity(std::size_t a) const { return graph_.input_name(system_.algebroid.y[a]); }
    [[nodiscard]] std::string momentum(std::size_t a) const { return graph_.input_name(system_.mu[a]); }

    [[nodiscard]] bool vanishes(NodeId node) const
    {
        return graph_.is_zero(node) || (decider_ && decider_->status(node) == ProofStatus::proved);
    }

    /// The first input that the node is not proved to be free of.
    std::optional<NodeId> dependence(NodeId node, const std::vector<NodeId>& inputs)
    {
        for (const NodeId input : inputs)
            if (depends_on_any(graph_, std::array{node}, std::array{input}) &&
                !vanishes(gradient(graph_, node, std::array{input})[0]))
                return input;
        return std::nullopt;
    }

    bool add_kick()
    {
        MomentumBalance balance;
        for (const NodeId slope : hamiltonian_.dH_dx) balance.df_dx.push_back(graph_.negate(slope));
        balance.p = hamiltonian_.mu;
        balance.y.assign(system_.r(), graph_.constant(0));
        balance.forces =
            substitute(graph_, system_.forces_or_zero(graph_), replacements(system_.algebroid.y, hamiltonian_.y));
        const std::vector<NodeId> rates = momentum_rates(graph_, system_.algebroid, balance);
        ExactFlow kick{std::vector<NodeId>(system_.n(), graph_.constant(0)), "V(x)"};
        bool moves = false;
        for (std::size_t b = 0; b < rates.size(); ++b) {
            if (const auto mu = dependence(rates[b], system_.mu))
                return refuse(fmt::format("the force on {} depends on {}", velocity(b), graph_.input_name(*mu)));
            const bool still = vanishes(rates[b]);
            moves = moves || !still;
            kick.increments.push_back(still ? graph_.constant(0) : graph_.multiply(flows_.length, rates[b]));
        }
        if (moves) flows_.parts.push_back(std::move(kick));
        return true;
    }

    [[nodiscard]] bool commute(std::size_t a, std::size_t b) const
    {
        return std::ranges::all_of(system_.algebroid.C(a, b), [&](const ColumnEntry& C) { return vanishes(C.value); });
    }

    /// Sets of momenta whose fields commute; those that T couples stand in one.
    bool group_momenta(std::vector<Momenta>& groups)
    {
        for (const Momenta& coupled : coupled_momenta()) {
            for (const std::size_t a : coupled)
                for (const std::size_t b : coupled)
                    if (a < b && !commute(a, b))
                        return refuse(fmt::format("the kinetic energy couples {} and {}, whose bracket is not zero",
                                                  velocity(a), velocity(b)));
            const auto fits = [&](const Momenta& group) {
                return std::ranges::all_of(group, [&](std::size_t a) {
                    return std::ranges::all_of(coupled, [&](std::size_t b) { return commute(a, b); });
                });
            };
            auto group = std::ranges::find_if(groups, fits);
            if (group == groups.end()) group = groups.insert(groups.end(), Momenta());
            group->insert(group->end(), coupled.begin(), coupled.end());
        }
        return true;
    }

    /// The momenta on which T depends, joined where d2T/dmu_a dmu_b is not zero.
    std::vector<Momenta> coupled_momenta()
    {
        std::vector<Momenta> sets;
        for (std::size_t a = 0; a < system_.r(); ++a) {
            if (vanishes(hamiltonian_.y[a])) continue;
            Momenta joined{a};
            std::erase_if(sets, [&](const Momenta& set) {
                if (std::ranges::none_of(
                        set, [&](std::size_t b) { return dependence(hamiltonian_.y[a], {system_.mu[b]}).has_value(); }))
                    return false;
                joined.insert(joined.end(), set.begin(), set.end());
                return true;
            });
            std::ranges::sort(joined);
            sets.push_back(std::move(joined));
        }
        std::ranges::sort(sets);
        return sets;
    }

    /// A_a z of every lane.
    std::vector<NodeId> field(std::size_t a)
    {
        std::vector<NodeId> rates(lanes_.size(), graph_.constant(0));
        for (const ColumnEntry& rho : system_.algebroid.anchor[a]) rates[rho.index] = rho.value;
        for (std::size_t b = 0; b < system_.r(); ++b)
            for (const ColumnEntry& C : system_.algebroid.C(b, a)) {
                NodeId& rate = rates[system_.n() + b];
                rate = graph_.subtract(rate, graph_.multiply(system_.mu[C.index], C.value));
            }
        return rates;
    }

    [[nodiscard]] bool is_long(NodeId node) const
    {
        return to_text(graph_, node, longest_text + 1).size() > longest_text;
    }

    /// What has no tree.
    [[nodiscard]] bool has_solve(NodeId node) const
    {
        return std::ranges::any_of(reachable(graph_, std::array{node}),
                                   [this](NodeId id) { return graph_.op(id) == Op::solve; });
    }

    NodeId along(const Replacements& seeds, NodeId node) { return directional(graph_, std::array{node}, seeds)[0]; }

    /// theta^j / j! A^j z for 0 < j < end.
    NodeId polynomial(const std::vector<NodeId>& derivatives, std::size_t end)
    {
        NodeId sum = graph_.constant(0);
        Rational factorial = 1;
        for (std::size_t j = 1; j < end; ++j) {
            factorial *= static_cast<long>(j);
            const NodeId factor = graph_.multiply(graph_.constant(1 / factorial), power_of_time(j));
            sum = graph_.add(sum, graph_.multiply(factor, derivatives[j]));
        }
        return sum;
    }

    NodeId power_of_time(std::size_t j) { return j == 1 ? time_ : graph_.power(time_, static_cast<int>(j)); }

    /// c with A^(k+2) z = c A^k z and A c = 0.
    std::optional<NodeId> ratio(const Replacements& seeds, NodeId above, NodeId below)
    {
        if (above == graph_.negate(below)) return graph_.constant(-1);
        const NodeId quotient = graph_.divide(above, below);
        if (!decider_ || is_long(quotient) || has_solve(quotient)) return std::nullopt;
        const auto reduced =
            reduced_fraction(graph_, quotient, to_tree(graph_, quotient), writing_order(graph_, setting_), *decider_);
        if (!reduced) return std::nullopt;
        const NodeId c = Lowering(graph_)(*reduced);
        if (!vanishes(along(seeds, c)) || !vanishes(graph_.subtract(above, graph_.multiply(c, below))))
            return std::nullopt;
        return c;
    }

    /// theta^k c_k(-c theta^2) and theta^(k+1) c_(k+1)(-c theta^2).
    std::array<NodeId, 2> functions(std::size_t k, NodeId c)
    {
        if (k == 1 && graph_.is_constant(c) && graph_.value(c) < 0) { // sin(w theta)/w and (1 - cos(w theta))/w^2
            const NodeId w = graph_.apply(Op::sqrt, graph_.negate(c)), two = graph_.constant(2);
            const NodeId half = graph_.divide(graph_.multiply(w, time_), two);
            const NodeId s = graph_.divide(graph_.apply(Op::sin, half), w);
            return {graph_.product(std::array{two, s, graph_.apply(Op::cos, half)}),
                    graph_.multiply(two, graph_.power(s, 2))};
        }
        const NodeId argument = graph_.negate(graph_.multiply(c, graph_.power(time_, 2)));
        const auto order = static_cast<unsigned>(k);
        return {graph_.multiply(power_of_time(k), graph_.stumpff(order, argument)),
                graph_.multiply(power_of_time(k + 1), graph_.stumpff(order + 1, argument))};
    }

    /// What the field moves the lane by in `time_`.
    std::optional<NodeId> increment(const Replacements& seeds, NodeId lane)
    {
        std::vector<NodeId> derivatives{lane};
        while (derivatives.size() <= most_derivatives) {
            const NodeId next = along(seeds, derivatives.back());
            if (vanishes(next)) return polynomial(derivatives, derivatives.size());
            if (is_long(next)) return std::nullopt;
            derivatives.push_back(next);
            if (derivatives.size() < 4) continue;
            const std::size_t k = derivatives.size() - 3;
            const std::optional<NodeId> c = ratio(seeds, next, derivatives[k]);
            if (!c) continue;
            const auto [first, second] = functions(k, *c);
            const NodeId ends =
                graph_.add(graph_.multiply(first, derivatives[k]), graph_.multiply(second, derivatives[k + 1]));
            return graph_.add(polynomial(derivatives, k), ends);
        }
        return std::nullopt;
    }

    /// The flow of each of these fields, one behind the other.
    bool add_group(const Momenta& group)
    {
        ExactFlow flow{std::vector<NodeId>(lanes_.size(), graph_.constant(0)), ""};
        std::vector<std::string> names;
        std::vector<NodeId> moved = lanes_;
        for (const std::size_t a : group) {
            names.push_back(momentum(a));
            const Replacements seeds = replacements(lanes_, field(a));
            std::vector<NodeId> increments;
            for (const NodeId lane : lanes_) {
                const std::optional<NodeId> found = increment(seeds, lane);
                if (!found)
                    return refuse(fmt::format("where {} alone is not 0, the motion of {} is not known in closed form",
                                              velocity(a), graph_.input_name(lane)));
                increments.push_back(*found);
            }
            Replacements here = replacements(lanes_, moved);
            here.emplace_back(time_, graph_.multiply(flows_.length, hamiltonian_.y[a]));
            increments = substitute(graph_, increments, here);
            for (std::size_t k = 0; k < lanes_.size(); ++k) {
                flow.increments[k] = graph_.add(flow.increments[k], increments[k]);
                moved[k] = graph_.add(moved[k], increments[k]);
            }
        }
        flow.part = fmt::format("T({})", fmt::join(names, ", "));
        bool moves = false;
        for (NodeId& increment : flow.increments) {
            if (vanishes(increment)) increment = graph_.constant(0); // as of two that cancel
            moves = moves || !graph_.is_zero(increment);
        }
        if (moves) flows_.parts.push_back(std::move(flow));
        return true;
    }

    Graph& graph_;
    const System& system_;
    const HamiltonianNodes& hamiltonian_;
    ProofSetting setting_;
    std::unique_ptr<ZeroDecider> decider_;
    std::vector<NodeId> lanes_; ///< x, then mu
    NodeId time_;               ///< theta
    ExactFlows flows_;
};

} // namespace

ExactFlows exact_flows(Graph& graph, const System& system, const HamiltonianNodes& hamiltonian)
{
    if (system.distribution) return {0, {}, "its motions are constrained"};
    return FlowBuilder(graph, system, hamiltonian).build();
}

} // namespace lagen
