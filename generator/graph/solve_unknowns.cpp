// SPDX-License-Identifier: GPL-2.0-or-later
#include "graph/solve_unknowns.hpp"

#include "graph/dense_lu.hpp"
#include "graph/evaluate.hpp"

#include "diagnostic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lagen {

namespace {

constexpr int most_steps = 100;
constexpr int most_halvings = 40;

template <class Scalar>
class UnknownSolver {
  public:
    using Values = std::vector<Scalar>;

    UnknownSolver(const Graph& graph, const ImplicitBlock& block, std::map<std::string, Scalar>& inputs)
        : graph_(graph), block_(block), inputs_(inputs)
    {
    }

    void run()
    {
        Values z = evaluate<Scalar>(graph_, block_.guess, inputs_);
        set(z);
        Values residual = evaluate<Scalar>(graph_, block_.residuals, inputs_);
        for (int count = 0; count < most_steps; ++count) {
            const auto matrix = factorise(evaluate<Scalar>(graph_, block_.jacobian, inputs_), z.size());
            const Values step = substitute(matrix, residual);
            const Scalar length = size_of(step);
            // The natural monotonicity test [Deuflhard 2004]: the next simplified step is shorter.
            Values trial;
            Scalar simplified = std::numeric_limits<Scalar>::infinity();
            bool better = false;
            Scalar damping = 1;
            for (int halving = 0; halving <= most_halvings && !better; ++halving, damping /= 2) {
                trial = z;
                for (std::size_t i = 0; i < z.size(); ++i) trial[i] -= damping * step[i];
                set(trial);
                residual = evaluate<Scalar>(graph_, block_.residuals, inputs_);
                simplified = size_of(substitute(matrix, residual));
                better = simplified <= (1 - damping / 4) * length;
            }
            if (!better) return finish(z, length);
            z = trial;
            if (length <= 4 * std::numeric_limits<Scalar>::epsilon() * size_of(z)) return finish(z, length);
        }
        finish(z, std::numeric_limits<Scalar>::infinity());
    }

  private:
    void set(const Values& z)
    {
        for (std::size_t i = 0; i < z.size(); ++i) inputs_[graph_.input_name(block_.unknowns[i])] = z[i];
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

    /// A step that round-off alone keeps from getting shorter ends the iteration; a longer one has failed.
    void finish(const Values& z, Scalar length)
    {
        const Scalar loose = std::sqrt(std::numeric_limits<Scalar>::epsilon());
        if (!(length <= loose * size_of(z)))
            throw MathematicsError("error: Newton's method finds no " + block_.name + ": " + block_.documentation);
        set(z);
    }

    const Graph& graph_;
    const ImplicitBlock& block_;
    std::map<std::string, Scalar>& inputs_;
};

} // namespace

template <class Scalar>
void solve_unknowns(const Graph& graph, std::span<const ImplicitBlock> blocks, std::map<std::string, Scalar>& inputs)
{
    for (const ImplicitBlock& block : blocks) UnknownSolver<Scalar>(graph, block, inputs).run();
}

template void solve_unknowns<double>(const Graph&, std::span<const ImplicitBlock>, std::map<std::string, double>&);
template void solve_unknowns<long double>(const Graph&, std::span<const ImplicitBlock>,
                                          std::map<std::string, long double>&);

} // namespace lagen
