// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/solve_unknowns.hpp"

#include "graph/dense_lu.hpp"
#include "graph/evaluate.hpp"
#include "graph/solve_in_brackets.hpp"

#include "diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagen {

namespace {

constexpr int most_steps = 200;
constexpr int most_halvings = 40;
constexpr int most_reductions = 300, first_reductions = 10; ///< where F or dF/dz is not finite
constexpr int patience = 3;

/// Newton's method as in the runtime's newton.hpp, with the same verdict: converged where every row is a rounding error
/// of its own terms [Oettli, Prager 1964], where the undamped step is one of every unknown, or where undamped steps
/// near the root get no shorter.
template <class Scalar>
class UnknownSolver {
  public:
    using Values = std::vector<Scalar>;

    UnknownSolver(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
        : graph_(graph), block_(block), inputs_(inputs), z_(evaluate<Scalar>(graph, block.guess, inputs)),
          shares_(z_.size(), 1), rounds_(z_.size(), 0)
    {
    }

    void run()
    {
        set(z_);
        residual_ = residual();
        for (int count = 0; count < most_steps; ++count) {
            const Values jacobian = evaluate<Scalar>(graph_, block_.jacobian, inputs_);
            judge_rows(jacobian);
            matrix_ = factorise(jacobian, z_.size());
            step_ = substitute(matrix_, residual_);
            before_ = std::max(length_, before_ / 4);
            length_ = size_of(step_);
            done_ = done_ || is_within(step_, 4 * epsilon);
            converged_ = converged_ || done_;
            if (!done_ && !std::isfinite(length_)) break;
            if (!search()) break;
            const bool stagnated = stagnates() && !done_;
            // The last step is taken where it does not lead away again.
            if ((done_ || stagnated) && !(next_length_ <= length_)) return set(z_);
            // Beside a singularity the last places may still be some steps away, each shorter than the one before.
            const bool far = !is_within(step_, epsilon) && !is_within(next_, epsilon / 4);
            const bool falls = far && next_length_ <= Scalar(0.75) * length_;
            z_ = trial_;
            residual_ = next_residual_;
            if (stagnated || (done_ && !falls)) return;
        }
        if (converged_) return set(z_);
        throw MathematicsError("error: Newton's method finds no " + block_.name + ": " + block_.documentation);
    }

  private:
    static constexpr Scalar epsilon = std::numeric_limits<Scalar>::epsilon();

    void set(const Values& z)
    {
        for (std::size_t i = 0; i < z.size(); ++i) inputs_[graph_.input_name(block_.unknowns[i])] = z[i];
    }

    /// F at the unknowns in inputs_; NaN where no solution can be.
    Values residual()
    {
        Values values = evaluate<Scalar>(graph_, block_.residuals, inputs_);
        for (const Scalar condition : evaluate<Scalar>(graph_, block_.inside, inputs_))
            if (!(condition > 0)) values[0] = std::numeric_limits<Scalar>::quiet_NaN();
        return values;
    }

    /// The largest entry; infinite where one is not finite.
    static Scalar size_of(const Values& values)
    {
        Scalar largest = 0;
        for (const Scalar value : values)
            largest =
                std::isfinite(value) ? std::max(largest, std::abs(value)) : std::numeric_limits<Scalar>::infinity();
        return largest;
    }

    /// |F_i| against sum_j |dF_i/dz_j| |z_j| and the terms of F_i: rounding errors of them, or small against them.
    void judge_rows(const Values& jacobian)
    {
        done_ = close_ = true;
        const Values sizes = evaluate<Scalar>(graph_, block_.sizes, inputs_);
        for (std::size_t i = 0; i < z_.size(); ++i) {
            Scalar terms = 0;
            for (std::size_t j = 0; j < z_.size(); ++j) terms += std::abs(jacobian[i * z_.size() + j] * z_[j]);
            const Scalar size = std::abs(residual_[i]);
            if (size == 0) continue;
            const bool finite = std::isfinite(terms) && std::isfinite(sizes[i]);
            done_ = done_ && finite && size <= 4 * epsilon * std::max(terms, sizes[i]);
            close_ = close_ && finite && size <= std::max(std::sqrt(epsilon) * terms, 16 * epsilon * sizes[i]);
        }
    }

    /// A step that changes every unknown by `share` of it at most.
    bool is_within(const Values& step, Scalar share) const
    {
        for (std::size_t k = 0; k < z_.size(); ++k)
            if (!(std::abs(step[k]) <= share * std::abs(z_[k]))) return false;
        return true;
    }

    void try_at(Scalar damping)
    {
        damping_ = damping;
        trial_ = z_;
        for (std::size_t i = 0; i < z_.size(); ++i) trial_[i] -= damping * step_[i];
        set(trial_);
        next_residual_ = residual();
        next_ = substitute(matrix_, next_residual_);
        next_length_ = size_of(next_);
    }

    /// The natural monotonicity test [Deuflhard 2004]: the next simplified step is shorter. Near a root round-off may
    /// be what compares them.
    bool search()
    {
        const Scalar tolerable = 16 * std::max(length_, before_);
        Scalar damping = 1;
        for (int count = 0, halvings = 0; count <= most_reductions && halvings <= most_halvings; ++count) {
            try_at(damping);
            const bool finite = std::isfinite(next_length_) &&
                                std::isfinite(size_of(evaluate<Scalar>(graph_, block_.jacobian, inputs_)));
            if (finite && next_length_ <= (1 - damping / 4) * length_ + epsilon * size_of(trial_)) return true;
            if (count == 0 && (done_ || (finite && close_ && next_length_ <= tolerable))) return true;
            halvings += finite ? 1 : 0;
            damping /= finite || count < first_reductions ? 2 : 16;
        }
        if (close_) try_at(1);
        return close_ && std::isfinite(next_length_);
    }

    /// After an undamped step near the root: for every unknown, steps got no shorter `patience` times, and none less
    /// than half as long as the shortest.
    bool stagnates()
    {
        bool all = true;
        for (std::size_t k = 0; k < z_.size(); ++k) {
            const Scalar size = std::abs(step_[k]), next = std::abs(next_[k]);
            shares_[k] = size > 0 ? shares_[k] * next / size : 1;
            rounds_[k] += next >= size ? 1 : 0;
            if (!close_ || damping_ < 1 || !(shares_[k] >= Scalar(0.5))) {
                shares_[k] = 1;
                rounds_[k] = 0;
            }
            all = all && (rounds_[k] >= patience || size <= 4 * epsilon * std::abs(z_[k]));
        }
        return all && close_ && damping_ == 1;
    }

    const Graph& graph_;
    const ImplicitBlock& block_;
    std::map<std::string, Scalar>& inputs_;
    Factorisation<Scalar> matrix_;
    Values z_, residual_, step_, trial_, next_residual_, next_;
    Values shares_; ///< lengths of the last steps, in units of the shortest ones
    std::vector<int> rounds_;
    Scalar length_ = 0, before_ = 0, next_length_ = 0, damping_ = 1;
    bool done_ = false, close_ = false, converged_ = false;
};

} // namespace

template <class Scalar>
void solve_unknowns(const Graph& graph, std::span<const ImplicitBlock> blocks, std::map<std::string, Scalar>& inputs)
{
    for (const ImplicitBlock& block : blocks) {
        if (block.bracket)
            solve_in_brackets(graph, block, inputs);
        else
            UnknownSolver<Scalar>(graph, block, inputs).run();
    }
}

template void solve_unknowns<double>(const Graph&, std::span<const ImplicitBlock>, std::map<std::string, double>&);
template void solve_unknowns<long double>(const Graph&, std::span<const ImplicitBlock>,
                                          std::map<std::string, long double>&);

} // namespace lagen
