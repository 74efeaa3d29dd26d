// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/equilibrium.hpp"

#include "analysis/augmented_energy.hpp"
#include "analysis/leaf.hpp"
#include "geometry/orthonormal_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/simplify/simplify.hpp"
#include "proof/least_squares.hpp"
#include "proof/sloped_functions.hpp"
#include "text/activity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lagen {

using proof::Ball;
using proof::BallMatrix;
using proof::NewtonEquations;
using proof::SlopedFunctions;

namespace {

constexpr slong descent_bits = 64, linear_bits = AugmentedEnergy::precision;
constexpr double perhaps_zero = 1e-5; ///< a coordinate that is taken as 0: tried, then certified
constexpr long double dependent = 1e-9L;
constexpr double surely_zero = 1e-14;    ///< likewise, where functions do not keep it on its leaf
constexpr double converged = 1e-12;      ///< of an equation, in units of its terms
constexpr std::size_t longest_term = 80; ///< that a message names
constexpr double certain_rounding = 0x1p-128, uncertain_rounding = 0x1p-46; ///< of A, in units of its norm

using Nodes = std::vector<NodeId>;

Nodes joined(Nodes a, const Nodes& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Nodes unknowns_of(const MotionEquations& equations)
{
    Nodes out;
    for (const ImplicitBlock& block : equations.implicit) out = joined(std::move(out), block.unknowns);
    return out;
}

Nodes residuals_of(const MotionEquations& equations)
{
    Nodes out;
    for (const ImplicitBlock& block : equations.implicit) out = joined(std::move(out), block.residuals);
    return out;
}

/// Solutions A^-1 b all of whose components stand in f replaced by b: both vanish together.
Nodes without_solves(const Graph& graph, Nodes f)
{
    std::map<NodeId, std::set<NodeId>> components;
    for (const NodeId id : f)
        if (graph.op(id) == Op::component) components[graph.operands(id)[0]].insert(id);
    for (NodeId& id : f) {
        if (graph.op(id) != Op::component) continue;
        const auto solve = graph.operands(graph.operands(id)[0]);
        if (components.at(graph.operands(id)[0]).size() + 1 == solve.size()) id = solve[graph.payload(id) + 1];
    }
    return f;
}

OrthonormalSpan::Vector row_of(const BallMatrix& A, std::size_t row)
{
    OrthonormalSpan::Vector out;
    for (std::size_t k = 0; k < A.columns; ++k) out.push_back(static_cast<long double>(A.at(row, k).middle()));
    return out;
}

/// 0 where that is possible.
double number_in(const Ball& ball)
{
    return arb_contains_zero(ball.get()) != 0 ? 0 : ball.middle();
}

std::vector<Doubles> rows_in(const BallMatrix& A)
{
    std::vector<Doubles> rows(A.rows);
    for (std::size_t i = 0; i < A.rows; ++i)
        for (std::size_t j = 0; j < A.columns; ++j) rows[i].push_back(number_in(A.at(i, j)));
    return rows;
}

BallMatrix block_of(const BallMatrix& A, std::size_t row, std::size_t rows, std::size_t column, std::size_t columns)
{
    BallMatrix out(rows, columns);
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) out.at(i, j) = A.at(row + i, column + j);
    return out;
}

class RestSearch {
  public:
    RestSearch(Graph& graph, const MotionEquations& equations, const Doubles& state)
        : graph_(graph), equations_(equations), unknowns_(unknowns_of(equations)), residuals_(residuals_of(equations)),
          all_(joined(joined(equations.state, unknowns_), equations.inputs)),
          steps_(graph, equations.base, equations.fields)
    {
        choose_leaf(state);
    }

    Equilibrium run(const std::vector<MotionPoint>& starts)
    {
        std::string obstacle;
        Activity activity("searching an equilibrium", starts.size() * (equations_.inputs.empty() ? 1 : 3));
        for (const From from : {From::held_inputs, From::start, From::resting_inputs}) {
            const bool moves_inputs = from != From::held_inputs;
            if (moves_inputs && equations_.inputs.empty()) break;
            for (const MotionPoint& start : starts) {
                activity.next();
                std::string met =
                    search(from == From::resting_inputs ? with_resting_inputs(start) : start, moves_inputs);
                if (met.empty()) {
                    const Activity proof("certificate and slopes");
                    Equilibrium out;
                    out.moves_inputs = moves_inputs;
                    const std::vector<Ball> at = certified(out);
                    if (is_in_domain(at)) return linearised(at, std::move(out));
                    met = fmt::format("the equilibrium {} is not certain to be in the domain of the model", place());
                }
                if (obstacle.empty()) obstacle = std::move(met);
            }
        }
        throw MathematicsError(obstacle, "give a start that is nearer to one; a steady motion is no equilibrium but a "
                                         "relative one: lagen solve --relative-equilibria");
    }

