// SPDX-License-Identifier: GPL-2.0-or-later
/// The zero decision: is an expression zero wherever everything in the model is defined? Three-valued and sound:
/// `proved` rests on exact algebra (a normal form modulo the base constraints), `refuted` on a point of the domain and
/// of the constraint set where a certified enclosure of the value excludes zero, everything else is `undecided`.
///
/// Classes that are decided (proved where true):
/// - rational functions; denominators may be any expressions that are not identically zero;
/// - sin, cos, tan of sums of rational multiples of power products (multiples up to 256 times the common unit), sinh,
///   cosh, tanh, exp, Stumpff functions; sin and cos of rational multiples of pi with denominators up to 60;
/// - exp and log: products, quotients, powers, log of what is certainly positive or a square, sums of logarithms with
///   integer coefficients;
/// - roots of any degree whose radicands factor, denest over one root, or cancel by norms and signs; |p|, min, max,
/// sign,
///   if and comparisons, by at most four distinctions of cases;
/// - asin, acos, atan, atan2 under sin, cos, tan with integer multiples and (not atan2) halves; sums of them whose
///   absolute value is certainly below 2 pi;
/// - all of these modulo triangular constraints, with signs that follow from the inequalities of the domain (bounds,
///   sums, products, differences, squares, discriminants), and linear systems of up to 8 coupled equations.
/// Not decided: branches that need more than signs (monotony of other functions, angles beyond one turn), constraints
/// that are not triangular, what exceeds the budget.
#pragma once

#include "graph/core/graph.hpp"
#include "proof/point.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

enum class ProofStatus { proved, refuted, undecided };

[[nodiscard]] const char* to_text(ProofStatus status);

/// Of a conjunction: refuted where one of the two is, proved where both are.
[[nodiscard]] constexpr ProofStatus both(ProofStatus a, ProofStatus b)
{
    if (a == ProofStatus::refuted || b == ProofStatus::refuted) return ProofStatus::refuted;
    return a == ProofStatus::proved ? b : a;
}

/// A point where a residual is certainly not zero.
struct Witness {
    NamedPoint point;      ///< every variable that the setting names; of a Judge those that the residual is about
    double value = 0;      ///< of the residual there (rounded; its enclosure excludes 0)
    NamedPoint whole = {}; ///< of a Judge: every variable
};

struct Decision {
    ProofStatus status = ProofStatus::undecided;
    std::string residual;  ///< normal form as text, "0" where proved; deterministic
    Tree normal_form = {}; ///< the residual's normal form; null where it has none, or was too long
    std::optional<Witness> witness = {};
    std::string evidence = {}; ///< for `undecided`: what is known, e.g. "|r| < 1e-74 at 3 points; term budget of 20000
                               ///< exhausted"; for `proved`: the argument, where it is another than a normal form
    std::size_t points = 0;    ///< of `undecided`: regular points at which the residual was found to have a value
};

/// What holds of the variables.
struct ProofSetting {
    std::vector<NodeId>
        variables; ///< input nodes: base coordinates first, then others (fibre), in order of declaration
    std::vector<NodeId> parameters;  ///< input nodes, universally quantified over the domain
    std::vector<NodeId> constraints; ///< nodes that vanish on M; triangular (see triangular_constraints)
    std::vector<NodeId> domain;      ///< comparison nodes that hold (<, >, !=)
    std::vector<NodeId>
        defined; ///< further nodes whose definedness belongs to "everything in the model is defined" (rho, C, L)
    bool is_wider = false; ///< M is a part of what `constraints` describe: a point of that need not be one of M
};

struct ProofBudget {
    std::size_t terms = 20000;         ///< monomials of one polynomial
    std::size_t products = 20'000'000; ///< term products over one decision
    std::size_t points = 3;            ///< regular witness points wanted
    std::size_t tries = 200;           ///< sampled points before giving up on finding them
    std::size_t searches = 8;          ///< for points that the tries miss, up to 4000 evaluations each
    long precision = 256;              ///< bits of the first enclosure (doubled up to 8 times the value)
    std::size_t seed = 0;              ///< another seed samples other points
};

/// The smaller of each limit; the seed of the first.
[[nodiscard]] ProofBudget smaller(ProofBudget budget, const ProofBudget& other);

/// What a residual is at sample points, by enclosures alone and whatever algebra says.
struct Reevaluation {
    std::size_t points = 0;     ///< regular points where it has a finite enclosure
    double bound = 0;           ///< the largest certified bound of |value|
    bool zero_excluded = false; ///< at one of the points the value is certainly not zero
    NamedPoint where;           ///< that point
};

/// A base constraint that is not triangular; `index` says which one of ProofSetting::constraints.
class TriangularityError : public MathematicsError {
  public:
    TriangularityError(const std::string& text, std::size_t index) : MathematicsError(text), index_(index) {}
    [[nodiscard]] std::size_t index() const noexcept { return index_; }

  private:
    std::size_t index_;
};

/// Decides residuals of one graph under one setting. Same answers and texts on every run and machine.
class ZeroDecider {
  public:
    /// Throws TriangularityError where the constraints are not triangular (each must solve for a new base coordinate,
    /// linearly or as a monic power); the message says which and why.
    ZeroDecider(const Graph& graph, ProofSetting setting, ProofBudget budget = {});
    /// The same, null where the constraints are not triangular.
    [[nodiscard]] static std::unique_ptr<ZeroDecider> make(const Graph& graph, ProofSetting setting,
                                                           ProofBudget budget = {});
    ~ZeroDecider();
    ZeroDecider(const ZeroDecider&) = delete;
    ZeroDecider& operator=(const ZeroDecider&) = delete;

    [[nodiscard]] const ProofBudget& budget() const;
    [[nodiscard]] Decision decide(NodeId residual) const;

    /// The status of `decide` without its texts: a residual that is not zero at one of a few points is not multiplied
    /// out.
    [[nodiscard]] ProofStatus status(NodeId residual) const;

    /// A residual that is known to vanish, by `argument`: `proved`, with the argument as evidence, once its enclosure
    /// at a regular point contains zero; `undecided` where no point tells. Throws InternalError where zero is excluded.
    [[nodiscard]] Decision confirm(NodeId residual, const std::string& argument) const;

    /// Certainly positive / nowhere negative / nowhere zero on the whole domain, by exact algebra (used for
    /// definiteness and for regularity "everywhere"); false means "not shown".
    [[nodiscard]] bool proves_positive(NodeId value) const;
    [[nodiscard]] bool proves_nonnegative(NodeId value) const;
    [[nodiscard]] bool proves_nonzero(NodeId value) const;

    /// A regular sample point (all of `variables` and `parameters`), or nothing where none was found.
    [[nodiscard]] std::optional<NamedPoint> sample_point() const;

    /// The residual at `points` regular points, with balls to 60 digits: precision grows until |value| < 1e-60 or zero
    /// is excluded.
    [[nodiscard]] Reevaluation reevaluate(NodeId residual, std::size_t points) const;

    /// The largest certified bound of |value| at `points` regular points; infinite where there is none.
    [[nodiscard]] double largest_bound(NodeId residual, std::size_t points) const;

  private:
    class State;
    std::unique_ptr<State> state_;
};

} // namespace lagen
