// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/series/taylor.hpp"

#include "graph/calculus/substitute.hpp"
#include "graph/core/operators.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace lagen {

namespace {

/// A factor of a pair: the series of a node, or of h times its derivative.
struct Series {
    NodeId node = 0;
    bool derived = false;

    auto operator<=>(const Series&) const = default;
};

class RecurrenceBuilder {
  public:
    RecurrenceBuilder(Graph& graph, std::span<const NodeId> coordinates, std::span<const ImplicitBlock> blocks)
        : graph_(graph), blocks_(blocks), zero_(graph.constant(0)), one_(graph.constant(1))
    {
        result_.order = graph.input("order of the series");
        for (const NodeId coordinate : coordinates) {
            result_.curve.push_back(graph.input("coefficient of " + graph.input_name(coordinate)));
            moving_inputs_.push_back(coordinate);
            known_[coordinate] = result_.curve.back();
        }
        for (const ImplicitBlock& block : blocks)
            moving_inputs_.insert(moving_inputs_.end(), block.unknowns.begin(), block.unknowns.end());
    }

    TaylorRecurrence build(std::span<const NodeId> functions)
    {
        for (const ImplicitBlock& block : needed_blocks(functions)) solve_block(block);
        for (const NodeId function : functions) result_.outputs.push_back(coefficient(function));
        // Coefficients of the pairs may make further pairs.
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            const auto [a, b] = pairs_[k];
            const NodeId first = coefficient(a), second = coefficient(b);
            result_.pairs.push_back({first, second});
        }
        return std::move(result_);
    }

  private:
    // ---- what moves ----

    bool moves(NodeId id)
    {
        for (auto next = static_cast<NodeId>(moves_.size()); next < graph_.size(); ++next) {
            const auto operands = graph_.operands(next);
            moves_.push_back(std::ranges::find(moving_inputs_, next) != moving_inputs_.end() ||
                             std::ranges::any_of(operands, [&](NodeId operand) { return moves_[operand]; }));
        }
        return moves_[id];
    }

    /// node = factor * core, the factor static: minus signs, constants and parameters.
    std::pair<NodeId, NodeId> drawn_out(NodeId node)
    {
        NodeId factor = one_;
        for (;;) {
            if (!moves(node)) return {graph_.multiply(factor, node), one_};
            const Op op = graph_.op(node);
            const auto operands = graph_.operands(node);
            if (op == Op::negate) {
                node = operands[0];
                factor = graph_.negate(factor);
            } else if (op == Op::multiply && (!moves(operands[0]) || !moves(operands[1]))) {
                const std::size_t core = moves(operands[0]) ? 0 : 1;
                const NodeId a = operands[1 - core];
                node = operands[core];
                factor = graph_.multiply(factor, a);
            } else if (op == Op::divide && !moves(operands[1])) {
                const NodeId b = operands[1];
                node = operands[0];
                factor = graph_.multiply(factor, inverse(b));
            } else {
                return {factor, node};
            }
        }
    }

    // ---- parts of rules ----

    NodeId inverse(NodeId node) { return graph_.divide(one_, node); }

    /// a_k, k a_k.
    NodeId coefficient(Series series)
    {
        const NodeId plain = coefficient(series.node);
        return series.derived ? graph_.multiply(result_.order, plain) : plain;
    }

    NodeId coefficient(NodeId root)
    {
        if (!moves(root)) return zero_;
        if (const auto found = known_.find(root); found != known_.end()) return found->second;
        std::set<NodeId> needed;
        std::vector<NodeId> open{root};
        while (!open.empty()) {
            const NodeId id = open.back();
            open.pop_back();
            if (!moves(id) || known_.contains(id) || !needed.insert(id).second) continue;
            if (const auto power = as_power(id))
                open.push_back(power->base);
            else
                open.insert(open.end(), graph_.operands(id).begin(), graph_.operands(id).end());
        }
        for (const NodeId id : needed) {
            const NodeId value = rule(id);
            known_[id] = value;
        }
        return known_.at(root);
    }

