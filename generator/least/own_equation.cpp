// SPDX-License-Identifier: GPL-2.0-or-later
/// One watched function h with h'' = F(h; c), c constants of the motion: two states are enough. F is sought as a
/// polynomial in h and c; which terms it has is seen at random points in numbers, their coefficients are solved for at
/// rational points as functions of the parameters, and what is found is proved.
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/simplify/simplify.hpp"
#include "least/rational_span.hpp"
#include "least/reduction.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace lagen {

namespace {

constexpr int highest_power = 3;          ///< of h
constexpr int highest_degree = 2;         ///< in the constants
constexpr std::size_t most_constants = 4; ///< of them, and of conserved functions
constexpr std::size_t most_points = 60;

/// A constant of the motion: what it is now, and what it is called where it is a constant.
struct Constant {
    NodeId function = 0, symbol = 0;
    std::string name = {};
};

/// h^i c_1^j ..
struct Monomial {
    std::vector<int> powers; ///< of h, then of the constants
};

std::vector<Monomial> monomials(std::size_t constants)
{
    std::vector<Monomial> all;
    std::vector<int> powers(constants + 1);
    const auto extend = [&](auto&& self, std::size_t k, int left) -> void {
        if (k == powers.size()) return all.push_back({powers});
        for (int power = 0; power <= left; ++power) {
            powers[k] = power;
            self(self, k + 1, left - power);
        }
        powers[k] = 0;
    };
    for (powers[0] = 0; powers[0] <= highest_power; ++powers[0]) extend(extend, 1, highest_degree);
    return all;
}

class OwnEquation {
  public:
    explicit OwnEquation(Reduction& reduction) : reduction_(reduction), graph_(reduction.graph()) {}

    bool find()
    {
        if (!has_one_function()) return false;
        first_ = reduction_.rate_of(h_);
        find_constants();
        points_ = reduction_.prover.exact_points(most_points);
        const std::optional<NodeId> force = in_h(reduction_.rate_of(first_));
        if (!force) return false;
        force_ = *force;
        return std::ranges::all_of(system().walls, [&](NodeId wall) { return move_wall(wall); });
    }

    /// The two states and their equation.
    bool apply()
    {
        const std::string name = system().watched[0].name;
        const bool is_lane = graph_.op(h_) == Op::input;
        const NodeId h = is_lane ? h_ : graph_.input(name), speed = graph_.input("Dt(" + name + ")");
        std::vector<NodeId> added{speed}, constants;
        if (!is_lane) added.push_back(h);
        for (const Constant& constant : constants_)
            if (constant.symbol != constant.function) constants.push_back(constant.symbol);
        Reduction next = reduction_;
        if (!next.prover.restrict_to({}, constants, added)) return false;
        const Replacements names{{h_symbol_, h}};
        const NodeId force = substitute(graph_, std::vector{force_}, names)[0];
        next.system.lanes = {h, speed};
        next.system.rates = next.written = {speed, force};
        next.system.walls = substitute(graph_, walls_, names);
        next.definitions.clear();
        next.system.start = {reduction_.at_start(h_), reduction_.at_start(first_)};
        for (NamedNode& each : next.system.watched) each.node = h;
        for (const NamedNode& candidate : next.system.candidates) next.not_followed.push_back(candidate.name);
        next.system.candidates.clear();
        for (const Constant& constant : constants_)
            if (constant.symbol != constant.function)
                next.constants.push_back({constant.symbol, reduction_.at_start(constant.function), constant.name});
        for (const NodeId lane : system().lanes)
            if (lane != h) next.left_out.push_back(lane);
        next.steps.push_back({.rule = "own_equation", .lane = name, .value = force, .relations = relations_});
        next.prover.bind(relations_);
        reduction_ = std::move(next);
        return true;
    }

  private:
    [[nodiscard]] const LaneSystem& system() const { return reduction_.system; }

    /// One function is watched, and its own equation would have fewer states, or no pole where the rates have one.
    bool has_one_function()
    {
        if (!system().jumps.empty() || system().watched.empty()) return false;
        for (const NamedNode& each : system().watched)
            if (each.node != system().watched[0].node) return false;
        h_ = system().watched[0].node;
        h_symbol_ = graph_.input("watched function");
        if (!depends_on_any(graph_, std::vector{h_}, system().lanes)) return false;
        std::vector<NodeId> smooth = system().rates; // h'' tells nothing of kinks and jumps
        smooth.push_back(h_);
        if (has_branch(graph_, smooth, system().lanes)) return false;
        return system().lanes.size() > 2 || (system().lanes.size() == 2 && has_pole());
    }

