// SPDX-License-Identifier: MIT
/// Where the entries of a model's Jacobian are, and the decomposition that suits the place: inside a band where that is
/// narrow. A generated class tells the compiler, a model of run-time size tells at the start of a run.
#pragma once

#include "lagen/integrate/band_matrix.hpp"
#include "lagen/kernel.hpp"

#include <cstdint>
#include <span>

namespace lagen::detail {

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

} // namespace lagen::detail
