// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/sloped_functions.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/operators.hpp"
#include "proof/power_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace lagen::proof {
namespace {

constexpr double narrowest = 0x1p-200; ///< of the box in which M is sought around an exact point

Ball indeterminate()
{
    Ball out;
    arb_indeterminate(out.get());
    return out;
}

/// [-size, size]
Ball within(const Ball& size)
{
    Ball out;
    arb_get_mag(arb_radref(out.get()), size.get());
    return out;
}

/// A derivative: in `regular` + sum_j [-factor_j, factor_j] u_j^-s_j, s_j > 0.
struct Slope {
    struct Term {
        NodeId base; ///< u_j >= 0, which may vanish
        Rational s;
        Ball factor;
    };
    Ball regular;
    std::vector<Term> terms;

    [[nodiscard]] bool is_zero() const { return terms.empty() && is_exactly_zero(regular); }
    void add(const Ball& more, slong bits) { arb_add(regular.get(), regular.get(), more.get(), bits); }
    void add(Term more, slong bits)
    {
        for (Term& term : terms)
            if (term.base == more.base && term.s == more.s)
                return arb_add(term.factor.get(), term.factor.get(), more.factor.get(), bits);
        terms.push_back(std::move(more));
    }
};

} // namespace

/// At one box: values, then the slopes by one z after another.
class SlopeSweep {
  public:
    SlopeSweep(const SlopedFunctions& functions, const std::vector<Ball>& z, slong bits)
        : f_(functions), graph_(functions.graph_), z_(z), bits_(bits),
          bounds_(
              graph_, [this](NodeId node) -> const Ball& { return value(node); }, bits)
    {
        for (std::size_t k = 0; k < z.size(); ++k) inputs_.emplace(f_.z_[k], z[k]);
        values_ = f_.values_->enclose(inputs_, bits);
    }

    [[nodiscard]] const Ball& value(NodeId node) const { return values_[f_.places_[node]]; }

    /// Of the functions by z[column].
    [[nodiscard]] std::vector<Ball> by(std::size_t column)
    {
        column_ = column;
        slopes_.clear();
        solutions_.clear();
        for (std::size_t k = 0; k < f_.order_.size(); ++k) {
            Slope slope = slope_of(f_.order_[k], f_.parts_[k]);
            if (!slope.is_zero()) slopes_.emplace(f_.order_[k], std::move(slope));
        }
        std::vector<Ball> out;
        for (const NodeId node : f_.functions_) out.push_back(plain(node));
        return out;
    }

  private:
    /// Without terms that are not bounded.
    [[nodiscard]] Ball plain(NodeId node) const
    {
        const auto found = slopes_.find(node);
        if (found == slopes_.end()) return {};
        return found->second.terms.empty() ? found->second.regular : indeterminate();
    }

    [[nodiscard]] Slope slope_of(NodeId node, const std::vector<SlopedFunctions::Part>& parts)
    {
        const auto operands = graph_.operands(node);
        switch (graph_.op(node)) {
        case Op::input: return {Ball(Rational(node == f_.z_[column_] ? 1 : 0), bits_), {}};
        case Op::minimum: return between(operands[0], operands[1], false);
        case Op::maximum: return between(operands[0], operands[1], true);
        case Op::select: {
            const Ball& condition = value(operands[0]);
            if (condition.excludes_zero()) return slope_at(operands[1]);
            if (is_exactly_zero(condition)) return slope_at(operands[2]);
            return {indeterminate(), {}};
        }
        case Op::sqrt:
        case Op::real_power:
            if (const auto q = exponent_of(graph_, node); q && *q < 1 && !value(operands[0]).is_positive())
                return slope_of_root(operands[0], *q);
            break;
        case Op::solve: solve(node); return {};
        case Op::component: {
            const auto found = solutions_.find(operands[0]);
            if (found == solutions_.end()) return {};
            return {found->second ? found->second->at(graph_.payload(node), 0) : indeterminate(), {}};
        }
        default: break;
        }
        Slope sum;
        for (const SlopedFunctions::Part& part : parts)
            if (const auto found = slopes_.find(part.operand); found != slopes_.end())
                add_product(sum, part.derivative, found->second);
        return sum;
    }

    [[nodiscard]] Slope slope_at(NodeId node) const
    {
        const auto found = slopes_.find(node);
        return found == slopes_.end() ? Slope() : found->second;
    }