    // ---- powers ----

    /// node = c base^exponent with a static c; of what is no power, the node itself.
    struct Power {
        NodeId base = 0;
        Rational exponent;
    };

    Power power_of(NodeId node, int depth = 4)
    {
        const Op op = graph_.op(node);
        const auto operands = graph_.operands(node);
        if (op == Op::sqrt) return {operands[0], Rational(1, 2)};
        if (depth == 0 || (op != Op::power && op != Op::multiply && op != Op::divide)) return {node, 1};
        const Power left = moves(operands[0]) ? power_of(operands[0], depth - 1) : Power{0, 0};
        if (op == Op::power) return {left.base, left.exponent * static_cast<std::int32_t>(graph_.payload(node))};
        const Power right = moves(operands[1]) ? power_of(operands[1], depth - 1) : Power{0, 0};
        if (left.exponent != 0 && right.exponent != 0 && left.base != right.base) return {node, 1};
        return {left.exponent != 0 ? left.base : right.base, op == Op::multiply
                                                                 ? Rational(left.exponent + right.exponent)
                                                                 : Rational(left.exponent - right.exponent)};
    }

    /// The power by whose recurrence a node takes fewer sums than by its own operation; nothing where that is not
    /// defined at 0 or no better.
    std::optional<Power> as_power(NodeId node)
    {
        const Op op = graph_.op(node);
        const auto operands = graph_.operands(node);
        const bool scaled = (op == Op::multiply && moves(operands[0]) != moves(operands[1])) ||
                            (op == Op::divide && !moves(operands[1]));
        if (op == Op::sqrt || scaled) return std::nullopt;
        const Power power = power_of(node);
        const bool natural = power.exponent >= 0 && power.exponent.get_den() == 1;
        const bool reciprocal = power.exponent == -1 && operands[operands.size() - 1] == power.base;
        if (natural || reciprocal) return std::nullopt;
        return power;
    }

    /// <a, b>_k, the series not drawn apart; <a*, b>_k / k of a series of h a'.
    NodeId plain_sum(Series a, Series b)
    {
        if (!moves(a.node) || !moves(b.node)) return zero_;
        std::pair<Series, Series> pair{a, b};
        if (pair.second < pair.first) std::swap(pair.first, pair.second);
        const auto [place, is_new] = place_of_.try_emplace(pair, pairs_.size());
        if (is_new) {
            pairs_.push_back(pair);
            result_.are_means.push_back(a.derived || b.derived);
            result_.sums.push_back(graph_.input("sum " + std::to_string(place->second) + " over lower orders"));
        }
        return result_.sums[place->second];
    }

    /// factor <a, b>_k
    NodeId sum(NodeId factor, Series a, Series b)
    {
        const auto [first, a_core] = drawn_out(a.node);
        const auto [second, b_core] = drawn_out(b.node);
        const NodeId scale = graph_.multiply(factor, graph_.multiply(first, second));
        return graph_.multiply(scale, plain_sum({a_core, a.derived}, {b_core, b.derived}));
    }

    NodeId sum(NodeId a, NodeId b) { return sum(one_, {a, false}, {b, false}); }
    /// <a*, b>_k / k.
    NodeId mean(NodeId a, NodeId b) { return sum(one_, {a, true}, {b, false}); }

    // ---- rules ----