  private:
    /// Where a search begins, and what it moves: the state alone; the state and the inputs; both, from inputs that keep
    /// the start at rest as well as they can.
    enum class From { held_inputs, start, resting_inputs };

    /// The state of the start, with the inputs of least |f| there.
    [[nodiscard]] MotionPoint with_resting_inputs(MotionPoint start)
    {
        const std::size_t n = equations_.state.size();
        Replacements held;
        for (std::size_t k = 0; k < n; ++k) held.emplace_back(all_[k], graph_.constant(Rational(start.state[k])));
        const Nodes conditions = substitute(graph_, joined(without_solves(graph_, equations_.rates), residuals_), held);
        const SlopedFunctions functions(graph_, conditions,
                                        {all_.begin() + static_cast<std::ptrdiff_t>(n), all_.end()});
        Doubles point = start.unknowns;
        point.insert(point.end(), start.inputs.begin(), start.inputs.end());
        const auto found = proof::least_squares(point, [&](const Doubles& at_point) {
            const NewtonEquations at = functions.at(exact_balls(at_point), descent_bits);
            return proof::Residual{middles(at.value), middles(at.slope), 0};
        });
        if (!found) return start;
        const auto inputs = found->z.begin() + static_cast<std::ptrdiff_t>(start.unknowns.size());
        start.unknowns.assign(found->z.begin(), inputs);
        start.inputs.assign(inputs, found->z.end());
        return start;
    }

    /// The constraints, and Casimirs whose slopes at the start are independent of those before.
    void choose_leaf(const Doubles& state)
    {
        leaf_ = equations_.constraints;
        const Nodes all = joined(equations_.constraints, equations_.casimirs);
        const NewtonEquations at = SlopedFunctions(graph_, all, equations_.state).at(exact_balls(state), descent_bits);
        OrthonormalSpan span(dependent);
        for (std::size_t k = 0; k < all.size(); ++k)
            if (span.add(row_of(at.slope, k)) && k >= equations_.constraints.size()) leaf_.push_back(all[k]);
        if (equations_.fields.empty()) return;
        dimension_ = steps_.tangent(state).size();
        has_functions_ = dimension_ + span.size() >= equations_.base.size();
    }

    /// By Newton's steps from `start`: `values_` is a root then, or what is said keeps it from being one.
    [[nodiscard]] std::string search(const MotionPoint& start, bool moves_inputs)
    {
        values_ = start.state;
        values_.insert(values_.end(), start.unknowns.begin(), start.unknowns.end());
        values_.insert(values_.end(), start.inputs.begin(), start.inputs.end());
        moving_ = all_;
        if (!moves_inputs) moving_.resize(all_.size() - equations_.inputs.size());
        Replacements held;
        for (std::size_t k = moving_.size(); k < all_.size(); ++k)
            held.emplace_back(all_[k], graph_.constant(Rational(values_[k])));
        conditions_ =
            substitute(graph_, joined(joined(without_solves(graph_, equations_.rates), leaf_), residuals_), held);
        const SlopedFunctions functions(graph_, conditions_, moving_);
        const auto residual = [&](const Doubles& point) {
            const NewtonEquations at = functions.at(exact_balls(point), descent_bits);
            return proof::Residual{middles(at.value), middles(at.slope), 0};
        };
        const auto first = values_.begin(), last = first + static_cast<std::ptrdiff_t>(moving_.size());
        const bool has_leaf = !equations_.fields.empty() && dimension_ < equations_.base.size();
        const Doubles on_leaf = has_leaf ? steps_.least_squares({first, last}, residual) : Doubles(first, last);
        const proof::Residual there = residual(on_leaf);
        if (!std::ranges::all_of(there.slopes, [](double each) { return std::isfinite(each); }))
            if (const auto term = proof::rough_term(graph_, conditions_, moving_, exact_balls(on_leaf), false))
                return fmt::format("no equilibrium was found: {} has no derivatives where the search begins",
                                   to_text(graph_, *term, longest_term));
        if (!has_functions_ && !is_root(there, on_leaf)) return off_by(there);
        const auto found = proof::least_squares(on_leaf, residual);
        if (!found) return "no equilibrium was found: Newton's method leaves what the rates are defined on";
        Doubles zeros = found->z;
        for (std::size_t k = 0; k < zeros.size(); ++k)
            if (std::fabs(zeros[k]) < (has_functions_ ? perhaps_zero : surely_zero) && zeros[k] != values_[k])
                zeros[k] = 0;
        const bool has_zeros = is_root(residual(zeros), zeros);
        if (!has_zeros && !is_root(found->at, found->z)) return off_by(found->at);
        std::ranges::copy(has_zeros ? zeros : found->z, first);
        return {};
    }