    /// b' + s (a' - b'), where s is 1, 0 or somewhere between.
    [[nodiscard]] Slope between(NodeId a, NodeId b, bool maximum) const
    {
        Ball s;
        arb_sub(s.get(), value(a).get(), value(b).get(), bits_);
        if (!s.is_finite()) return {indeterminate(), {}};
        if (s.excludes_zero()) return slope_at(s.is_positive() == maximum ? a : b);
        const Slope first = slope_at(a), second = slope_at(b);
        arb_set_d(s.get(), 0.5);
        mag_set_d(arb_radref(s.get()), 0.5);
        Slope out = second;
        Ball difference;
        arb_sub(difference.get(), first.regular.get(), second.regular.get(), bits_);
        out.add(times(s, difference, bits_), bits_);
        for (const Slope::Term& term : first.terms) out.add(term, bits_);
        return out;
    }

    /// q u^(q-1) u' where u may be 0.
    [[nodiscard]] Slope slope_of_root(NodeId u, const Rational& q) const
    {
        const Slope slope = slope_at(u);
        if (slope.is_zero()) return {};
        if (q <= 0 || arb_is_nonnegative(value(u).get()) == 0 || !slope.terms.empty()) return {indeterminate(), {}};
        Ball size = size_of(slope.regular);
        Rational order = q - 1;
        if (const auto M = curvature(u, slope.regular)) {
            arb_mul_2exp_si(size.get(), M->get(), 1);
            arb_sqrt(size.get(), size.get(), bits_);
            order += Rational(1, 2);
        }
        size = times(size, Ball(q, bits_), bits_);
        if (order < 0) return {{}, {{u, Rational(-order), size_of(size)}}};
        return {within(times(size, raised(size_of(value(u)), order, bits_), bits_)), {}};
    }

    /// M with |u'| <= sqrt(2 M u): u(z + h) = u + h u' + h^2 u''/2 >= 0 wherever |h| <= r, for h = -u'/M too where
    /// M >= |u'|/r.
    [[nodiscard]] std::optional<Ball> curvature(NodeId u, const Ball& slope) const
    {
        const std::vector<NodeId> all = reachable(graph_, std::vector{u});
        const auto smooth = [&](NodeId node) {
            const Smoothness kind = operator_of(graph_.op(node)).smoothness;
            return kind == Smoothness::meromorphic || kind == Smoothness::analytic;
        };
        if (!std::ranges::all_of(all, smooth)) return std::nullopt;
        double r = narrowest;
        for (const Ball& each : z_) r = std::max(r, radius_of(each));
        const std::pair<NodeId, NodeId> along[] = {{f_.z_[column_], graph_.constant(1)}};
        const std::vector<NodeId> once = directional(graph_, std::vector{u}, along);
        const std::vector<NodeId> roots{u, directional(graph_, once, along)[0]};
        BallInputs inputs = inputs_;
        Ball& wide = inputs.at(f_.z_[column_]);
        mag_t more;
        mag_init(more);
        mag_set_d(more, r);
        arb_add_error_mag(wide.get(), more);
        mag_clear(more);
        const std::vector<Ball> there = Evaluation(graph_, roots).enclose(inputs, bits_);
        if (arb_is_nonnegative(there[0].get()) == 0) return std::nullopt;
        Ball M = size_of(there[1]), other = size_of(slope), least;
        arb_set_d(least.get(), r);
        arb_div(other.get(), other.get(), least.get(), bits_);
        arb_max(M.get(), M.get(), other.get(), bits_);
        return M.is_finite() ? std::optional(M) : std::nullopt;
    }

    /// sum += a * slope.
    void add_product(Slope& sum, NodeId a, const Slope& slope)
    {
        if (graph_.is_zero(a)) return;
        sum.add(times(value(a), slope.regular, bits_), bits_);
        for (const Slope::Term& term : slope.terms) {
            const auto bound = bounds_.of(a, term.base);
            if (!bound) {
                sum.add(Slope::Term{term.base, term.s, times(term.factor, size_of(value(a)), bits_)}, bits_);
                continue;
            }
            const Ball factor = times(term.factor, bound->C, bits_);
            const Rational left = bound->p - term.s;
            if (left < 0)
                sum.add(Slope::Term{term.base, Rational(-left), factor}, bits_);
            else
                sum.add(within(times(factor, raised(size_of(value(term.base)), left, bits_), bits_)), bits_);
        }
    }

