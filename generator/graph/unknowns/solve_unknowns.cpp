// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/unknowns/solve_unknowns.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/unknowns/implicit.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace lagen {

namespace {

constexpr int most_doublings = 128; ///< of an interval that grows towards an open end
constexpr int most_bracket_steps = 1000;

/// One unknown z with its falling function F(z).
template <class Scalar>
class BracketSolver {
  public:
    static constexpr Scalar infinite = std::numeric_limits<Scalar>::infinity();
    static constexpr Scalar most = std::numeric_limits<Scalar>::max();

    BracketSolver(const Graph& graph, const ImplicitBlock& block, std::size_t k, std::map<std::string, Scalar>& inputs)
        : graph_(graph), block_(block), inputs_(inputs), k_(k), z_(inputs[graph.input_name(block.unknowns[k])])
    {
    }

    void run()
    {
        const std::optional<Scalar> lower = end(block_.bracket->lower[k_]), upper = end(block_.bracket->upper[k_]);
        const std::optional<Scalar> at_lower = known_at(lower), at_upper = lower == upper ? at_lower : known_at(upper);
        if (at_lower && *at_lower <= 0) return take(*lower);
        if (at_upper && *at_upper >= 0) return take(*upper);
        const Scalar nearest = std::min(std::max(Scalar(0), lower.value_or(0)), upper.value_or(infinite));
        const Scalar start = at_lower ? *lower : at_upper ? *upper : nearest;
        Scalar low = start, high = at_upper ? *upper : start;
        if (!at_lower && !grow(low, high, lower.value_or(-infinite), 1)) return;
        if (!at_upper && !grow(high, low, upper.value_or(infinite), -1)) return;
        close_in(low, high);
    }

  private:
    std::optional<Scalar> end(const std::optional<NodeId>& node) const
    {
        if (!node) return std::nullopt;
        const NodeId outputs[] = {*node};
        return evaluate<Scalar>(graph_, outputs, inputs_)[0];
    }

    /// F at a place; its sign is not known where terms have overflowed and F has not.
    struct Sample {
        Scalar slope;
        bool known;
    };

    Sample sample(Scalar z)
    {
        take(z);
        const NodeId outputs[] = {block_.residuals[k_], block_.sizes[k_]};
        const std::vector<Scalar> values = evaluate<Scalar>(graph_, outputs, inputs_);
        return {values[0], !std::isnan(values[0]) && (std::isfinite(values[1]) || std::isinf(values[0]))};
    }

    /// F at an end that is finite, where it is known.
    std::optional<Scalar> known_at(const std::optional<Scalar>& end)
    {
        if (!end || std::isinf(*end)) return std::nullopt;
        const Sample there = sample(*end);
        return there.known ? std::optional<Scalar>(there.slope) : std::nullopt;
    }

    void take(Scalar z) { z_ = z; }

    [[noreturn]] void fail() const
    {
        throw MathematicsError("no " + block_.name + " were found: " + block_.documentation);
    }

    /// Moves `moving` towards `end`, twice as far each time, until F has the sign that it must have there; `other`
    /// follows, so that the root stays between the two. A zero inside is not enough: a function that only tends to zero
    /// may underflow. False where the end itself is the solution.
    bool grow(Scalar& moving, Scalar& other, Scalar end, int sign)
    {
        Scalar step = std::max(Scalar(1), std::abs(moving));
        for (int count = 0; count < most_doublings; ++count, step *= 2) {
            const Sample here = sample(moving);
            if (std::isnan(here.slope)) fail();
            const bool at_end = std::isfinite(end) && moving == end;
            if ((here.known || at_end) && here.slope * static_cast<Scalar>(sign) > 0) return true;
            if (at_end) return here.slope == 0;
            if (here.known && here.slope != 0) other = moving;
            moving = sign > 0 ? std::max({moving - step, end, -most}) : std::min({moving + step, end, most});
        }
        fail();
    }

