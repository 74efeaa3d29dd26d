// SPDX-License-Identifier: MIT
/// The equations of a motion that a group moves, in the chart u = (theta, z) around a state s of it:
///   s(u) = exp(A(theta)) s in the lanes that the group moves,  z in the others
///   theta' = dexp^-1_theta(xi(t, s(u))),  z' = f(t, s(u))
/// Whatever method integrates u, s(u) stays on the orbit of s [Munthe-Kaas, BIT 38 (1998) 92].
#pragma once

#include "lagen/group/algebra_action.hpp"
#include "lagen/integrate/control.hpp"

#include <cmath>
#include <limits>

namespace lagen::detail {

template <MovesByGroup M>
class ExponentialChart {
  public:
    using Scalar = typename M::Scalar;
    static_assert(!is_pack<Scalar>, "methods on groups take one trajectory at a time");
    static constexpr int algebra_dimension = M::algebra_dimension;
    static constexpr auto free_count = static_cast<int>(free_lanes<M>.size());
    static constexpr int dimension = algebra_dimension + free_count;
    using State = Eigen::Matrix<Scalar, dimension, 1>;

    /// Puts the chart around s.
    void centre(const M& model, const typename M::State& s) noexcept
    {
        model_ = &model;
        centre_ = s;
    }

    /// u of the centre.
    [[nodiscard]] State origin() const noexcept
    {
        State u = State::Zero();
        for (int k = 0; k < free_count; ++k) u[algebra_dimension + k] = centre_[lane(k)];
        return u;
    }

    /// s(u), whose sums begin with -lost, and the rounding error of these.
    void find_state(const Scalar& t, const State& u, typename M::State& s, const typename M::State& lost,
                    typename M::State& next_lost) const noexcept
    {
        typename M::State increment;
        add_motion<false>(*model_, t, centre_, AlgebraElement<M>(u.template head<algebra_dimension>()), increment);
        increment -= lost;
        s = centre_ + increment;
        next_lost = (s - centre_) - increment;
        for (int k = 0; k < free_count; ++k) {
            s[lane(k)] = u[algebra_dimension + k];
            next_lost[lane(k)] = Scalar(0);
        }
    }

    /// branch_lost where the chart does not reach so far.
    Status rhs(const Scalar& t, const State& u, State& du) const noexcept
    {
        const AlgebraElement<M> theta = u.template head<algebra_dimension>();
        const typename M::State nothing = M::State::Zero();
        typename M::State s, ignored;
        find_state(t, u, s, nothing, ignored);
        const Status status = velocities(t, s, du);
        if (status != Status::ok) return status;
        velocities_ = du;
        AlgebraElement<M> rate;
        if (!inverse_(*model_, theta, du.template head<algebra_dimension>(), rate)) return Status::branch_lost;
        du.template head<algebra_dimension>() = rate;
        return Status::ok;
    }

    /// (xi, f) at the last state that `rhs` was asked at: the rates in the chart around that state.
    [[nodiscard]] const State& velocities() const noexcept { return velocities_; }

    /// What a small u - origin is in the lanes of the state: A(theta) s, z.
    [[nodiscard]] typename M::State in_lanes(const Scalar& t, const State& du) const noexcept
    {
        typename M::State ds =
            model_->algebra_action(t, centre_, AlgebraElement<M>(du.template head<algebra_dimension>()));
        for (int k = 0; k < free_count; ++k) ds[lane(k)] = du[algebra_dimension + k];
        return ds;
    }

    /// Errors are measured in the lanes of the state, at the centre.
    [[nodiscard]] Scalar squared_error(const ErrorScale<Scalar>& scale, const Scalar& t, const State& e) const noexcept
    {
        return detail::squared_error(scale, centre_, centre_, in_lanes(t, e));
    }

    // ---- for Newton's method, whose equations are exact, and which needs no more than a Jacobian close to theirs ----

    static constexpr auto jacobian_entries = static_cast<std::size_t>(dimension) * static_cast<std::size_t>(dimension);
    static constexpr std::array<int, jacobian_entries> jacobian_rows = [] {
        std::array<int, jacobian_entries> rows{};
        for (std::size_t k = 0; k < jacobian_entries; ++k) rows[k] = static_cast<int>(k) / dimension;
        return rows;
    }();
    static constexpr std::array<int, jacobian_entries> jacobian_columns = [] {
        std::array<int, jacobian_entries> columns{};
        for (std::size_t k = 0; k < jacobian_entries; ++k) columns[k] = static_cast<int>(k) % dimension;
        return columns;
    }();

    /// Differences of the rates, half the digits long.
    void jacobian_values(const Scalar& t, const State& u, std::array<Scalar, jacobian_entries>& values) const noexcept
    {
        using std::sqrt;
        const Scalar half = sqrt(Scalar(std::numeric_limits<Scalar>::epsilon()));
        State here, there;
        Status status = rhs(t, u, here);
        for (int column = 0; column < dimension; ++column) {
            State v = u;
            v[column] += half * size_of_unit(t, column);
            status = status == Status::ok ? rhs(t, v, there) : status;
            const Scalar length = v[column] - u[column];
            for (int row = 0; row < dimension; ++row)
                values[static_cast<std::size_t>(row * dimension + column)] =
                    status == Status::ok ? Scalar((there[row] - here[row]) / length)
                                         : std::numeric_limits<Scalar>::quiet_NaN();
        }
    }

  private:
    [[nodiscard]] static Eigen::Index lane(int k) noexcept { return free_lanes<M>[static_cast<std::size_t>(k)]; }

    Status velocities(const Scalar& t, const typename M::State& s, State& du) const noexcept
    {
        AlgebraElement<M> xi;
        Status status = model_->algebra_element(t, s, xi);
        du.template head<algebra_dimension>() = xi;
        if constexpr (free_count > 0) {
            typename M::State ds;
            if (status == Status::ok) status = model_->rhs(t, s, ds);
            for (int k = 0; k < free_count; ++k) du[algebra_dimension + k] = ds[lane(k)];
        }
        return status;
    }

    /// How far u may go in this direction until the lanes that it moves have moved by their size; 1 where they are 0.
    [[nodiscard]] Scalar size_of_unit(const Scalar& t, int column) const noexcept
    {
        const typename M::State moved = in_lanes(t, State::Unit(column));
        Scalar size(0), path(0);
        for (Eigen::Index k = 0; k < moved.size(); ++k) {
            path += size_of(moved[k]);
            if (moved[k] != Scalar(0)) size += size_of(centre_[k]);
        }
        return size > Scalar(0) && path > Scalar(0) ? Scalar(size / path) : Scalar(1);
    }

    const M* model_ = nullptr;
    typename M::State centre_;
    InverseDifferential<M> inverse_;
    mutable State velocities_;
};

} // namespace lagen::detail
