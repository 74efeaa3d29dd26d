// SPDX-License-Identifier: MIT
/// The equations of the stages of a collocation method and one step of Newton's method on them, for Gauss' methods and
/// Radau IIA: the Jacobian of the model, the decompositions of 1 - h lambda J for every eigenvalue lambda of the
/// method's matrix, residuals and increments. When to stop is the steppers' business.
#pragma once

#include "lagen/integrate/band_matrix.hpp"
#include "lagen/integrate/collocation.hpp"
#include "lagen/integrate/retract.hpp"
#include "lagen/kernel.hpp"
#include "lagen/lanes/lanes.hpp"

#include <cstdint>
#include <limits>
#include <span>

namespace lagen::detail {

// Where the entries of a model's Jacobian are, and the decomposition that suits the place: inside a band where that is
// narrow. A generated class tells the compiler, a model of run-time size tells at the start of a run.

template <class M>
class JacobianPattern {
    static constexpr std::size_t n = size_of_state<M>;
    static constexpr std::size_t count = M::jacobian_rows.size();
    static constexpr BandOrder<n> band = band_order<n>(M::jacobian_rows, M::jacobian_columns);

  public:
    using Values = std::array<typename M::Scalar, count>;
    template <class Entry>
    using Lu = std::conditional_t<is_narrow(band), BandLu<Entry, KnownBand<band>>, MatrixLu<Entry, n>>;

    /// Nothing has to be asked of the model.
    static Status begin(const M&, Values&) noexcept { return Status::ok; }
    static void begin(auto&) noexcept {}

    /// f(k, row, column) for every entry of the Jacobian: a short one's are written out.
    template <class Function>
    [[gnu::always_inline]] static void for_entries(const Function& f) noexcept
    {
        if constexpr (count <= 24)
            write_out<count>([&](auto k) { f(k, M::jacobian_rows[k], M::jacobian_columns[k]); });
        else
            for (std::size_t k = 0; k < count; ++k) f(k, M::jacobian_rows[k], M::jacobian_columns[k]);
    }
};

/// One of two decompositions, which is chosen at run time.
template <class Entry>
class ChosenLu {
  public:
    void begin(const BandOrder<sized_later>& band)
    {
        narrow_ = is_narrow(band);
        if (narrow_)
            inside_.begin(band);
        else
            full_.begin(band.size());
    }

    /// f(lu) with the decomposition.
    template <class Function>
    decltype(auto) visit(const Function& f) noexcept
    {
        return narrow_ ? f(inside_) : f(full_);
    }

    void solve(std::vector<Entry>& b) noexcept
    {
        visit([&](auto& lu) { lu.solve(b); });
    }

  private:
    bool narrow_ = false;
    MatrixLu<Entry, sized_later> full_;
    BandLu<Entry, BandOrder<sized_later>> inside_;
};

/// f(lu) with the decomposition itself.
template <class Lu, class Function>
[[gnu::always_inline]] inline decltype(auto) visit_lu(Lu& lu, const Function& f) noexcept
{
    if constexpr (requires { lu.visit(f); })
        return lu.visit(f);
    else
        return f(lu);
}

/// A model of run-time size may have its number of lanes from a type all the same: the matrix is a full one then.
template <HasJacobianLater M>
class JacobianPattern<M> {
    static constexpr std::size_t n = size_of_state<M>;

  public:
    using Values = std::vector<typename M::Scalar>;
    template <class Entry>
    using Lu = std::conditional_t<n == sized_later, ChosenLu<Entry>, MatrixLu<Entry, n>>;

    /// invalid_input where the model has no Jacobian.
    Status begin(const M& model, Values& values)
    {
        if (!model.has_jacobian()) return Status::invalid_input;
        rows_ = model.jacobian_rows();
        columns_ = model.jacobian_columns();
        if constexpr (n == sized_later)
            band_ = band_order(Size<sized_later>(static_cast<std::size_t>(model.lanes())), rows_, columns_);
        make_numbers(values, rows_.size(), typename M::Scalar(0));
        return Status::ok;
    }
    void begin(auto& lu) const
    {
        if constexpr (n == sized_later) lu.begin(band_);
    }