    /// True where something that moves is divided by.
    bool has_pole()
    {
        const std::vector<NodeId> rates = simplify(graph_, system().rates);
        return std::ranges::any_of(reachable(graph_, rates), [&](NodeId node) {
            const auto operands = graph_.operands(node);
            const bool divides = graph_.op(node) == Op::divide ||
                                 (graph_.op(node) == Op::power && static_cast<std::int32_t>(graph_.payload(node)) < 0);
            return divides && depends_on_any(graph_, std::vector{operands.back()}, system().lanes);
        });
    }

    void find_constants()
    {
        for (const StartConstant& constant : reduction_.constants)
            constants_.push_back({constant.input, constant.input, constant.name});
        for (const NamedNode& candidate : system().candidates) {
            const NodeId root[] = {candidate.node};
            if (constants_.size() == most_constants || !depends_on_any(graph_, root, system().lanes)) continue;
            const auto needed = reduction_.prover.vanishing({reduction_.rate_of(candidate.node)});
            if (needed && needed->empty())
                constants_.push_back({candidate.node, graph_.input("start of " + candidate.name), candidate.name});
        }
    }

    [[nodiscard]] NodeId term(const Monomial& monomial, NodeId h, bool in_symbols)
    {
        NodeId product = graph_.constant(1);
        const auto multiply = [&](NodeId base, int power) {
            if (power > 0) product = graph_.multiply(product, power == 1 ? base : graph_.power(base, power));
        };
        multiply(h, monomial.powers[0]);
        for (std::size_t k = 0; k < constants_.size(); ++k)
            multiply(in_symbols ? constants_[k].symbol : constants_[k].function, monomial.powers[k + 1]);
        return product;
    }

    /// `function` as a polynomial in h and the constants, in their symbols; nothing where none is proved.
    std::optional<NodeId> in_h(NodeId function)
    {
        const std::vector<Monomial> terms = terms_of(function);
        if (terms.empty()) return std::nullopt;
        std::vector<NodeId> row;
        for (const Monomial& each : terms) row.push_back(term(each, h_, false));
        const std::vector<NodeId> coefficients = coefficients_of(row, function);
        if (coefficients.empty()) return std::nullopt;
        NodeId defect = graph_.negate(function), symbols = graph_.constant(0);
        for (std::size_t k = 0; k < row.size(); ++k) {
            defect = graph_.add(defect, graph_.multiply(coefficients[k], row[k]));
            symbols = graph_.add(symbols, graph_.multiply(coefficients[k], term(terms[k], h_symbol_, true)));
        }
        const auto needed = reduction_.prover.vanishing({defect});
        if (!needed) return std::nullopt;
        relations_.insert(relations_.end(), needed->begin(), needed->end());
        return symbols;
    }

    /// The terms that the function has at the scene's parameters.
    std::vector<Monomial> terms_of(NodeId function)
    {
        const std::vector<Monomial> all = monomials(constants_.size());
        if (points_.size() < all.size()) return {};
        std::vector<NodeId> row;
        for (const Monomial& each : all) row.push_back(term(each, h_, false));
        row.push_back(function);
        RationalSpan span(row.size());
        for (const NamedPoint& point : points_) span.add(evaluate<long double>(graph_, row, numbers_of(point)));
        if (std::ranges::find(span.pivots(), all.size()) != span.pivots().end()) return {};
        std::vector<Monomial> terms;
        for (std::size_t k = 0; k < span.pivots().size(); ++k)
            if (std::abs(span.entry(k, all.size())) > 1e-9L) terms.push_back(all[span.pivots()[k]]);
        return terms;
    }

    [[nodiscard]] NamedNumbers numbers_of(const NamedPoint& point) const
    {
        NamedNumbers numbers = reduction_.prover.parameter_numbers();
        for (const auto& [name, value] : point) numbers[name] = static_cast<long double>(value.exact->get_d());
        return numbers;
    }

    /// The coefficients c with sum c_k row_k = function at as many rational points as there are terms, functions of the
    /// parameters.
    std::vector<NodeId> coefficients_of(std::vector<NodeId> row, NodeId function)
    {
        const std::size_t m = row.size();
        row.push_back(function);
        std::vector<NodeId> matrix, right, coefficients;
        RationalSpan span(m);
        for (const NamedPoint& point : points_) {
            if (right.size() == m) break;
            const auto there = rational_at(row, point);
            if (!there) return {};
            std::vector<long double> numbers = evaluate<long double>(graph_, *there, numbers_of({}));
            numbers.pop_back();
            if (!span.add(numbers)) continue;
            matrix.insert(matrix.end(), there->begin(), there->end() - 1);
            right.push_back(there->back());
        }
        if (right.size() < m) return {};
        for (const NodeId component : graph_.solve(matrix, right, MatrixStructure::general)) {
            const std::optional<NodeId> coefficient = reduction_.prover.normal_form(component);
            if (!coefficient) return {};
            coefficients.push_back(*coefficient);
        }
        return coefficients;
    }

