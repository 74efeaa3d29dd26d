// SPDX-License-Identifier: MIT
/// The stages of a collocation method as the lanes of packs: one call of the right-hand side evaluates all of them, and
/// the sums over the stages are products with packs [Antonana, Makazaga, Murua, arXiv 2511.03655]. What stage_equations
/// does of one stage after another is done here of one lane of the state after another.
#pragma once

#include "lagen/integrate/collocation.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/lanes/lanes.hpp"
#include "lagen/lanes/pack.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace lagen::detail {

template <class M, class S>
struct WithScalar {
};
template <template <class> class Model, class T, class S>
struct WithScalar<Model<T>, S> {
    using type = Model<S>;
};

/// Bytes of the parameters and inputs of a model, in its order; a header without parameters has an empty struct of
/// them.
template <class M>
[[nodiscard]] consteval std::size_t size_of_numbers() noexcept
{
    if constexpr (HasInputs<M>) {
        struct Numbers {
            decltype(M::parameters) parameters;
            decltype(M::inputs) inputs;
        };
        return sizeof(Numbers);
    } else {
        return sizeof(M::parameters);
    }
}

/// Nothing but parameters and inputs, which a model of another scalar can be given, where it has any.
template <class M>
concept HoldsNumbers = std::is_empty_v<M> || requires
{
    requires HasParameters<M> || std::is_empty_v<decltype(M::parameters)>;
    requires sizeof(M) == size_of_numbers<M>();
};

/// Every parameter and input of `from`, as put(of to, of from).
template <class From, class To, class Put>
void give_numbers(From from, To& to, const Put& put) noexcept
{
    if constexpr (HasParameters<From>)
        for (std::size_t k = 0; k < From::parameter_names.size(); ++k) put(to.parameter(k), from.parameter(k));
    if constexpr (HasInputs<From>)
        for (std::size_t k = 0; k < From::input_names.size(); ++k) put(to.input(k), from.input(k));
}

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
                      std::is_same_v<typename M::Scalar, float>)&&SaysPacks<M>&& HoldsNumbers<M> &&
                     !Follows<M> && moves_by_sums<M> && requires
{
    typename WithScalar<M, float>::type;
};

/// A model that says at run time whether it can be had over packs.
template <class M>
concept OffersPacks = requires(const M& model, const double* t, double* ds, std::uint8_t* status)
{
    requires std::same_as<decltype(model.takes_packs()), bool>;
    model.template rhs_of_packs<4>(t, t, ds, status);
};

/// A model as a right-hand side over packs, with the parameters that it has at the start.
template <class M, class P>
class PackedModel {
    using Model = typename WithScalar<M, P>::type;

  public:
    using Lanes = typename Model::State;

    void begin(const M& model) noexcept
    {
        give_numbers(model, model_, [](P& to, const typename M::Scalar& from) { to = P(from); });
    }
    static constexpr bool is_offered() noexcept { return true; }

    /// False where one of the first `count` lanes cannot be evaluated.
    bool rhs(const M&, const P& t, const Lanes& x, Lanes& slopes, std::size_t count) const noexcept
    {
        const auto status = model_.rhs(t, x, slopes);
        for (std::size_t i = 0; i < count; ++i)
            if (status.lanes[i] != Status::ok) return false;
        return true;
    }

  private:
    Model model_{};
};

template <OffersPacks M, class P>
class PackedModel<M, P> {
    static constexpr int width = RealOf<P>::lanes;

  public:
    using Lanes = Eigen::Matrix<P, Eigen::Dynamic, 1>;

    void begin(const M& model) noexcept { offered_ = model.takes_packs(); }
    [[nodiscard]] bool is_offered() const noexcept { return offered_; }

