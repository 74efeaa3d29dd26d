// SPDX-License-Identifier: MIT
/// THE contract between generated headers and the runtime. A generated class satisfies `RightHandSide`; integrators ask
/// for nothing else. Kernels are noexcept, allocate nothing, and answer a typed status.
#pragma once

#include "lagen/scalar.hpp"
#include "lagen/status.hpp"

#include <Eigen/Core>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace lagen {

namespace detail {

template <class M>
concept NamesTangent = requires
{
    typename M::Tangent;
};

template <class M>
struct TangentOf {
    using type = typename M::State;
};
template <NamesTangent M>
struct TangentOf<M> {
    using type = typename M::Tangent;
};

} // namespace detail

/// The type of rates and increments of a state: an Eigen column, M::Tangent where the model names one (a state that is
/// an element of a group), else M::State.
template <class M>
using tangent_t = typename detail::TangentOf<M>::type;

namespace detail {

template <class M>
concept NamesTime = requires
{
    typename M::Time;
};

template <class M>
struct TimeOf {
    using type = real_t<typename M::Scalar>;
};
template <NamesTime M>
struct TimeOf<M> {
    using type = typename M::Time;
};

} // namespace detail

/// The type of times and steps of a model: real_t of its scalar, unless every lane of a pack has its own (M::Time).
template <class M>
using step_time_t = typename detail::TimeOf<M>::type;

/// Scalars whose copies are noexcept promise a call that is: the whole of it, its arguments by value included. Where a
/// copy may throw (derivatives on the heap), no call can promise that, and none is asked to.
template <class Scalar, bool call_is_noexcept>
concept KeepsPromise = call_is_noexcept || !std::is_nothrow_copy_constructible_v<Scalar>;

/// Of a model whose state is (x, v), as many positions as rates: x' = v, lane by lane, and v' = f(t, x, v) (general) or
/// f(t, x) (velocity_free); `no` where that is not known.
enum class SecondOrder { no, general, velocity_free };

namespace detail {

template <class M>
concept NamesSecondOrder = requires
{
    requires std::same_as<std::remove_cvref_t<decltype(M::second_order)>, SecondOrder>;
};

template <class M>
consteval SecondOrder second_order_of() noexcept
{
    if constexpr (NamesSecondOrder<M>) {
        static_assert(M::dimension < 0 || M::dimension % 2 == 0, "positions and as many rates");
        return M::second_order;
    } else {
        return SecondOrder::no;
    }
}

} // namespace detail

/// M::second_order, which generated models have where lagen proved it; `no` where the model does not name it.
template <class M>
inline constexpr SecondOrder second_order = detail::second_order_of<M>();

/// A right-hand side: M::Scalar, M::State (an Eigen column, unless there is a retraction: integrate/retract.hpp),
/// M::dimension, and
///   status_t<Scalar> rhs(Scalar t, const State& s, tangent_t<M>& ds) const noexcept.
template <class M>
concept RightHandSide = requires(const M& model, typename M::Scalar t, const typename M::State& s, tangent_t<M>& ds)
{
    requires std::convertible_to<decltype(M::dimension), int>;
    requires std::same_as<decltype(model.rhs(t, s, ds)), status_t<typename M::Scalar>>;
    requires KeepsPromise<typename M::Scalar, noexcept(model.rhs(t, s, ds))>;
};

/// A discrete motion on a Lie groupoid, by the kernels of lagen's discrete form. A state is a point x of the base, an
/// arrow from it, given by x_next - x and W - 1, inner unknowns w of its step, and the momenta of the arrow:
/// M::base_dimension, M::horizontal, M::group_order^2, M::inner_dimension and M::fibre_dimension lanes. M::cayley:
/// Cayley's map leads into the group.
///   Scalar step()                               the length of a step
///   void forward(t, s, x, mu)                   t(g) and F^+L(g)
///   void arrow_equation(t, s, R, N)             R = (mu - F^-L(g), -dL/dw), Newton's matrix
///   cayley_step(t, s, d), cayley_coordinates(t, s)   V = cay(d) - 1 of a move along the source fibre, W' = W (1 + V);
///                                               d with cay(d) = W. Where M::cayley is false instead
///   algebra_matrix(t, s, d), in_algebra(A)      the matrix A of a direction, dW = W A, and back
///   State explicit_step(t, s)                   the state behind a step; where F^-L is affine in the arrow of a pair
template <class M>
concept DiscreteMotion = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    requires std::convertible_to<decltype(M::horizontal), int>;
    requires std::convertible_to<decltype(M::group_order), int>;
    requires std::convertible_to<decltype(M::cayley), bool>;
    requires std::convertible_to<decltype(model.step()), typename M::Scalar>;
    model.momentum(t, s);
};