    NodeId rule(NodeId id)
    {
        if (const auto power = as_power(id)) return by_power(id, power->base, graph_.constant(power->exponent));
        const auto operand = [&](std::size_t k) { return graph_.operands(id)[k]; };
        switch (operator_of(graph_.op(id)).series) {
        case SeriesRule::constant: return zero_;
        case SeriesRule::linear: return tangent(id);
        case SeriesRule::choice: return choice(id);
        case SeriesRule::product: return product(operand(0), operand(1));
        case SeriesRule::quotient: return quotient(id, operand(0), operand(1));
        case SeriesRule::power: return integer_power(id);
        case SeriesRule::real_power: return real_power(id, operand(0), operand(1));
        case SeriesRule::root:
            return graph_.multiply(graph_.subtract(coefficient(operand(0)), sum(id, id)),
                                   graph_.divide(graph_.constant(Rational(1, 2)), id));
        case SeriesRule::logarithm:
            return graph_.multiply(graph_.subtract(coefficient(operand(0)), mean(id, operand(0))), inverse(operand(0)));
        case SeriesRule::chain: return chain(id);
        case SeriesRule::modulus:
            return graph_.multiply(graph_.select(graph_.apply(Op::less, operand(0), zero_), graph_.constant(-1), one_),
                                   coefficient(operand(0)));
        case SeriesRule::system: return linear_system(id);
        case SeriesRule::refused:
            throw MathematicsError(std::string("there is no Taylor series of ") + operator_of(graph_.op(id)).name +
                                   "() in finitely many functions: take another method, such as dop853");
        case SeriesRule::missing: break;
        }
        throw InternalError("an operation without Taylor coefficients");
    }

    /// The derivative's rule.
    NodeId tangent(NodeId id)
    {
        NodeId result = zero_;
        for (std::size_t k = 0; k < graph_.operands(id).size(); ++k) {
            const NodeId t = coefficient(graph_.operands(id)[k]);
            if (!graph_.is_zero(t))
                result = graph_.add(result, operator_of(graph_.op(id)).contribution(graph_, id, k, t));
        }
        return result;
    }

    NodeId choice(NodeId id)
    {
        const Op op = graph_.op(id);
        const std::vector<NodeId> of(graph_.operands(id).begin(), graph_.operands(id).end());
        if (op == Op::select) return graph_.select(of[0], coefficient(of[1]), coefficient(of[2]));
        const NodeId first = graph_.apply(op == Op::minimum ? Op::less_equal : Op::greater_equal, of[0], of[1]);
        return graph_.select(first, coefficient(of[0]), coefficient(of[1]));
    }

    /// Of what is left when static factors are drawn out: products that differ by these alone are one.
    NodeId product(NodeId a, NodeId b)
    {
        const auto [first, u] = drawn_out(a);
        const auto [second, v] = drawn_out(b);
        const NodeId u_k = coefficient(u), v_k = coefficient(v);
        const NodeId ends = u == v ? graph_.multiply(graph_.multiply(graph_.constant(2), u), u_k)
                                   : graph_.add(graph_.multiply(u, v_k), graph_.multiply(v, u_k));
        return graph_.multiply(graph_.multiply(first, second), graph_.add(ends, plain_sum({u, false}, {v, false})));
    }

    NodeId quotient(NodeId q, NodeId a, NodeId b)
    {
        const NodeId b_k = coefficient(b);
        const NodeId rest = graph_.add(graph_.multiply(q, b_k), sum(b, q));
        return graph_.multiply(graph_.subtract(coefficient(a), rest), inverse(b));
    }

    /// Natural powers by products, which are defined where a_0 = 0.
    NodeId integer_power(NodeId id)
    {
        const auto n = static_cast<std::int32_t>(graph_.payload(id));
        const NodeId a = graph_.operands(id)[0];
        if (n == -1) return quotient(id, one_, a);
        if (n == 2) return product(a, a);
        return product(n == 3 ? a : graph_.power(a, n - n / 2), graph_.power(a, n == 3 ? 2 : n / 2));
    }

    NodeId real_power(NodeId id, NodeId a, NodeId b)
    {
        if (!moves(b)) return by_power(id, a, b);
        const NodeId exponent = graph_.multiply(b, graph_.apply(Op::log, a));
        return graph_.add(graph_.multiply(id, coefficient(exponent)), mean(exponent, id));
    }

