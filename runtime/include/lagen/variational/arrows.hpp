// SPDX-License-Identifier: MIT
/// All arrows that are found with given momenta: F^-L(h) = mu with s(h) = x may have several solutions h, and a run
/// follows one of them.
///   const auto arrows = lagen::arrows_of_momenta(body, 0.0, s);                       // the nearest first
///   const auto run = lagen::integrate(body, arrows.at(1).state, {0.0, 10.0}, lagen::Discrete{});
/// They are looked for by the solver of a step (variational/arrow.hpp) from a fixed set of arrows around the one in s,
/// and around those that are found so: in all directions of up to three sections together, turned by up to pi. What it
/// leads to is a solution to rounding. That these are all of them is not shown.
#pragma once

#include "lagen/variational/discrete.hpp"

#include <array>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace lagen {

/// An arrow with the momenta of a state.
template <DiscreteMotion M>
struct FoundArrow {
    typename M::State state;     ///< that state, with this arrow and its inner unknowns
    typename M::Scalar distance; ///< from the predictor
    bool negative = false;       ///< the sign of det N
};

/// The distance of the arrows of two states along their fibre, (|x_next - x_next'|^2 + |W - W'|^2)^(1/2) with the sum
/// of the squares of all entries of W - W'; inner unknowns do not count.
template <DiscreteMotion M>
[[nodiscard]] typename M::Scalar arrow_distance(const typename M::State& a, const typename M::State& b) noexcept
{
    using std::sqrt;
    using Lanes = detail::ArrowLanes<M>;
    typename M::Scalar sum(0);
    for (int k = Lanes::next; k < Lanes::within; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

namespace detail {

/// See arrows_of_momenta.
template <DiscreteMotion M>
class ArrowSearch {
  public:
    using Scalar = typename M::Scalar;
    using State = typename M::State;

    ArrowSearch(const M& model, const Scalar& t, const State& s)
        : model_(model), t_(t), start_(s), predictor_(s), center_(s)
    {
    }

    /// Distances are those from the arrow that the one in s leads to, or from the one in s itself.
    [[nodiscard]] std::vector<FoundArrow<M>> found(bool from_given = false)
    {
        measure_start();
        if (std::optional<FoundArrow<M>> first = arrow_from(start_)) {
            if (!from_given) {
                predictor_ = first->state;
                first->distance = Scalar(0);
            }
            add(*first);
        }
        look_around(start_);
        for (const FoundArrow<M>& first : std::vector<FoundArrow<M>>(found_)) look_around(first.state);
        return std::move(found_);
    }

  private:
    using Lanes = ArrowLanes<M>;
    using Real = real_t<Scalar>;
    using Column = Eigen::Matrix<Scalar, Lanes::unknowns, 1>;
    using Square = Eigen::Matrix<Scalar, Lanes::unknowns, Lanes::unknowns>;
    using Direction = std::vector<std::pair<int, int>>; ///< sections and signs
    static constexpr int scales = 6, most_together = 3, most_starts = 2500;
    static constexpr Real relative = Real(1e-12);     ///< residual of a solution, of its terms
    static constexpr Real visible = Real(1e-9);       ///< and of the momenta: where terms are huge it may be anything
    static constexpr Real same = Real(1e-6);          ///< arrows, near a fold too
    static constexpr Real same_distance = Real(1e-9); ///< of two arrows that lie opposite

    /// With up to so many sections together: sum over k of 2^k (r over k), at every scale.
    [[nodiscard]] static long starts(int together)
    {
        long sum = 0, term = 1;
        for (int k = 1; k <= std::min(together, Lanes::rank); ++k) sum += term = term * 2 * (Lanes::rank - k + 1) / k;
        return scales * sum;
    }

    /// The length of Newton's step from the start along x_next, 1 where there is none; the size of the given momenta
    /// and of those of arrows of this length, or turned by 1.
    void measure_start()
    {
        using std::abs;
        Column R;
        Square N;
        model_.arrow_equation(t_, start_, R, N);
        Column step = R;
        Square decomposed = N;
        if (eliminate(decomposed, step) != 0 && step.allFinite()) {
            Scalar most(0);
            for (int i = 0; i < Lanes::horizontal; ++i) most = std::max<Scalar>(most, abs(step[i]));
            if (most > Scalar(0)) length_ = most;
        }
        Column lengths = Column::Ones();
        lengths.template head<Lanes::horizontal>().setConstant(length_);
        scale_ = (R.cwiseAbs() + sizes_of_terms<M>(N, lengths, start_)).maxCoeff();
    }

    void look_around(const State& arrow)
    {
        center_ = arrow;
        Direction none;
        for (int count = 1; count <= most_together && starts(count) <= most_starts; ++count) look(none, 0, count);
    }

    /// Starts from all directions with `more` further sections behind number `first`.
    void look(Direction& direction, int first, int more)
    {
        if (more == 0) {
            for (int k = 0; k < scales; ++k) look_along(direction, k);
            return;
        }
        for (int a = first; a < Lanes::rank; ++a)
            for (const int sign : {1, -1}) {
                direction.emplace_back(a, sign);
                look(direction, a + 1, more - 1);
                direction.pop_back();
            }
    }

    /// In two moves, as Cayley's map of one does not turn by pi: turns by (2k + 1) pi/12, lengths 2^(k - 1) times the
    /// natural one.
    void look_along(const Direction& direction, int k)
    {
        using std::sqrt;
        using std::tan;
        const Real angle = (Real(2 * k) + Real(1)) * std::numbers::pi_v<Real> / Real(4 * scales);
        const Scalar turn(M::cayley ? Real(2 * tan(angle / 2)) : angle), length = length_ * Scalar(1 << k) / Scalar(4);
        const Scalar share = Scalar(1) / Scalar(sqrt(Real(direction.size())));
        Column d = Column::Zero();
        for (const auto& [a, sign] : direction) d[a] = Scalar(sign) * share * (a < Lanes::horizontal ? length : turn);
        State z = center_;
        if (!move_arrow(model_, t_, z, d) || !move_arrow(model_, t_, z, d)) return;
        if (const std::optional<FoundArrow<M>> arrow = arrow_from(with_inner(z))) add(*arrow);
    }

    /// With the inner unknowns that belong to its arrow, where they are found.
    [[nodiscard]] State with_inner(const State& z) const
    {
        if constexpr (Lanes::inner == 0) {
            return z;
        } else {
            State stationary = at_arrow(model_, t_, z);
            for (int a = Lanes::momenta; a < M::dimension; ++a) stationary[a] = z[a];
            return stationary.allFinite() ? stationary : z;
        }
    }

    /// The solution that the solver leads to, where it is one: a residual of rounding errors, and N regular.
    [[nodiscard]] std::optional<FoundArrow<M>> arrow_from(State z)
    {
        using std::abs;
        if (solver_.solve(model_, t_, z) != Status::ok) return std::nullopt;
        Column R;
        Square N;
        model_.arrow_equation(t_, z, R, N);
        const Column terms = sizes_of_terms<M>(N, sizes_along<M>(z), z);
        for (int a = 0; a < Lanes::unknowns; ++a)
            if (!(abs(R[a]) <= std::min<Scalar>(Scalar(relative) * terms[a], Scalar(visible) * scale_)))
                return std::nullopt;
        const int sign = eliminate(N, R);
        if (sign == 0) return std::nullopt;
        return FoundArrow<M>{z, arrow_distance<M>(predictor_, z), sign < 0};
    }

    [[nodiscard]] static bool is_same(const FoundArrow<M>& a, const FoundArrow<M>& b)
    {
        using std::abs;
        if (a.negative != b.negative) return false;
        for (int k = Lanes::next; k < Lanes::momenta; ++k)
            if (!(abs(a.state[k] - b.state[k]) <= Scalar(same) * std::max<Scalar>(Scalar(1), abs(b.state[k]))))
                return false;
        return true;
    }

    /// By distance; of the same distance by the sign of det N and the lanes, the larger one first.
    [[nodiscard]] static bool is_before(const FoundArrow<M>& a, const FoundArrow<M>& b)
    {
        using std::abs;
        const Scalar more = a.distance - b.distance;
        if (abs(more) > Scalar(same_distance) * std::max<Scalar>(Scalar(1), b.distance)) return more < Scalar(0);
        if (a.negative != b.negative) return b.negative;
        for (int k = Lanes::next; k < Lanes::momenta; ++k)
            if (abs(a.state[k] - b.state[k]) > Scalar(same)) return a.state[k] > b.state[k];
        return false;
    }

    void add(const FoundArrow<M>& arrow)
    {
        auto place = found_.begin();
        for (const FoundArrow<M>& other : found_) {
            if (is_same(arrow, other)) return;
            if (!is_before(arrow, other)) ++place;
        }
        found_.insert(place, arrow);
    }

    const M& model_;
    Scalar t_;
    State start_, predictor_, center_;
    Scalar length_ = Scalar(1), scale_ = Scalar(0);
    ArrowSolver<M> solver_;
    std::vector<FoundArrow<M>> found_;
};

} // namespace detail

/// The arrows that are found with the base point and the momenta of s, by their distance from the predictor: the arrow
/// that the one in s leads to, as in a run, which then is the first; where there is none, the arrow in s itself.
/// Arrows of the same distance: those with det N > 0 first, then by the lanes, the larger one first. None where there
/// is no number. Each has a residual of F^-L(h) = mu below 1e-12 of its terms, and det N is not 0.
template <DiscreteMotion M>
[[nodiscard]] std::vector<FoundArrow<M>> arrows_of_momenta(const M& model, const typename M::Scalar& t,
                                                           const typename M::State& s)
{
    return detail::ArrowSearch<M>(model, t, s).found();
}

} // namespace lagen
