// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/unknowns/solve_in_brackets.hpp"

#include "graph/core/evaluate.hpp"

#include "text/diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

} // namespace

template <class Scalar>
void solve_in_brackets(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
{
    // An equation holds its own unknown alone, but it may be written with others.
    for (const NodeId unknown : block.unknowns) inputs[graph.input_name(unknown)] = 0;
    for (std::size_t k = 0; k < block.unknowns.size(); ++k) BracketSolver<Scalar>(graph, block, k, inputs).run();
}

template void solve_in_brackets<double>(const Graph&, const ImplicitBlock&, std::map<std::string, double>&);
template void solve_in_brackets<long double>(const Graph&, const ImplicitBlock&, std::map<std::string, long double>&);

} // namespace lagen