    template <class Function>
    [[gnu::always_inline]] void for_entries(const Function& f) const noexcept
    {
        for (std::size_t k = 0; k < rows_.size(); ++k) f(k, rows_[k], columns_[k]);
    }

  private:
    std::span<const std::int32_t> rows_, columns_; ///< which the model holds
    BandOrder<sized_later> band_;
};

template <class Scheme, class M>
class StageEquations {
    static_assert(!is_pack<typename M::Scalar>, "implicit methods iterate until one trajectory has converged: use them "
                                                "with a scalar, and packs with explicit fixed-step methods");
    static_assert(HasJacobian<M> || HasJacobianLater<M>,
                  "implicit methods need the exact Jacobian of the right-hand side: jacobian_values(t, s, values) with "
                  "jacobian_rows and jacobian_columns, as generated headers have them");
    static_assert(moves_by_sums<M>, "implicit methods move states by sums: use an explicit fixed-step method");

  public:
    using Real = typename M::Scalar;
    using State = typename M::State;
    static constexpr std::size_t stages = Scheme::stages, n = size_of_state<M>;
    using Stages = std::array<State, stages>;

    StageEquations() : method_(Scheme::template coefficients<Real>()), modes_(modes<Scheme, Real>(method_.c)) {}

    [[nodiscard]] const Collocation<Real, stages>& method() const noexcept { return method_; }

    /// Everything zero, with the number of lanes of `s`; invalid_input where the model has no Jacobian.
    Status begin(const M& model, const State& s) noexcept
    {
        const Status status = pattern_.begin(model, values_);
        if (status != Status::ok) return status;
        for (auto& lu : real_) pattern_.begin(lu);
        for (auto& lu : complex_) pattern_.begin(lu);
        const auto lanes = static_cast<std::size_t>(s.size());
        for (auto& w : w_real_) make_numbers(w, lanes, Real(0));
        for (auto& w : w_complex_) make_numbers(w, lanes, Complex<Real>());
        const State zero = State::Zero(s.size());
        for (State& stage : slopes) stage = zero;
        for (State& stage : residuals) stage = zero;
        x_ = zero;
        return Status::ok;
    }

    /// J at (t, s). Entries that are no numbers make the next decomposition fail.
    void linearise(const M& model, const Real& t, const State& s) noexcept { model.jacobian_values(t, s, values_); }

    /// Of the step: h = high + low, each with half the digits [Dekker 1971].
    void set_length(const Real& h) noexcept
    {
        if (h == h_) return;
        Real factor = Real(1);
        for (int k = 0; k < (std::numeric_limits<Real>::digits + 1) / 2; ++k) factor *= Real(2);
        const Real large = (factor + Real(1)) * h, rest = large - h;
        high_ = large - rest;
        low_ = h - high_;
        h_ = h;
    }

    /// Sets the length of the step and decomposes 1 - h lambda J; false where one of these matrices is singular.
    [[nodiscard]] bool factor(const Real& h) noexcept
    {
        ++decompositions;
        set_length(h);
        for (std::size_t k = 0; k < real_.size(); ++k)
            if (!factor(real_[k], Real(h * modes_.real[k].lambda))) return false;
        for (std::size_t k = 0; k < complex_.size(); ++k)
            if (!factor(complex_[k], h * modes_.complex[k].lambda)) return false;
        return true;
    }