    /// Half-way; in the exponent where the ends have one sign and are far apart, and 0 where they have two.
    static Scalar middle(Scalar low, Scalar high)
    {
        if (low < 0 && high > 0) return 0;
        const Scalar small = std::min(std::abs(low), std::abs(high)), large = std::max(std::abs(low), std::abs(high));
        const Scalar base = std::max(small, std::numeric_limits<Scalar>::min());
        if (large <= 4 * base) return low / 2 + high / 2;
        return std::copysign(std::sqrt(base) * std::sqrt(large), high > 0 ? Scalar(1) : Scalar(-1));
    }

    /// F(low) > 0 > F(high)
    void close_in(Scalar low, Scalar high)
    {
        const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
        const Scalar least = std::numeric_limits<Scalar>::min();
        Scalar z = middle(low, high), previous = high - low;
        const NodeId outputs[] = {block_.residuals[k_], block_.jacobian[k_ * block_.unknowns.size() + k_]};
        for (int count = 0; count < most_bracket_steps; ++count) {
            z_ = z;
            const std::vector<Scalar> values = evaluate<Scalar>(graph_, outputs, inputs_);
            if (std::isnan(values[0])) fail();
            if (values[0] == 0) return;
            (values[0] > 0 ? low : high) = z;
            Scalar next = z - values[0] / values[1];
            // A step that leaves the interval, or is not half as long as the last one, is replaced by bisection.
            const bool good =
                std::isfinite(values[1]) && next >= low && next <= high && std::abs(next - z) <= previous / 2;
            if (!good) next = middle(low, high);
            const Scalar tight = epsilon * std::abs(z) + least;
            if (high - low <= 2 * tight) break;
            // A step of rounding errors goes a little further, so that the root comes to lie between two places; a
            // second one is replaced by bisection.
            if (std::abs(next - z) <= tight)
                next = previous <= 2 * tight ? middle(low, high)
                                             : std::clamp(values[0] > 0 ? z + tight : z - tight, low, high);
            previous = std::abs(next - z);
            z = next;
        }
        z_ = z;
    }

