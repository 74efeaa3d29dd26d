// SPDX-License-Identifier: MIT
/// The arrow h of a Lie groupoid that a momentum determines: F^-L(h) = mu with s(h) = x given. Newton's method moves h
/// along its source fibre, h <- h eta(d) with N d = mu - F^-L(h), N_ab = <-e_b (F^-L_a); eta is Cayley's map or exp.
///
/// The equation may have several solutions, and folds where det N = 0 behind which there are none. The one that is
/// taken is connected with the guess: Newton's method is trusted where its steps shrink by a factor of four and det N
/// keeps its sign, and where the first step is no small part of the arrow, N^-1 R changes by less than half of itself
/// on it and det N keeps its sign at points between; else mu is led from F^-L(guess) to its value, in steps as short as
/// they have to be. A discrete Lagrangian that a scheme made may have inner unknowns w of a step, at which it is
/// stationary; they are found with the arrow, by dL/dw = 0.
#pragma once

#include "lagen/group/eliminate.hpp"
#include "lagen/variational/arrow_parts.hpp"

#include <algorithm>
#include <cstddef>

namespace lagen {

template <DiscreteMotion M>
class ArrowSolver {
  public:
    using Scalar = typename M::Scalar;
    using State = typename M::State;
    static constexpr int rank = M::fibre_dimension + M::inner_dimension; ///< of the equations
    using Column = Eigen::Matrix<Scalar, rank, 1>;

    /// Solves for the arrow of `s`, from the one that stands there; its base point and momenta stay. `before`: the
    /// arrow of the step before where the guess goes on from it, by the move `ahead`. What fails leaves `s` as it is:
    /// @return singular_mass_matrix where N is singular at the guess; no_solution where mu lies behind a fold;
    ///         branch_lost where no way is found along which det N keeps the sign that it had; newton_diverged;
    ///         non_finite.
    [[nodiscard]] Status solve(const M& model, const Scalar& t, State& s, const State* before = nullptr,
                               const Column& ahead = Column::Zero()) noexcept
    {
        State z = s;
        moved_ = ahead;
        shift_.setZero();
        points_ = before != nullptr ? 3 : most_points;
        const Status status = newton(model, t, z, before != nullptr);
        if (status == Status::ok) return s = z, status;
        points_ = most_points;
        z = s;
        if (before != nullptr)
            for (int k = Lanes::next; k < Lanes::momenta; ++k) z[k] = (*before)[k];
        const Status led = lead(model, t, z, before != nullptr);
        if (led == Status::ok) s = z;
        return led;
    }

    /// The sum of the moves to the arrow that was found: from `before`, or from the guess where there is none.
    [[nodiscard]] const Column& moved() const noexcept { return moved_; }
    [[nodiscard]] std::size_t evaluations() const noexcept { return evaluations_; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return decompositions_; }

  private:
    using Lanes = detail::ArrowLanes<M>;
    using Real = real_t<Scalar>;
    static constexpr int most_steps = 30, most_points = 12;
    static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

    /// What is left of R = (mu - F^-L(h), -dL/dw), and N; false where they are no finite numbers.
    [[nodiscard]] bool evaluate(const M& model, const Scalar& t, const State& z) noexcept
    {
        ++evaluations_;
        model.arrow_equation(t, z, residual_, N_);
        residual_ -= shift_;
        return residual_.allFinite() && N_.allFinite();
    }

    /// N^-1 of a right-hand side; the sign of det N, 0 where N is singular.
    [[nodiscard]] int solved(Column& right) noexcept
    {
        ++decompositions_;
        Eigen::Matrix<Scalar, rank, rank> N = N_;
        return detail::eliminate(N, right);
    }

    /// Of momenta F^-L(h) of the size N (h - 1), and of mu. Where N (h - 1) is so large that it hides what is left, h
    /// is none: W of 1e18 has the momenta of any. `first`: z is the guess, by whose terms that is judged.
    [[nodiscard]] bool is_rounding(const State& z, const Column& sizes, bool first) noexcept
    {
        using std::abs;
        using std::sqrt;
        const Column terms = detail::sizes_of_terms<M>(N_, sizes, z);
        if (first) visible_ = Scalar(Real(sqrt(epsilon))) * (residual_.cwiseAbs() + terms).maxCoeff();
        for (int a = 0; a < rank; ++a)
            if (!(abs(residual_[a]) <= std::min<Scalar>(Scalar(epsilon) * terms[a], visible_))) return false;
        return true;
    }

