// SPDX-License-Identifier: MIT
/// THE contract between generated headers and the runtime. A generated class satisfies `RightHandSide`; integrators ask
/// for nothing else. Kernels are noexcept, allocate nothing, and answer a typed status.
#pragma once

#include "lagen/status.hpp"

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace lagen {

/// What a kernel answers for one scalar type. Scalars answer `Status`; a pack of N lanes answers a mask a lane: the
/// specialisation next to the pack type. Generated code uses only `good` and `fail`:
///   auto status = StatusOf<Scalar>::good();
///   StatusOf<Scalar>::fail(status, condition, Status::singular_mass_matrix);   // where condition (a mask) holds
/// so that no kernel branches on values.
template <class Scalar>
struct StatusOf {
    using type = Status;
    using mask = bool;
    [[nodiscard]] static constexpr type good() noexcept { return Status::ok; }
    static constexpr void fail(type& status, bool where, Status reason) noexcept
    {
        if (where && status == Status::ok) status = reason;
    }
    [[nodiscard]] static constexpr bool all_good(type status) noexcept { return status == Status::ok; }
    /// The first failure of two, a lane.
    [[nodiscard]] static constexpr type first(type earlier, type later) noexcept
    {
        return earlier == Status::ok ? later : earlier;
    }
};

template <class Scalar>
using status_t = typename StatusOf<Scalar>::type;

/// `where ? yes : no`, the branch that kernels may take: on packs a choice a lane.
template <class Scalar>
[[nodiscard]] constexpr Scalar select(bool where, const Scalar& yes, const Scalar& no) noexcept
{
    return where ? yes : no;
}

namespace detail {

/// False for NaN, a lane.
template <class Scalar>
[[nodiscard]] constexpr typename StatusOf<Scalar>::mask is_number(const Scalar& value) noexcept
{
    using Mask = typename StatusOf<Scalar>::mask;
    const Mask below = value <= Scalar(0), above = value >= Scalar(0);
    return below | above;
}

} // namespace detail

/// The type of times and steps: the scalar itself, or the type of one lane of a pack.
template <class Scalar>
struct RealOf {
    using type = Scalar;
    static constexpr int lanes = 1;
};

template <class Scalar>
using real_t = typename RealOf<Scalar>::type;

/// True where every time and step of `Scalar` is a lane of it.
template <class Scalar>
inline constexpr bool is_pack = RealOf<Scalar>::lanes != 1;

/// A right-hand side: M::Scalar, M::State (an Eigen column), M::dimension, and
///   status_t<Scalar> rhs(Scalar t, const State& s, State& ds) const noexcept.
template <class M>
concept RightHandSide = requires(const M& model, typename M::Scalar t, const typename M::State& s,
                                 typename M::State& ds)
{
    {
        M::dimension
        } -> std::convertible_to<int>;
    {
        model.rhs(t, s, ds)
    }
    noexcept->std::same_as<status_t<typename M::Scalar>>;
};

/// Kernels with optional parts; `count` of each is a static constexpr and its names an array of C strings.
template <class M>
concept HasEnergy = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    {
        model.energy(t, s)
    }
    noexcept->std::convertible_to<typename M::Scalar>;
};

/// Of Pontryagin's form, where the Hamiltonian is no energy.
template <class M>
concept HasHamiltonian = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    {
        model.hamiltonian(t, s)
    }
    noexcept->std::convertible_to<typename M::Scalar>;
};

template <class M>
concept HasEvents = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::events_names;
    model.events(t, s);
};

template <class M>
concept HasConstraints = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    model.constraints(t, s);
};

/// Strict inequalities of the domain as values that must be positive (a != b: its square).
template <class M>
concept HasDomain = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    model.domain(t, s);
};

/// Sparse Jacobian of the right-hand side: values with constexpr row and column arrays.
template <class M>
concept HasJacobian = requires(const M& model, typename M::Scalar t, const typename M::State& s,
                               std::array<typename M::Scalar, M::jacobian_rows.size()>& values)
{
    model.jacobian_values(t, s, values);
    M::jacobian_columns;
};

/// A closed time interval; the end may lie before the start.
template <class Scalar>
struct Interval {
    Scalar start;
    Scalar end;
};

} // namespace lagen