    [[nodiscard]] static std::string off_by(const proof::Residual& at)
    {
        return fmt::format("no equilibrium was found: Newton's method ends where the equations are off by {:.3g}",
                           at.length());
    }

    [[nodiscard]] static bool is_root(const proof::Residual& at, const Doubles& z)
    {
        for (std::size_t k = 0; k < at.values.size(); ++k) {
            double terms = 0;
            for (std::size_t j = 0; j < z.size(); ++j)
                terms += std::fabs(at.slopes[k * z.size() + j]) * std::max(1.0, std::fabs(z[j]));
            if (!(std::fabs(at.values[k]) <= converged * terms)) return false;
        }
        return true;
    }

    /// All variables at the root, in balls that it is certain to lie in where it is certified.
    [[nodiscard]] std::vector<Ball> certified(Equilibrium& out)
    {
        std::vector<Ball> at = exact_balls(values_);
        const std::size_t there = equations_.fields.empty() ? dimension_ : steps_.tangent(values_).size();
        if (there < dimension_)
            out.leaf_kept = LeafKept::approached;
        else if (!has_functions_)
            out.leaf_kept = LeafKept::in_floating_point;
        if (out.leaf_kept == LeafKept::in_floating_point) return at;
        for (const Rest rest : {Rest::zeros, Rest::simplified_zeros, Rest::as_it_is}) {
            const auto root = certified_root(rest);
            if (!root) continue;
            out.certified = true;
            std::ranges::copy(*root, at.begin());
            break;
        }
        for (std::size_t k = 0; k < at.size(); ++k) {
            values_[k] = number_in(at[k]);
            Ball distance = at[k];
            arb_sub(distance.get(), distance.get(), exact_ball(values_[k]).get(), linear_bits);
            out.radius = std::max(out.radius, distance.bound());
        }
        return at;
    }

    /// With coordinates that are near 0 taken as 0, or not.
    enum class Rest { zeros, simplified_zeros, as_it_is };

    /// Of the conditions near `values_`, in what moves.
    [[nodiscard]] std::optional<std::vector<Ball>> certified_root(Rest rest)
    {
        Nodes free;
        Replacements taken_out;
        std::vector<Ball> root(moving_.size()), start;
        std::vector<std::size_t> places;
        for (std::size_t k = 0; k < moving_.size(); ++k) {
            if (rest != Rest::as_it_is && std::fabs(values_[k]) < perhaps_zero) {
                taken_out.emplace_back(moving_[k], graph_.constant(0));
                continue;
            }
            free.push_back(moving_[k]);
            start.push_back(exact_ball(values_[k]));
            places.push_back(k);
        }
        auto conditions = substitute_where_defined(graph_, conditions_, taken_out);
        if (!conditions) return std::nullopt;
        if (rest == Rest::simplified_zeros) conditions = simplify(graph_, *conditions);
        std::erase_if(*conditions, [&](NodeId node) { return graph_.is_zero(node); });
        const SlopedFunctions functions(graph_, *conditions, free);
        const NewtonEquations near = functions.at(start, linear_bits);
        OrthonormalSpan span(dependent);
        for (std::size_t k = 0; k < conditions->size(); ++k)
            if (free.empty() || !span.add(row_of(near.slope, k))) return std::nullopt;
        const std::size_t f = conditions->size(), all = free.size();
        while (span.size() < all) span.add(span.farthest_outside(all));
        const auto equations = [&](const std::vector<Ball>& z) {
            const NewtonEquations at = functions.at(z, linear_bits);
            NewtonEquations out{BallMatrix(all, 1), BallMatrix(all, all)};
            std::ranges::copy(at.value.entries, out.value.entries.begin());
            std::ranges::copy(at.slope.entries, out.slope.entries.begin());
            for (std::size_t i = f; i < all; ++i)
                for (std::size_t j = 0; j < all; ++j) {
                    const Ball g = exact_ball(static_cast<double>(span[i][j]));
                    out.slope.at(i, j) = g;
                    Ball moved = z[j];
                    arb_sub(moved.get(), moved.get(), start[j].get(), linear_bits);
                    arb_addmul(out.value.at(i, 0).get(), g.get(), moved.get(), linear_bits);
                }
            return out;
        };
        const proof::RefinedRoot found = proof::refined_root(equations, start, all, linear_bits);
        if (!found.certified) return std::nullopt;
        for (std::size_t k = 0; k < places.size(); ++k) root[places[k]] = found.z[k];
        return root;
    }