    /// slopes_i = b_i f(t + c_i h, s - lost + z_i), residuals_i = h sum_j mu_ij slopes_j - z_i; the status of the first
    /// stage that cannot be evaluated. `lost` is the rounding error of s, small against it.
    Status evaluate(const M& model, const Real& t, const State& s, const State& lost, const Stages& z) noexcept
    {
        auto&& x = held(x_);
        auto&& from = held(s);
        auto&& less = held(lost);
        const auto& moves = held<0, stages>(z);
        for (std::size_t i = 0; i < stages; ++i) {
            for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
                store(x, lane, load<width>(from, lane) + (load<width>(moves[i], lane) - load<width>(less, lane)));
            });
            ++calls;
            const Status status = model.rhs(Real(t + method_.c[i] * h_), x_, slopes[i]);
            if (status != Status::ok) return status;
            auto&& slope = held(slopes[i]);
            for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
                store(slope, lane, method_.b[i] * load_fresh<width>(slope, lane));
            });
        }
        const auto& rates = held<0, stages>(slopes);
        write_out<stages>([&](auto i) {
            auto&& residual = held(residuals[i]);
            for_lanes(s, [&]<int width>(Width<width>, Eigen::Index lane) {
                Slice<State, width> sum = method_.mu[i][0] * load<width>(rates[0], lane);
                write_out<stages - 1>([&](auto j) { sum += method_.mu[i][j + 1] * load<width>(rates[j + 1], lane); });
                store(residual, lane, times_length(sum) - load<width>(moves[i], lane));
            });
        });
        return Status::ok;
    }

    /// Why increments are no numbers: the right-hand side was not finite, or the iteration ran away.
    [[nodiscard]] Status runaway() const noexcept
    {
        for (const State& slope : slopes)
            if (check_finite(slope) != Status::ok) return Status::non_finite;
        return Status::newton_diverged;
    }

    /// h a, without a bias: products with a step such as 0.1, close to a fraction of small denominator, are rounded up
    /// or down according to the size of `a`, and invariants then drift by 1e-4 units of the last place a step. Products
    /// with its halves are not.
    template <class Lane>
    [[nodiscard]] [[gnu::always_inline]] Lane times_length(const Lane& a) const noexcept
    {
        return high_ * a + low_ * a;
    }

    /// Turns the residuals into the increments of z.
    void solve() noexcept
    {
        ++iterations;
        for (std::size_t k = 0; k < real_.size(); ++k) {
            for_each_lane(x_, [&](Eigen::Index lane) { at(w_real_[k], lane) = project(modes_.real[k].left, lane); });
            real_[k].solve(w_real_[k]);
        }
        for (std::size_t k = 0; k < complex_.size(); ++k) {
            for_each_lane(x_,
                          [&](Eigen::Index lane) { at(w_complex_[k], lane) = project(modes_.complex[k].left, lane); });
            complex_[k].solve(w_complex_[k]);
        }
        write_out<stages>(
            [&](auto i) { for_each_lane(x_, [&](Eigen::Index lane) { residuals[i][lane] = increment(i, lane); }); });
    }

    /// Sum of the squares of the last increments, in the coordinates of the modes, in units of `scale`; where there is
    /// no increment, a scale of zero is met. (The same norm as in radau5.f.)
    [[nodiscard]] Real squared_increments(const State& scale) const noexcept
    {
        Real sum = Real(0);
        const auto add = [&](const Real& w, std::size_t lane) {
            if (w == Real(0)) return;
            const Real ratio = w / scale[static_cast<Eigen::Index>(lane)];
            sum += ratio * ratio;
        };
        for (std::size_t lane = 0; lane < lanes(); ++lane) {
            for (const auto& w : w_real_) add(w[lane], lane);
            for (const auto& w : w_complex_) {
                add(w[lane].re, lane);
                add(w[lane].im, lane);
            }
        }
        return sum;
    }

    [[nodiscard]] const Real& real_eigenvalue() const noexcept requires(Scheme::real_poles == 1)
    {
        return modes_.real[0].lambda;
    }

    /// Replaces `e` by (1 - h lambda J)^-1 e with the real eigenvalue.
    void solve_real(State& e) noexcept requires(Scheme::real_poles == 1)
    {
        for (std::size_t lane = 0; lane < lanes(); ++lane) w_real_[0][lane] = e[static_cast<Eigen::Index>(lane)];
        real_[0].solve(w_real_[0]);
        for (std::size_t lane = 0; lane < lanes(); ++lane) e[static_cast<Eigen::Index>(lane)] = w_real_[0][lane];
    }

    /// sizes_l = sum_m |J_lm| |s_m|.
    void row_sizes(const State& s, State& sizes) const noexcept
    {
        for_each_lane(sizes, [&](Eigen::Index lane) { sizes[lane] = Real(0); });
        pattern_.for_entries(
            [&](std::size_t k, auto row, auto column) { sizes[row] += magnitude(values_[k]) * magnitude(s[column]); });
    }

    Stages slopes, residuals;
    std::size_t calls = 0, iterations = 0, decompositions = 0;

  private:
    template <class Entry>
    using Lu = typename JacobianPattern<M>::template Lu<Entry>;

    [[nodiscard]] std::size_t lanes() const noexcept { return static_cast<std::size_t>(x_.size()); }

    template <class Entry>
    bool factor(Lu<Entry>& one_of_them, const Entry& scale) noexcept
    {
        return visit_lu(one_of_them, [&](auto& lu) {
            const Entry one = unit(scale);
            lu.clear();
            for (std::size_t i = 0; i < lanes(); ++i) lu(i, i) = one;
            pattern_.for_entries([&](std::size_t k, auto row, auto column) {
                Entry& entry = lu(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
                entry = entry - values_[k] * scale;
            });
            return lu.factor();
        });
    }

    static Real unit(const Real&) noexcept { return Real(1); }
    static Complex<Real> unit(const Complex<Real>&) noexcept { return {Real(1), Real(0)}; }

    template <class Entry>
    Entry project(const std::array<Entry, stages>& left, Eigen::Index lane) const noexcept
    {
        Entry sum = residuals[0][lane] * left[0];
        write_out<stages - 1>([&](auto i) { sum = sum + residuals[i + 1][lane] * left[i + 1]; });
        return sum;
    }

    [[nodiscard]] static auto& at(auto& w, Eigen::Index lane) noexcept { return w[static_cast<std::size_t>(lane)]; }

    /// The increment of stage i from what the modes have: a pair of conjugate ones counts twice, and 1/2 is the last
    /// entry of its vector.
    template <class Stage>
    [[gnu::always_inline]] Real increment(Stage i, Eigen::Index lane) noexcept
    {
        constexpr bool last = i() + 1 == stages;
        const auto part = [&](std::size_t k) {
            const Complex<Real>& v = modes_.complex[k].right[i];
            const Complex<Real>& w = at(w_complex_[k], lane);
            if constexpr (last)
                return w.re;
            else
                return Real(v.re * w.re - v.im * w.im);
        };
        if constexpr (Modes<Scheme, Real>::pairs == 0) {
            return modes_.real[0].right[i] * at(w_real_[0], lane);
        } else {
            Real sum = part(0);
            for (std::size_t k = 1; k < complex_.size(); ++k) sum += part(k);
            if constexpr (!last) sum *= Real(2);
            for (std::size_t k = 0; k < real_.size(); ++k) sum += modes_.real[k].right[i] * at(w_real_[k], lane);
            return sum;
        }
    }

    Collocation<Real, stages> method_;
    Modes<Scheme, Real> modes_;
    [[no_unique_address]] JacobianPattern<M> pattern_;
    typename JacobianPattern<M>::Values values_{};
    std::array<Lu<Real>, Modes<Scheme, Real>::reals> real_;
    std::array<Lu<Complex<Real>>, Modes<Scheme, Real>::pairs> complex_;
    std::array<Numbers<Real, n>, Modes<Scheme, Real>::reals> w_real_;
    std::array<Numbers<Complex<Real>, n>, Modes<Scheme, Real>::pairs> w_complex_;
    State x_;
    Real h_ = Real(0), high_ = Real(0), low_ = Real(0);
};

/// The collocation polynomial of a step, s + Z(theta), Z(0) = 0, Z(c_i) = Z_i: weights of the Z_i in Z(theta).
template <class Real, std::size_t stages>
void collocation_weights(const std::array<Real, stages>& c, const Real& theta,
                         std::array<Real, stages>& weights) noexcept
{
    for (std::size_t j = 0; j < stages; ++j) {
        weights[j] = theta / c[j];
        for (std::size_t m = 0; m < stages; ++m)
            if (m != j) weights[j] *= (theta - c[m]) / (c[j] - c[m]);
    }
}

} // namespace lagen::detail