    bool rhs(const M& model, const P& t, const Lanes& x, Lanes& slopes, std::size_t count) const noexcept
    {
        std::array<std::uint8_t, static_cast<std::size_t>(width)> status{};
        const auto numbers = [](auto* pack) { return reinterpret_cast<const double*>(pack); };
        model.template rhs_of_packs<width>(numbers(&t), numbers(x.data()), reinterpret_cast<double*>(slopes.data()),
                                           status.data());
        return std::all_of(status.begin(), status.begin() + static_cast<std::ptrdiff_t>(count),
                           [](std::uint8_t each) { return each == 0; });
    }

  private:
    bool offered_ = false;
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
        model_.begin(model);
        z_ = x_ = slopes_ = Lanes::Zero(lanes);
    }

    [[nodiscard]] bool is_offered() const noexcept { return model_.is_offered(); }

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
    bool evaluate(const M& model, const Real& t, const Real& h, const State& state, const State& lost) noexcept
    {
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) x_[lane] = P(state[lane]) + (z_[lane] - P(lost[lane]));
        if (!model_.rhs(model, P(t) + c_ * P(h), x_, slopes_, s)) return false;
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) slopes_[lane] *= b_;
        return true;
    }

    /// z_i = h sum_j mu_ij slopes_j; answers the largest relative increment, no number where an increment is none.
    template <class Convergence, class TimesLength>
    Real move(Convergence& convergence, const TimesLength& times_length) noexcept
    {
        Real most = Real(0);
        Vector all{};
        for (Eigen::Index lane = 0; lane < z_.size(); ++lane) {
            const P& slopes = slopes_[lane];
            Vector step{}, reach{};
            write_out<parts>([&](auto k) {
                Vector sum = part(mu_[0], k) * slopes[0];
                write_out<s - 1>([&](auto j) { sum += part(mu_[j + 1], k) * slopes[static_cast<int>(j + 1)]; });
                const Vector moved = times_length(sum), increment = moved - part(z_[lane], k);
                put(z_[lane], k, moved);
                all += increment;
                const Vector size = absolute(increment), far = absolute(moved);
                step = size > step ? size : step;
                reach = far > reach ? far : reach;
            });
            most = std::max(most, convergence.template note<1>(lane, largest(step), largest(reach)));
        }
        Real total = all[0];
        for (int i = 1; i < held; ++i) total += all[i];
        return most + (total - total);
    }

  private:
    /// Stage i of lane l of the state is lane i of entry l; lanes that are no stages have weight 0.
    using Lanes = typename PackedModel<M, P>::Lanes;

    // What a register holds: a compiler keeps longer vectors in memory.
#if defined(__AVX512F__)
    static constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
    static constexpr std::size_t register_bytes = 32;
#else
    static constexpr std::size_t register_bytes = 16;
#endif
    static constexpr int held = std::min(width, static_cast<int>(register_bytes / sizeof(Real)));
    static constexpr std::size_t parts = width / held;
    using Vector = typename VectorOf<Real, held>::type;
    using Bits = typename Mask<Real, held>::Vector;

    static Vector part(const P& pack, std::size_t k) noexcept
    {
        Vector vector;
        std::memcpy(&vector, reinterpret_cast<const char*>(&pack.lanes) + k * sizeof vector, sizeof vector);
        return vector;
    }
    static void put(P& pack, std::size_t k, const Vector& vector) noexcept
    {
        std::memcpy(reinterpret_cast<char*>(&pack.lanes) + k * sizeof vector, &vector, sizeof vector);
    }
    static Vector absolute(const Vector& x) noexcept
    {
        return reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & ~reinterpret_cast<Bits>(-Vector{}));
    }
    static Real largest(const Vector& x) noexcept
    {
        Real most = x[0];
        for (int i = 1; i < held; ++i) most = x[i] > most ? x[i] : most;
        return most;
    }

    PackedModel<M, P> model_;
    P c_{}, b_{};
    std::array<P, s> mu_{}; ///< mu_ij is lane i of entry j
    Lanes z_, x_, slopes_;
};

} // namespace lagen::detail