    /// dz = A^-1 (db - dA z).
    void solve(NodeId node)
    {
        const auto operands = graph_.operands(node);
        const auto entries = graph_.operands(operands[0]);
        const std::size_t n = operands.size() - 1;
        BallMatrix A(n, n), z(n, 1), dA(n, n), db(n, 1);
        bool moves = false;
        for (std::size_t k = 0; k < n * n; ++k) {
            A.entries[k] = value(entries[k]);
            dA.entries[k] = plain(entries[k]);
            moves = moves || !is_exactly_zero(dA.entries[k]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            z.entries[k] = value(operands[k + 1]);
            db.entries[k] = plain(operands[k + 1]);
            moves = moves || !is_exactly_zero(db.entries[k]);
        }
        if (!moves) return;
        auto& out = solutions_[node];
        if (const auto found = solved(A, z, bits_))
            out = solved(A, sum(db, Ball(Rational(-1), bits_), product(dA, *found, bits_), bits_), bits_);
    }

    const SlopedFunctions& f_;
    Graph& graph_;
    const std::vector<Ball>& z_;
    slong bits_;
    BallInputs inputs_;
    std::vector<Ball> values_;
    std::size_t column_ = 0;
    std::map<NodeId, Slope> slopes_;                        ///< of the column, those that are not 0
    std::map<NodeId, std::optional<BallMatrix>> solutions_; ///< by solve node; nothing where not certain
    PowerBounds bounds_;
};

SlopedFunctions::SlopedFunctions(Graph& graph, std::vector<NodeId> functions, const std::vector<NodeId>& z)
    : graph_(graph), functions_(std::move(functions)), z_(z)
{
    std::vector<NodeId> needed = functions_;
    const std::vector<bool> active = depends_on(graph, z);
    const NodeId one = graph.constant(1);
    for (const NodeId node : reachable(graph, functions_)) {
        if (!active[node]) continue;
        order_.push_back(node);
        std::vector<Part>& parts = parts_.emplace_back();
        const Op op = graph.op(node);
        const auto rule = operator_of(op).contribution;
        if (rule == nullptr || op == Op::minimum || op == Op::maximum || op == Op::select) continue;
        for (std::size_t j = 0; j < graph.operands(node).size(); ++j) {
            const NodeId operand = graph.operands(node)[j];
            if (active[operand])
                parts.push_back({operand, op == Op::abs ? graph.apply(Op::sign, operand) : rule(graph, node, j, one)});
        }
        for (const Part& part : parts) needed.push_back(part.derivative);
    }
    nodes_ = reachable(graph, needed);
    places_.resize(graph.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) places_[nodes_[k]] = k;
    values_.emplace(graph, nodes_);
}

NewtonEquations SlopedFunctions::at(const std::vector<Ball>& z, slong bits) const
{
    NewtonEquations out{BallMatrix(functions_.size(), 1), BallMatrix(functions_.size(), z_.size())};
    SlopeSweep sweep(*this, z, bits);
    for (std::size_t row = 0; row < functions_.size(); ++row) out.value.at(row, 0) = sweep.value(functions_[row]);
    for (std::size_t column = 0; column < z_.size(); ++column) {
        std::vector<Ball> slopes = sweep.by(column);
        for (std::size_t row = 0; row < functions_.size(); ++row) out.slope.at(row, column) = std::move(slopes[row]);
    }
    return out;
}

namespace {

constexpr slong term_bits = 256;
/// Boxes of 2^-40, 2^-60 and 2^-80, in each of which slopes that vanish as |x|^(1/5) are a sixteenth of those before:
/// what jumps stays as large. Around a point that is known exactly one box as small as one likes has no jump in it that
/// is more than rounding.
constexpr slong boxes[] = {40, 60, 80}, least_box = 1 << 20;
constexpr double much_smaller = 0x1p-4, negligible_radius = 0x1p-150, relative_rounding = 0x1p-180;

using Nodes = std::vector<NodeId>;

std::vector<Ball> in_box(const SlopedFunctions& functions, const std::vector<Ball>& at, slong exponent)
{
    std::vector<Ball> box = at;
    for (Ball& each : box) arb_add_error_2exp_si(each.get(), -exponent);
    NewtonEquations found = functions.at(box, term_bits);
    std::ranges::move(found.value.entries, std::back_inserter(found.slope.entries));
    return found.slope.entries;
}

/// True where it has no more of a radius than rounding gives it, or a part of the one before.
bool is_narrow(const Ball& ball, double before)
{
    const double size = std::fabs(arf_get_d(arb_midref(ball.get()), ARF_RND_NEAR)), radius = radius_of(ball);
    return std::isfinite(size) && std::isfinite(radius) && std::isfinite(before) &&
           radius <= much_smaller * before + negligible_radius + relative_rounding * size;
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