    [[nodiscard]] std::string place() const
    {
        std::string text;
        for (std::size_t k = 0; k < equations_.state.size(); ++k)
            text += fmt::format("{}{} = {:.6g}", k == 0 ? "" : ", ", graph_.input_name(all_[k]), values_[k]);
        return text;
    }

    [[nodiscard]] proof::BallInputs inputs_at(const std::vector<Ball>& at) const
    {
        proof::BallInputs inputs;
        for (std::size_t k = 0; k < at.size(); ++k) inputs.emplace(all_[k], at[k]);
        return inputs;
    }

    [[nodiscard]] bool is_in_domain(const std::vector<Ball>& at) const
    {
        return std::ranges::all_of(proof::Evaluation(graph_, equations_.domain).enclose(inputs_at(at), linear_bits),
                                   &Ball::is_positive);
    }

    void require_smooth(const Nodes& functions, const std::vector<Ball>& at, bool exactly) const
    {
        if (const auto term = proof::rough_term(graph_, functions, all_, at, exactly))
            throw MathematicsError(fmt::format("at the equilibrium {} the rates have no derivatives that are known to "
                                               "be continuous: {} has a kink or a jump there, or ends there",
                                               place(), to_text(graph_, *term, longest_term)),
                                   "write what is smooth: tanh(v/0.01) for sign(v)");
    }

    [[nodiscard]] Equilibrium linearised(const std::vector<Ball>& at, Equilibrium out)
    {
        const auto unknowns = values_.begin() + static_cast<std::ptrdiff_t>(equations_.state.size());
        const auto inputs = values_.end() - static_cast<std::ptrdiff_t>(equations_.inputs.size());
        out.at = {{values_.begin(), unknowns}, {inputs, values_.end()}, {unknowns, inputs}};
        const std::size_t n = equations_.state.size(), q = unknowns_.size(), m = equations_.inputs.size();
        const SlopedFunctions functions(graph_, joined(equations_.rates, residuals_), all_);
        require_smooth(joined(equations_.rates, residuals_), at, out.certified && out.radius == 0);
        const BallMatrix slope = functions.at(at, linear_bits).slope;
        const auto through = [&](std::size_t column, std::size_t columns) {
            const BallMatrix direct = block_of(slope, 0, n, column, columns);
            if (q == 0) return direct;
            const auto shares =
                proof::solved(block_of(slope, n, q, n, q), block_of(slope, n, q, column, columns), linear_bits);
            if (!shares) throw InternalError("the unknowns of an equilibrium have no derivatives");
            return proof::sum(direct, exact_ball(-1), proof::product(block_of(slope, 0, n, n, q), *shares, linear_bits),
                              linear_bits);
        };
        const BallMatrix A = through(0, n);
        out.A = rows_in(A);
        out.B = rows_in(through(n + q, m));
        out.eigenvalues = proof::eigenvalues(A, linear_bits, out.certified ? certain_rounding : uncertain_rounding);
        out.leaf = rows_in(SlopedFunctions(graph_, leaf_, all_).at(at, linear_bits).slope);
        if (out.leaf_kept != LeafKept::by_functions)
            for (Doubles& normal : steps_.normals(values_)) out.leaf.push_back(std::move(normal));
        for (Doubles& row : out.leaf) row.resize(n);
        for (const Ball& rate :
             proof::Evaluation(graph_, equations_.rates).enclose(inputs_at(exact_balls(values_)), descent_bits))
            out.residual = std::max(out.residual, std::fabs(rate.middle()));
        return out;
    }

    Graph& graph_;
    const MotionEquations& equations_;
    Nodes unknowns_, residuals_;
    Nodes all_;  ///< state, unknowns, inputs
    Nodes leaf_; ///< functions that are 0 on the leaf
    LeafSteps steps_;
    std::size_t dimension_ = 0; ///< of the leaf of the start
    bool has_functions_ = true; ///< as many as there are directions off it
    Nodes moving_, conditions_; ///< of the last search
    Doubles values_;            ///< of all
};

} // namespace

Equilibrium equilibrium_near(Graph& graph, const MotionEquations& equations, const std::vector<MotionPoint>& starts)
{
    return RestSearch(graph, equations, starts.front().state).run(starts);
}

} // namespace lagen
