// SPDX-License-Identifier: MIT
/// Motions along the orbits of a Lie group that acts linearly on lanes of the state:
///   s' = A(xi) s,  A(xi) = xi^a A_a,  xi = xi(t, s)     in the lanes that the group moves
///   s' = f(t, s)                                         in the others
/// so that s(t) = exp(A(theta)) s(0) there, with theta(t) in the Lie algebra. Elements of the algebra are columns of
/// their components; [A(u), A(v)] = -A([u, v]), as of right actions and of coadjoint motions.
#pragma once

#include "lagen/kernel.hpp"

#include <array>
#include <cstddef>

namespace lagen {

template <class M>
using AlgebraElement = Eigen::Matrix<typename M::Scalar, M::algebra_dimension, 1>;

/// A model that says how a group moves its state:
///   algebra_element(t, s, xi)     writes xi and answers a status
///   algebra_action(t, s, xi)      A(xi) s; 0 in the lanes that the group does not move, and free of them and of t
///   algebra_bracket(u, v)         [u, v]
/// M::algebra_dimension, and M::moved_by_group, which says of every lane whether the group moves it.
template <class M>
concept MovesByGroup = requires(const M& model, typename M::Scalar t, const typename M::State& s, AlgebraElement<M>& xi)
{
    M::moved_by_group[0];
    requires std::same_as<decltype(model.algebra_element(t, s, xi)), status_t<typename M::Scalar>>;
    model.algebra_action(t, s, xi);
    model.algebra_bracket(xi, xi);
};

namespace detail {

template <MovesByGroup M>
consteval std::size_t count_moved() noexcept
{
    std::size_t count = 0;
    for (const bool moved : M::moved_by_group) count += moved ? 1 : 0;
    return count;
}

/// The lanes that the group does not move, in their order.
template <MovesByGroup M>
inline constexpr auto free_lanes = [] {
    std::array<Eigen::Index, M::moved_by_group.size() - count_moved<M>()> lanes{};
    std::size_t next = 0;
    for (std::size_t k = 0; k < M::moved_by_group.size(); ++k)
        if (!M::moved_by_group[k]) lanes[next++] = static_cast<Eigen::Index>(k);
    return lanes;
}();

/// Where the group takes s, less s: sum_k A(xi)^k s / k! from k = 1 on. With `mean` the mean of exp(tau A(xi)) s over
/// 0 < tau < 1, less s: sum_k A(xi)^k s / (k + 1)!.
template <bool mean, MovesByGroup M>
void add_motion(const M& model, const typename M::Scalar& t, const typename M::State& s, const AlgebraElement<M>& xi,
                typename M::State& increment) noexcept
{
    using S = typename M::Scalar;
    using State = typename M::State;
    constexpr int most_terms = 100; // of steps that turn by less than a circle some thirty are needed
    State term = model.algebra_action(t, s, xi);
    increment = mean ? State(term / S(2)) : term;
    for (int k = 2; k <= most_terms; ++k) {
        term = model.algebra_action(t, term, xi) / S(k);
        const State sum = increment + (mean ? State(term / S(k + 1)) : term);
        if (sum == increment) break;
        increment = sum;
    }
}

/// The inverse of the differential of the exponential map: with T = exp(A(theta)), T' = A(xi) T where
///   theta' = xi + [theta, xi]/2 + sum_j B_2j/(2j)! ad_theta^2j xi                  [Iserles et al. 2000, 2.4]
/// Of eigenvalues of ad_theta below 2 pi the series converges.
template <MovesByGroup M>
class InverseDifferential {
  public:
    using S = typename M::Scalar;

    /// Of c_j = B_2j/(2j)!: (2j + 1) c_j = -sum_k c_k c_(j-k), 0 < k < j [Euler]; all terms have one sign.
    InverseDifferential() noexcept
    {
        c_[0] = S(1) / S(12);
        for (std::size_t j = 2; j <= terms; ++j) {
            S sum(0);
            for (std::size_t k = 1; k < j; ++k) sum += c_[k - 1] * c_[j - k - 1];
            c_[j - 1] = -sum / S(static_cast<int>(2 * j + 1));
        }
    }

    /// False where so many terms do not reach rounding, of a step that turns by more than 2.5 or so.
    [[nodiscard]] bool operator()(const M& model, const AlgebraElement<M>& theta, const AlgebraElement<M>& xi,
                                  AlgebraElement<M>& rate) const noexcept
    {
        AlgebraElement<M> power = model.algebra_bracket(theta, xi);
        rate = xi + power / S(2);
        for (const S& c : c_) {
            power = model.algebra_bracket(theta, power);
            const AlgebraElement<M> sum = rate + c * power;
            if (sum == rate) return true;
            rate = sum;
            power = model.algebra_bracket(theta, power);
        }
        return false;
    }

  private:
    static constexpr std::size_t terms = 20;
    std::array<S, terms> c_;
};

} // namespace detail

} // namespace lagen