    /// p = c a^n with p' a = n a' p.
    NodeId by_power(NodeId p, NodeId a, NodeId n)
    {
        const NodeId ends = graph_.multiply(graph_.multiply(n, p), coefficient(a));
        const NodeId raised = sum(graph_.add(n, one_), {a, true}, {p, false});
        const NodeId inner = graph_.subtract(raised, sum(a, p));
        return graph_.multiply(graph_.add(ends, inner), inverse(a));
    }

    NodeId chain(NodeId id)
    {
        NodeId result = zero_;
        for (std::size_t k = 0; k < graph_.operands(id).size(); ++k) {
            const NodeId a = graph_.operands(id)[k];
            if (!moves(a)) continue;
            const NodeId slope = operator_of(graph_.op(id)).contribution(graph_, id, k, one_);
            result = graph_.add(result, graph_.add(graph_.multiply(slope, coefficient(a)), mean(a, slope)));
        }
        return result;
    }

    // ---- systems ----

    /// A component asks for the coefficients of its solution, which are made once.
    NodeId linear_system(NodeId id)
    {
        if (graph_.op(id) != Op::component) return zero_;
        const NodeId solve = graph_.operands(id)[0];
        const std::size_t k = graph_.payload(id);
        if (const auto found = solutions_.find(solve); found != solutions_.end()) return found->second[k];
        return (solutions_[solve] = solution(solve))[k];
    }

    std::vector<NodeId> solution(NodeId solve)
    {
        const std::vector<NodeId> operands(graph_.operands(solve).begin(), graph_.operands(solve).end());
        const std::vector<NodeId> A(graph_.operands(operands[0]).begin(), graph_.operands(operands[0]).end());
        const auto structure = static_cast<MatrixStructure>(graph_.payload(operands[0]));
        const std::span<const NodeId> b = std::span(operands).subspan(1);
        const std::size_t n = b.size();
        const std::vector<NodeId> z = graph_.solve(A, b, structure);
        std::vector<NodeId> right;
        for (std::size_t i = 0; i < n; ++i) {
            NodeId rest = zero_;
            for (std::size_t l = 0; l < n; ++l)
                if (const NodeId entry = A[i * n + l]; moves(entry)) {
                    const NodeId ends = graph_.multiply(coefficient(entry), z[l]);
                    rest = graph_.add(rest, graph_.add(ends, sum(entry, z[l])));
                }
            right.push_back(graph_.subtract(coefficient(b[i]), rest));
        }
        return graph_.solve(A, right, structure);
    }

    /// The blocks on whose unknowns the functions depend, directly or through one of them, in order.
    std::vector<ImplicitBlock> needed_blocks(std::span<const NodeId> functions)
    {
        std::vector<NodeId> roots(functions.begin(), functions.end());
        std::vector<ImplicitBlock> needed;
        for (std::size_t k = blocks_.size(); k-- > 0;) {
            if (!depends_on_any(graph_, roots, blocks_[k].unknowns)) continue;
            needed.insert(needed.begin(), blocks_[k]);
            roots.insert(roots.end(), blocks_[k].residuals.begin(), blocks_[k].residuals.end());
        }
        return needed;
    }

    /// z_k = -F_z^-1 F_k; at an end of its interval an unknown moves with it.
    void solve_block(const ImplicitBlock& block)
    {
        for (const NodeId unknown : block.unknowns) known_[unknown] = zero_;
        std::vector<NodeId> right;
        for (const NodeId residual : block.residuals) right.push_back(graph_.negate(coefficient(residual)));
        const std::vector<NodeId> z = graph_.solve(block.jacobian, right, block.structure);
        // What was made with z_k = 0 is no coefficient of anything else.
        const std::vector<bool> stale = depends_on(graph_, block.unknowns);
        std::erase_if(known_, [&](const auto& entry) { return stale[entry.first]; });
        std::erase_if(solutions_, [&](const auto& entry) { return stale[entry.first]; });
        for (std::size_t k = 0; k < z.size(); ++k) known_[block.unknowns[k]] = at_an_end(block, k, z[k]);
    }