/// What can be integrated.
template <class M>
concept Motion = RightHandSide<M> || DiscreteMotion<M>;

/// A right-hand side that is a sum of M::flows vector fields, each with its flow: s + ds is where part k takes s in the
/// time h,
///   status_t<Scalar> flow<k>(Scalar t, const State& s, Scalar h, State& ds) const noexcept.
/// Part 0 alone may know of time.
template <class M>
concept HasFlows = requires(const M& model, typename M::Scalar t, const typename M::State& s, typename M::State& ds)
{
    requires std::convertible_to<decltype(M::flows), int>;
    requires std::same_as<decltype(model.template flow<0>(t, s, t, ds)), status_t<typename M::Scalar>>;
    requires KeepsPromise<typename M::Scalar, noexcept(model.template flow<0>(t, s, t, ds))>;
};

/// Kernels with optional parts; `count` of each is a static constexpr and its names an array of C strings.
template <class M>
concept HasEnergy = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    requires std::convertible_to<decltype(model.energy(t, s)), typename M::Scalar>;
    requires KeepsPromise<typename M::Scalar, noexcept(model.energy(t, s))>;
};

/// The rate of the energy (of Pontryagin's form: of the Hamiltonian), where it is none by itself: forces, explicit
/// time.
template <class M>
concept HasPower = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    requires std::convertible_to<decltype(model.power(t, s)), typename M::Scalar>;
    requires KeepsPromise<typename M::Scalar, noexcept(model.power(t, s))>;
};

/// Of Pontryagin's form, where the Hamiltonian is no energy.
template <class M>
concept HasHamiltonian = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    requires std::convertible_to<decltype(model.hamiltonian(t, s)), typename M::Scalar>;
    requires KeepsPromise<typename M::Scalar, noexcept(model.hamiltonian(t, s))>;
};

template <class M>
concept HasEvents = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::events_names;
    model.events(t, s);
};

/// Column k of jumps(t, s) is the state behind a jump at (t, s), that of the event jumps_names[k].
template <class M>
concept HasJumps = HasEvents<M> && requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::jumps_names;
    model.jumps(t, s);
};

template <class M>
concept HasInvariants = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::invariants_names;
    model.invariants(t, s);
};

template <class M>
concept HasObservables = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::observables_names;
    model.observables(t, s);
};

/// Parameters by number: parameter(k), k < parameter_names.size().
template <class M>
concept HasParameters = requires(M& model)
{
    M::parameter_names;
    model.parameter(std::size_t{0});
};

/// Inputs by number: input(k), k < input_names.size().
template <class M>
concept HasInputs = requires(M& model)
{
    M::input_names;
    model.input(std::size_t{0});
};

template <class M>
concept HasParameterStatus = requires(const M& model)
{
    model.parameter_status();
};

template <class M>
concept HasConstraints = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::constraints_names;
    model.constraints(t, s);
};

template <class M>
concept HasCasimirs = requires(const M& model, typename M::Scalar t, const typename M::State& s)
{
    M::casimirs_names;
    model.casimirs(t, s);
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

/// The same of a model that says at run time whether there is one, and where its entries are.
template <class M>
concept HasJacobianLater = requires(const M& model, typename M::Scalar t, const typename M::State& s,
                                    std::vector<typename M::Scalar>& values)
{
    requires std::same_as<decltype(model.has_jacobian()), bool>;
    model.jacobian_values(t, s, values);
    model.jacobian_rows().size();
    model.jacobian_columns().size();
};

/// Unknowns that are followed along a run: `follow` takes those at (t, s) as the guess of the next search.
template <class M>
concept Follows = requires(M& model, typename M::Scalar t, const typename M::State& s)
{
    {
        model.follow(t, s)
    }
    noexcept->std::same_as<status_t<typename M::Scalar>>;
};

/// A closed time interval; the end may lie before the start.
template <class Scalar>
struct Interval {
    Scalar start;
    Scalar end;
};

} // namespace lagen
