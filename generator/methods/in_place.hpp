// SPDX-License-Identifier: GPL-2.0-or-later
/// A compiled model of few lanes as one whose number of lanes the compiler knows. An attempt at a step of three lanes
/// takes seven tenths of the instructions, by rk4, DOP853, Radau5 or Gauss' method of order 4; of seven lanes four
/// fifths, by DOP853 all of them. (Loops over lanes that are written out for each small number of them, chosen at every
/// loop, take more instructions than the loops.)
#pragma once

#include "lagen/compiled_model.hpp"

#include <cstdint>
#include <span>

namespace lagen {

/// A compiled model of n lanes with states in place: steppers of few lanes are written out for it.
template <int n>
class InPlace {
  public:
    using Scalar = double;
    using State = Eigen::Matrix<double, n, 1>;
    static constexpr int dimension = n;

    explicit InPlace(const CompiledModel& model) : model_(model) {}
    [[nodiscard]] Eigen::Index lanes() const noexcept { return n; }
    [[nodiscard]] Status rhs(double t, const State& s, State& ds) const noexcept
    {
        return model_.rhs(t, s.data(), ds.data());
    }
    [[nodiscard]] bool takes_packs() const noexcept { return model_.takes_packs(); }
    template <int width>
    void rhs_of_packs(const double* t, const double* s, double* ds, std::uint8_t* status) const noexcept
    {
        model_.template rhs_of_packs<width>(t, s, ds, status);
    }
    [[nodiscard]] bool has_jacobian() const noexcept { return model_.has_jacobian(); }
    [[nodiscard]] auto jacobian_rows() const noexcept { return model_.jacobian_rows(); }
    [[nodiscard]] auto jacobian_columns() const noexcept { return model_.jacobian_columns(); }
    void jacobian_values(double t, const State& s, std::span<double> values) const noexcept
    {
        model_.jacobian_values(t, s.data(), values);
    }

    /// The numbers of a state, which begin at a multiple of 16 bytes, as one of these.
    static const State& in_place(const CompiledModel::State& s) noexcept
    {
        return *reinterpret_cast<const State*>(s.data());
    }
    static State& in_place(CompiledModel::State& s) noexcept { return *reinterpret_cast<State*>(s.data()); }

  private:
    const CompiledModel& model_;
};

/// A model of any number of lanes is used as it is.
template <>
class InPlace<Eigen::Dynamic> {
  public:
    static auto& in_place(auto& s) noexcept { return s; }
};

} // namespace lagen
