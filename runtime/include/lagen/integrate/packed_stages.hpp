// SPDX-License-Identifier: MIT
/// The stages of a collocation method as the lanes of packs: one call of the right-hand side evaluates all of them, and
/// the sums over the stages are products with packs [Antonana, Makazaga, Murua, arXiv 2511.03655]. What stage_equations
/// does of one stage after another is done here of one lane of the state after another.
#pragma once

#include "lagen/ensemble/pack.hpp"
#include "lagen/integrate/collocation.hpp"
#include "lagen/integrate/lanes.hpp"
#include "lagen/integrate/retract.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>

namespace lagen::detail {

template <class M, class S>
struct WithScalar {
};
template <template <class> class Model, class T, class S>
struct WithScalar<Model<T>, S> {
    using type = Model<S>;
};

/// Nothing but parameters, which a model of another scalar can be given.
template <class M>
concept HoldsParameters = std::is_empty_v<M> || requires(M& model)
{
    requires HasParameters<M>;
    requires sizeof(M) == sizeof(model.parameters);
};

template <class M>
concept SaysPacks = requires
{
    M::model_hash;
}
|| requires
{
    M::takes_packs;
};

/// A model over float or double that can be had over packs: a generated one, or one that says so by a member
/// `takes_packs`.
template <class M>
concept TakesPacks = (std::is_same_v<typename M::Scalar, double> ||
                      std::is_same_v<typename M::Scalar, float>)&&SaysPacks<M>&& HoldsParameters<M> &&
                     !Follows<M> && moves_by_sums<M> && requires
{
    typename WithScalar<M, float>::type;
};

/// In the place of PackedStages where there are none.
struct NoPacks {
    template <class Method>
    explicit NoPacks(const Method&) noexcept
    {
    }
};

/// The stages of a method with these coefficients on the model M.
template <std::size_t s, class M>
class PackedStages {
  public:
    using Real = typename M::Scalar;
    static constexpr int width = static_cast<int>(std::bit_ceil(s));
    using P = Pack<Real, width>;
    using Model = typename WithScalar<M, P>::type;
    using State = typename M::State;

    explicit PackedStages(const Collocation<Real, s>& method) noexcept
    {
        for (std::size_t j = 0; j < s; ++j) {
            c_.set(static_cast<int>(j), method.c[j]);
            b_.set(static_cast<int>(j), method.b[j]);
            for (std::size_t i = 0; i < s; ++i) mu_[j].set(static_cast<int>(i), method.mu[i][j]);
        }
    }

    /// Takes the parameters of `model`, and the number of lanes of a state.
    void begin(const M& model, Eigen::Index lanes) noexcept
    {
        if constexpr (!std::is_empty_v<M>) {
            M copy = model;
            for (std::size_t k = 0; k < M::parameter_names.size(); ++k) model_.parameter(k) = P(copy.parameter(k));
        }
        z_ = x_ = slopes_ = Lanes::Zero(lanes);
    }

    void load(const std::array<State, s>& z) noexcept
    {
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane)
            for (std::size_t i = 0; i < s; ++i) z_[lane].set(static_cast<int>(i), z[i][lane]);
    }

    void unload(std::array<State, s>& z, std::array<State, s>& slopes) const noexcept
    {
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane)
            for (std::size_t i = 0; i < s; ++i) {
                z[i][lane] = z_[lane][static_cast<int>(i)];
                slopes[i][lane] = slopes_[lane][static_cast<int>(i)];
            }
    }

    /// slopes_i = b_i f(t + c_i h, s - lost + z_i); false where a stage cannot be evaluated.
    bool evaluate(const Real& t, const Real& h, const State& state, const State& lost) noexcept
    {
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) x_[lane] = P(state[lane]) + (z_[lane] - P(lost[lane]));
        const auto status = model_.rhs(P(t) + c_ * P(h), x_, slopes_);
        for (std::size_t i = 0; i < s; ++i)
            if (status.lanes[i] != Status::ok) return false;
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) slopes_[lane] *= b_;
        return true;
    }

    /// z_i = h sum_j mu_ij slopes_j; answers the largest relative increment, no number where an increment is none.
    template <class Convergence, class TimesLength>
    Real move(Convergence& convergence, const TimesLength& times_length) noexcept
    {
        Real most = Real(0);
        P sum = P(Real(0));
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) {
            P integral = mu_[0] * P(slopes_[lane][0]);
            for (std::size_t j = 1; j < s; ++j) integral += mu_[j] * P(slopes_[lane][static_cast<int>(j)]);
            const P moved = times_length(integral), increment = moved - z_[lane];
            z_[lane] = moved;
            sum += increment;
            most = std::max(most, convergence.template note<1>(lane, largest_of(increment), largest_of(moved)));
        }
        Real total = sum[0];
        for (int i = 1; i < width; ++i) total += sum[i];
        return most + (total - total);
    }

  private:
    /// Stage i of lane l of the state is lane i of entry l; lanes that are no stages have weight 0.
    using Lanes = typename Model::State;

    /// The largest |x_i|.
    static Real largest_of(const P& x) noexcept
    {
        const P size = select(x < P(Real(0)), -x, x);
        Real most = size[0];
        for (int i = 1; i < width; ++i) most = size[i] > most ? size[i] : most;
        return most;
    }

    Model model_{};
    P c_, b_;
    std::array<P, s> mu_{}; ///< mu_ij is lane i of entry j
    Lanes z_, x_, slopes_;
};

} // namespace lagen::detail