    /// The nodes at a rational point. A lane that stands in sines and cosines alone is 2 atan(q) there, where these are
    /// 2 q/(1 + q^2) and (1 - q^2)/(1 + q^2).
    [[nodiscard]] std::optional<std::vector<NodeId>> rational_at(const std::vector<NodeId>& nodes,
                                                                 const NamedPoint& point)
    {
        Replacements at;
        std::set<NodeId> angles;
        const std::vector<NodeId> all = reachable(graph_, nodes);
        const auto is_turned = [&](NodeId node) { return graph_.op(node) == Op::sin || graph_.op(node) == Op::cos; };
        for (const NodeId node : all)
            if (is_turned(node)) angles.insert(graph_.operands(node)[0]);
        for (const NodeId node : all)
            for (const NodeId operand : graph_.operands(node))
                if (angles.contains(operand) && !is_turned(node)) return std::nullopt; // an angle by itself
        const NodeId one = graph_.constant(1);
        for (const auto& [name, value] : point) {
            const NodeId input = graph_.input(name), q = graph_.constant(*value.exact);
            at.emplace_back(input, q);
            if (!angles.contains(input)) continue;
            const NodeId square = graph_.power(q, 2), below = graph_.add(one, square);
            at.emplace_back(graph_.apply(Op::cos, input), graph_.divide(graph_.subtract(one, square), below));
            at.emplace_back(graph_.apply(Op::sin, input), graph_.divide(graph_.add(q, q), below));
        }
        return substitute_where_defined(graph_, nodes, at);
    }

    /// True where h never comes to a zero of g, a polynomial of degree 2 at most: h'^2 = P(h), and P is certainly
    /// negative there, for the constants of the start. (Where f crosses 0, f^2 touches it alone, which nobody would
    /// see.)
    bool is_out_of_reach(NodeId g)
    {
        const std::optional<NodeId> P = in_h(graph_.power(first_, 2));
        if (!P) return false;
        NamedNumbers numbers = numbers_of({});
        for (const Constant& constant : constants_) {
            const auto start = reduction_.at_start(constant.function);
            if (!start) return false;
            numbers[graph_.input_name(constant.symbol)] =
                evaluate<long double>(graph_, std::vector{*start}, numbers)[0];
        }
        const auto at = [&](NodeId node, long double h) {
            numbers[graph_.input_name(h_symbol_)] = h;
            return evaluate<long double>(graph_, std::vector{node}, numbers)[0];
        };
        const long double c = at(g, 0), a = (at(g, 1) + at(g, -1)) / 2 - c, b = (at(g, 1) - at(g, -1)) / 2;
        const long double size = std::abs(a) + std::abs(b) + std::abs(c), d = b * b - 4 * a * c;
        if (!(std::abs(at(g, 2) - (4 * a + 2 * b + c)) <= 1e-15L * size) || d < 0) return d < -1e-15L * size * size;
        std::vector<long double> roots;
        if (std::abs(a) <= 1e-15L * size) {
            if (std::abs(b) <= 1e-15L * size) return false;
            roots = {-c / b};
        } else {
            roots = {(-b + std::sqrt(d)) / (2 * a), (-b - std::sqrt(d)) / (2 * a)};
        }
        return std::ranges::all_of(roots, [&](long double root) {
            const long double terms = std::max({std::abs(at(*P, root / 2)), std::abs(at(*P, 0)), 1.0L});
            return at(*P, root) < -1e-14L * terms;
        });
    }

    /// f > 0 as g(h) > 0 where f = g(h), or f^2 = g(h) that h does not come to a zero of.
    bool move_wall(NodeId wall)
    {
        bool is_square = false;
        const Op op = graph_.op(wall);
        const NodeId a = graph_.operands(wall)[0], b = graph_.operands(wall)[1];
        const bool less = op == Op::less || op == Op::less_equal;
        const NodeId f = less ? graph_.subtract(b, a) : graph_.subtract(a, b);
        if (!depends_on_any(graph_, std::vector{f}, system().lanes)) return walls_.push_back(wall), true;
        std::optional<NodeId> g = op == Op::not_equal ? std::nullopt : in_h(f);
        if (!g) g = in_h(graph_.power(f, 2)), is_square = true;
        if (!g || (is_square && !is_out_of_reach(*g))) return false;
        walls_.push_back(graph_.apply(Op::greater, *g, graph_.constant(0)));
        return true;
    }

    Reduction& reduction_;
    Graph& graph_;
    NodeId h_ = 0, h_symbol_ = 0, first_ = 0, force_ = 0;
    std::vector<Constant> constants_;
    std::vector<NamedPoint> points_;
    std::vector<NodeId> relations_, walls_;
};

} // namespace

bool find_own_equation(Reduction& reduction)
{
    OwnEquation equation(reduction);
    return equation.find() && equation.apply();
}

} // namespace lagen