    const Graph& graph_;
    const ImplicitBlock& block_;
    std::map<std::string, Scalar>& inputs_;
    std::size_t k_;
    Scalar& z_; ///< in inputs_
};

template <class Scalar>
void solve_in_brackets(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
{
    // An equation holds its own unknown alone, but it may be written with others.
    for (const NodeId unknown : block.unknowns) inputs[graph.input_name(unknown)] = 0;
    for (std::size_t k = 0; k < block.unknowns.size(); ++k) BracketSolver<Scalar>(graph, block, k, inputs).run();
}

constexpr int most_steps = 60;
constexpr int most_parts = 20000;

/// A point z with F, dF/dz (factorised) and the sizes of the terms of F there.
template <class Scalar>
struct NewtonPoint {
    std::vector<Scalar> z, residual, jacobian, sizes;
    Factorisation<Scalar> matrix;
    bool finite = false;
};

/// The largest entry; infinite where one is not finite.
template <class Scalar>
Scalar largest_entry(const std::vector<Scalar>& values)
{
    Scalar largest = 0;
    for (const Scalar value : values)
        largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : std::numeric_limits<Scalar>::infinity();
    return largest;
}

/// Newton's method by another route than the runtime's newton.hpp, with the same verdict: along the Newton path
/// F(z(s)) = (1 - s) F(guess), in parts as long as two Newton steps converge, then undamped steps to the last places.
template <class Scalar>
class UnknownSolver {
  public:
    using Values = std::vector<Scalar>;
    using Point = NewtonPoint<Scalar>;

    UnknownSolver(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
        : graph_(graph), block_(block), inputs_(inputs), at_(point(evaluate<Scalar>(graph, block.guess, inputs)))
    {
    }

    void run()
    {
        const bool found = at_.finite && (largest_entry(at_.residual) == 0 || (follow_path(), polish()));
        if (!found) throw MathematicsError("Newton's method finds no " + block_.name + ": " + block_.documentation);
        set(at_.z);
    }

  private:
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    void set(const Values& z)
    {
        for (std::size_t i = 0; i < z.size(); ++i) inputs_[graph_.input_name(block_.unknowns[i])] = z[i];
    }

    /// Not finite where no solution can be.
    Point point(Values z)
    {
        set(z);
        Point result{std::move(z),
                     evaluate<Scalar>(graph_, block_.residuals, inputs_),
                     evaluate<Scalar>(graph_, block_.jacobian, inputs_),
                     evaluate<Scalar>(graph_, block_.sizes, inputs_),
                     {},
                     {}};
        result.finite = std::isfinite(largest_entry(result.residual)) && std::isfinite(largest_entry(result.jacobian));
        for (const Scalar condition : evaluate<Scalar>(graph_, block_.inside, inputs_))
            result.finite = result.finite && condition > 0;
        if (result.finite) result.matrix = factorise(result.jacobian, result.z.size());
        result.finite = result.finite && result.matrix.regular;
        return result;
    }

    /// F - rest F(guess)
    Values off_path(const Point& from, Scalar rest) const
    {
        Values result = from.residual;
        for (std::size_t i = 0; i < result.size(); ++i) result[i] -= rest * start_.residual[i];
        return result;
    }

    Point step_from(const Point& from, const Values& step)
    {
        Values z = from.z;
        for (std::size_t i = 0; i < z.size(); ++i) z[i] -= step[i];
        return point(std::move(z));
    }

    void follow_path()
    {
        start_ = at_;
        Scalar part = 1, done = 0;
        for (int count = 0; count < most_parts && done < 1 && done + part > done; ++count) {
            const Scalar target = std::min(Scalar(1), done + part);
            if (follow(target, target - done)) {
                done = target;
                part *= 2;
            } else {
                part /= 4;
            }
        }
    }

    /// Two Newton steps to the point of the path `part` ahead: both shorten the next one, and F comes near.
    bool follow(Scalar target, Scalar part)
    {
        const Values step = substitute(at_.matrix, off_path(at_, 1 - target));
        const Point middle = step_from(at_, step);
        if (!middle.finite) return false;
        if (!(largest_entry(substitute(at_.matrix, off_path(middle, 1 - target))) <= largest_entry(step) / 2))
            return false;
        const Values second = substitute(middle.matrix, off_path(middle, 1 - target));
        Point end = step_from(middle, second);
        if (!end.finite) return false;
        const Values rest = off_path(end, 1 - target);
        const Scalar slack = epsilon * largest_entry(end.z);
        if (!(largest_entry(substitute(middle.matrix, rest)) <= largest_entry(second) / 4 + slack)) return false;
        const Scalar most = largest_entry(substitute(start_.matrix, start_.residual));
        // Near the path, or half as far from it as before.
        const Scalar before = largest_entry(substitute(start_.matrix, off_path(at_, 1 - target + part)));
        if (!(largest_entry(substitute(start_.matrix, rest)) <= std::max(part * most / 4, before / 2))) return false;
        at_ = std::move(end);
        return true;
    }

    /// True where the steps get shorter down to the last places, or to where F is only rounding.
    bool polish()
    {
        const Scalar most = largest_entry(substitute(start_.matrix, start_.residual));
        for (int count = 0; count < most_steps; ++count) {
            if (largest_entry(at_.residual) == 0) return true;
            const Values step = substitute(at_.matrix, at_.residual);
            const Scalar length = largest_entry(step);
            Point next = step_from(at_, step);
            const Scalar next_length = next.finite ? largest_entry(substitute(at_.matrix, next.residual))
                                                   : std::numeric_limits<Scalar>::infinity();
            const bool falls = next_length <= length * Scalar(0.75) && !is_within(step, epsilon);
            const bool progressed = largest_entry(substitute(start_.matrix, at_.residual)) <= most / 100 &&
                                    length <= std::sqrt(epsilon) * largest_entry(at_.z);
            const bool is_rounding =
                is_within(step, 4 * epsilon) || rows_are_rounding() || (progressed && rows_are_noise());
            if (next_length <= length) at_ = std::move(next);
            if (!falls) return is_rounding;
        }
        return false;
    }

    /// sum_j |dF_i/dz_j| |z_j|
    Scalar terms_of(std::size_t i) const
    {
        const std::size_t n = at_.z.size();
        Scalar terms = 0;
        for (std::size_t j = 0; j < n; ++j) terms += std::abs(at_.jacobian[i * n + j] * at_.z[j]);
        return terms;
    }

    /// The size of the rounding errors of F_i in units of epsilon; 0 where it is not finite.
    Scalar size_of(std::size_t i) const { return std::isfinite(at_.sizes[i]) ? at_.sizes[i] : 0; }

    /// |F_i| <= 4 epsilons of its terms, or of their rounding errors, in every row.
    bool rows_are_rounding() const
    {
        for (std::size_t i = 0; i < at_.z.size(); ++i)
            if (!(std::abs(at_.residual[i]) <= 4 * epsilon * std::max(terms_of(i), size_of(i)))) return false;
        return true;
    }

    /// |F_i| <= 16 epsilons of the size of its rounding errors; where that is not known sqrt(epsilon) of its terms.
    bool rows_are_noise() const
    {
        for (std::size_t i = 0; i < at_.z.size(); ++i) {
            const Scalar size = size_of(i);
            const Scalar noise = size > 0 ? 16 * epsilon * size : std::sqrt(epsilon) * terms_of(i);
            if (!(std::abs(at_.residual[i]) <= noise)) return false;
        }
        return true;
    }

    /// A step that changes every unknown by `share` of it at most.
    bool is_within(const Values& step, Scalar share) const
    {
        for (std::size_t k = 0; k < step.size(); ++k)
            if (!(std::abs(step[k]) <= share * std::abs(at_.z[k]))) return false;
        return true;
    }

    const Graph& graph_;
    const ImplicitBlock& block_;
    std::map<std::string, Scalar>& inputs_;
    Point at_, start_;
};

/// The angle of (b, c), a whole number of turns away from its principal value.
template <class Scalar>
void find_angles(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
{
    const std::vector<Scalar> guess = evaluate<Scalar>(graph, block.guess, inputs);
    const std::vector<Scalar> b = evaluate<Scalar>(graph, block.angles->b, inputs);
    const std::vector<Scalar> c = evaluate<Scalar>(graph, block.angles->c, inputs);
    const Scalar turn = 2 * std::acos(Scalar(-1));
    for (std::size_t i = 0; i < b.size(); ++i) {
        if (b[i] == 0 && c[i] == 0) throw MathematicsError("there are no " + block.name + ": " + block.documentation);
        const Scalar angle = std::atan2(c[i], b[i]);
        inputs[graph.input_name(block.unknowns[i])] = angle + turn * std::round((guess[i] - angle) / turn);
    }
}

} // namespace

template <class Scalar>
void solve_unknowns(const Graph& graph, std::span<const ImplicitBlock> blocks, std::map<std::string, Scalar>& inputs)
{
    for (const ImplicitBlock& block : blocks) {
        if (block.bracket)
            solve_in_brackets(graph, block, inputs);
        else if (block.angles)
            find_angles(graph, block, inputs);
        else
            UnknownSolver<Scalar>(graph, block, inputs).run();
    }
}

template void solve_unknowns<double>(const Graph&, std::span<const ImplicitBlock>, std::map<std::string, double>&);
template void solve_unknowns<long double>(const Graph&, std::span<const ImplicitBlock>,
                                          std::map<std::string, long double>&);

} // namespace lagen