    /// Undamped steps that shrink; with `follows`, det N has the sign that it had. newton_diverged where they do not
    /// shrink.
    [[nodiscard]] Status newton(const M& model, const Scalar& t, State& z, bool follows) noexcept
    {
        Scalar before(0);
        bool negative = negative_, wide = false;
        Column first_residual, first_step;
        for (int k = 0; k < most_steps; ++k) {
            if (!evaluate(model, t, z)) return Status::non_finite;
            if (k == 1 && wide && !is_alike(first_residual, first_step)) return Status::branch_lost;
            const Column sizes = detail::sizes_along<M>(z);
            const bool found = is_rounding(z, sizes, k == 0), known = k > 0 || follows;
            if (found && known) return settle(negative);
            Column d = residual_;
            const int sign = solved(d);
            if (!known) negative = sign < 0;
            if (found) return settle(negative);
            if (sign == 0) return Status::singular_mass_matrix;
            if ((sign < 0) != negative) return Status::branch_lost;
            const Scalar length = d.cwiseAbs().maxCoeff();
            if (!(length - length == Scalar(0))) return Status::newton_diverged;
            if (k > 0 && detail::is_part<M>(d, sizes, Scalar(Real(4) * epsilon))) return settle(negative);
            const auto rounds = [&] { return length <= Scalar(Real(256) * epsilon) * detail::size_of_ends<M>(z); };
            if (k > 0 && !(length <= Scalar(Real(0.25)) * before))
                return rounds() ? settle(negative) : Status::newton_diverged;
            wide = k == 0 && !(length <= Scalar(Real(0.0625)) * detail::largest_part<M>(z)) && !rounds();
            if (wide) {
                first_residual = residual_;
                first_step = d;
                if (!keeps_sign(model, t, z, d, negative)) return Status::branch_lost;
            }
            if (!detail::move_arrow(model, t, z, d)) return Status::newton_diverged;
            moved_ += d;
            // What the next step would be, by quadratic convergence.
            if (k > 0) {
                const Scalar rate = length / before;
                if (detail::is_part<M>(Column(rate * rate * d), sizes, Scalar(Real(0.125) * epsilon)))
                    return settle(negative);
            }
            before = length;
        }
        return Status::newton_diverged;
    }

    /// Whether N^-1 R of the first residual is, by the N behind the first step, that step up to half of it.
    [[nodiscard]] bool is_alike(const Column& residual, const Column& step) noexcept
    {
        Column again = residual;
        return solved(again) != 0 &&
               (again - step).cwiseAbs().maxCoeff() <= Scalar(Real(0.5)) * step.cwiseAbs().maxCoeff();
    }

    /// Whether det N has the sign of the branch at points on the way along d: at its half, its quarter, and so on.
    /// Folds that all lie between two of them are not seen.
    [[nodiscard]] bool keeps_sign(const M& model, const Scalar& t, const State& z, const Column& d,
                                  bool negative) noexcept
    {
        Scalar share(1);
        for (int k = points_; k > 0; --k) {
            share *= Scalar(Real(0.5));
            State between = z;
            if (!detail::move_arrow(model, t, between, Column(share * d)) || !evaluate(model, t, between)) return false;
            Column none = residual_;
            const int sign = solved(none);
            if (sign == 0 || (sign < 0) != negative) return false;
        }
        return true;
    }

    /// The sign of det N is that of the branch from now on.
    [[nodiscard]] Status settle(bool negative) noexcept
    {
        negative_ = negative;
        return Status::ok;
    }

    /// Leads mu from F^-L of the arrow that stands in z to the one in z.
    [[nodiscard]] Status lead(const M& model, const Scalar& t, State& z, bool follows) noexcept
    {
        constexpr Real shortest = Real(1e-10), folded = Real(1e3), least = std::numeric_limits<Real>::min();
        moved_.setZero();
        if (!evaluate(model, t, z)) return Status::non_finite;
        const Column way = residual_;
        Column rate = way;
        const int sign = solved(rate);
        if (sign == 0) return Status::singular_mass_matrix;
        if (follows && (sign < 0) != negative_) return Status::branch_lost;
        negative_ = sign < 0;
        const Scalar first = rate.cwiseAbs().maxCoeff();
        Status reason = Status::ok;
        Real done(0);
        for (Real part = Real(0.25); done < Real(1);) {
            const Real to = std::min(Real(1), done + part);
            State there = z;
            shift_ = Scalar(Real(1) - to) * way;
            const Column kept = moved_;
            reason = newton(model, t, there, true);
            if (reason == Status::ok) {
                z = there;
                done = to;
                part *= Real(2);
                continue;
            }
            moved_ = kept;
            part /= Real(2);
            const bool is_short =
                part < shortest && Scalar(part) * first <= Scalar(shortest) * detail::largest_part<M>(z);
            if (is_short || part < least || !(done + part > done))
                return verdict(model, t, z, way, Scalar(Real(folded)) * first, reason);
        }
        return Status::ok;
    }

    /// Of a way that goes no further: before a fold its rate grows without bound.
    [[nodiscard]] Status verdict(const M& model, const Scalar& t, const State& z, const Column& way,
                                 const Scalar& steep, Status reason) noexcept
    {
        if (reason == Status::non_finite || !evaluate(model, t, z)) return Status::non_finite;
        Column rate = way;
        if (solved(rate) == 0) return Status::no_solution;
        return rate.cwiseAbs().maxCoeff() >= steep ? Status::no_solution : Status::newton_diverged;
    }

    Column residual_, moved_ = Column::Zero(),
                      shift_ = Column::Zero(); ///< shift_: of a way that is not at its end
    Eigen::Matrix<Scalar, rank, rank> N_;
    Scalar visible_{0};        ///< what is left of momenta may not be larger, whatever terms they have
    bool negative_ = false;    ///< the sign of det N on the branch
    int points_ = most_points; ///< on the way of a first step, where det N is looked at
    std::size_t evaluations_ = 0, decompositions_ = 0;
};

} // namespace lagen