    NodeId at_an_end(const ImplicitBlock& block, std::size_t k, NodeId inside)
    {
        if (!block.bracket) return inside;
        const NodeId z = block.unknowns[k];
        if (const auto upper = block.bracket->upper[k])
            inside = graph_.select(graph_.apply(Op::greater_equal, z, *upper), coefficient(*upper), inside);
        if (const auto lower = block.bracket->lower[k])
            inside = graph_.select(graph_.apply(Op::less_equal, z, *lower), coefficient(*lower), inside);
        return inside;
    }

    Graph& graph_;
    std::span<const ImplicitBlock> blocks_;
    NodeId zero_, one_;
    std::vector<NodeId> moving_inputs_;
    std::vector<bool> moves_;        ///< by node
    std::map<NodeId, NodeId> known_; ///< coefficients of order k
    std::map<NodeId, std::vector<NodeId>> solutions_;
    std::map<std::pair<Series, Series>, std::size_t> place_of_;
    std::vector<std::pair<Series, Series>> pairs_;
    TaylorRecurrence result_;
};

} // namespace

TaylorRecurrence taylor_recurrence(Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> coordinates,
                                   std::span<const ImplicitBlock> blocks)
{
    return RecurrenceBuilder(graph, coordinates, blocks).build(functions);
}

std::vector<NodeId> with_joined_factors(Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> moving)
{
    struct Product {
        NodeId factor, core;
    };
    const std::vector<bool> moves = depends_on(graph, moving);
    const NodeId one = graph.constant(1);
    std::vector<Product> products(moves.size());
    Rebuilder map(graph, moves.size());
    for (const NodeId id : reachable(graph, functions)) {
        const Op op = graph.op(id);
        const bool splits = moves[id] && (op == Op::negate || op == Op::multiply || op == Op::divide);
        if (!splits) {
            map.rebuild(id);
            if (op != Op::factor && op != Op::solve)
                products[id] = moves[id] ? Product{one, map[id]} : Product{map[id], one};
            continue;
        }
        const Product a = products[graph.operands(id)[0]], b = products[graph.operands(id).back()];
        const auto joined = [&](NodeId x, NodeId y) {
            return op == Op::multiply ? graph.multiply(x, y) : graph.divide(x, y);
        };
        if (op == Op::negate)
            products[id] = {graph.negate(a.factor), a.core};
        else
            products[id] = {joined(a.factor, b.factor), joined(a.core, b.core)};
        map.set(id, graph.multiply(products[id].factor, products[id].core));
    }
    std::vector<NodeId> result;
    for (const NodeId function : functions) result.push_back(map[function]);
    return result;
}

void require_analytic(const Graph& graph, std::span<const NodeId> functions, std::span<const NodeId> coordinates,
                      std::span<const ImplicitBlock> blocks)
{
    const auto refuse = [](const std::string& what) {
        throw MathematicsError(
            fmt::format("a Taylor series does not see the kinks and jumps of {} along the motion: take another "
                        "method, such as dop853",
                        what));
    };
    std::vector<NodeId> roots(functions.begin(), functions.end()), moving(coordinates.begin(), coordinates.end());
    for (const ImplicitBlock& block : blocks) {
        if (block.bracket) refuse("what is searched for between bounds");
        roots.insert(roots.end(), block.residuals.begin(), block.residuals.end());
        moving.insert(moving.end(), block.unknowns.begin(), block.unknowns.end());
    }
    const std::vector<bool> moves = depends_on(graph, moving);
    for (const NodeId id : reachable(graph, roots)) {
        const Operator& row = operator_of(graph.op(id));
        const bool smooth = row.smoothness != Smoothness::kinked && row.smoothness != Smoothness::stepped &&
                            row.smoothness != Smoothness::chosen;
        if (!moves[id] || smooth) continue;
        const bool is_word = std::isalpha(static_cast<unsigned char>(row.name[0])) != 0;
        refuse(is_word ? std::string(row.name) + "()" : fmt::format("the comparison '{}'", row.name));
    }
}

} // namespace lagen
