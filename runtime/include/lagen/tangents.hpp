// SPDX-License-Identifier: MIT
/// A system together with its variational equations: integrating it carries tangent vectors along a trajectory, for
/// sensitivities, Lyapunov exponents and shooting.
///   ds/dt = rhs(t, s),   dV/dt = (d rhs / d s)(t, s) V
#pragma once

#include "lagen/kernel.hpp"

namespace lagen {

namespace detail {

/// The name lists of M, where it has them: what asks a model for its events or observables asks for these.
/// Headers without parameters name none, and have no parameter(k).
template <class M>
concept NamesParameters = requires
{
    M::parameter_names;
};

template <class M>
struct EventNames {
};
template <HasEvents M>
struct EventNames<M> {
    static constexpr auto events_names = M::events_names;
};

template <class M>
struct ConstraintNames {
};
template <HasConstraints M>
struct ConstraintNames<M> {
    static constexpr auto constraints_names = M::constraints_names;
};

template <class M>
struct CasimirNames {
};
template <HasCasimirs M>
struct CasimirNames<M> {
    static constexpr auto casimirs_names = M::casimirs_names;
};

template <class M>
struct InvariantNames {
};
template <HasInvariants M>
struct InvariantNames<M> {
    static constexpr auto invariants_names = M::invariants_names;
};

template <class M>
struct ObservableNames {
};
template <HasObservables M>
struct ObservableNames<M> {
    static constexpr auto observables_names = M::observables_names;
};

template <class M>
struct ParameterNames {
};
template <NamesParameters M>
struct ParameterNames<M> {
    static constexpr auto parameter_names = M::parameter_names;
};

} // namespace detail

/// A right-hand side of dimension M::dimension * (1 + K): s, then K tangent vectors one after the other. M needs the
/// kernel `variational` (`lagen generate --only rhs,variational`). Parameters, domain, events, energy and what else a
/// run asks of a model are those of M at s. Its Jacobian would need second derivatives: it is left out, and implicit
/// methods with it.
template <class M, int K>
struct WithTangents : detail::EventNames<M>,
                      detail::ConstraintNames<M>,
                      detail::CasimirNames<M>,
                      detail::InvariantNames<M>,
                      detail::ObservableNames<M>,
                      detail::ParameterNames<M> {
    using Scalar = typename M::Scalar;
    static constexpr int dimension = M::dimension * (1 + K);
    using State = Eigen::Matrix<Scalar, dimension, 1>;
    using Point = typename M::State;

    M model{};

    WithTangents() = default;
    WithTangents(const M& base) : model(base) {}

    /// s with tangents V, shape (M::dimension, K).
    [[nodiscard]] static State state(const Point& s, const Eigen::Matrix<Scalar, M::dimension, K>& V) noexcept
    {
        State all;
        all.template head<M::dimension>() = s;
        for (int k = 0; k < K; ++k) all.template segment<M::dimension>(M::dimension * (1 + k)) = V.col(k);
        return all;
    }

    /// s of a state.
    [[nodiscard]] static Point point(const State& all) noexcept { return all.template head<M::dimension>(); }

    /// The tangents of a state, shape (M::dimension, K).
    [[nodiscard]] static Eigen::Matrix<Scalar, M::dimension, K> tangents(const State& all) noexcept
    {
        Eigen::Matrix<Scalar, M::dimension, K> V;
        for (int k = 0; k < K; ++k) V.col(k) = all.template segment<M::dimension>(M::dimension * (1 + k));
        return V;
    }

    [[nodiscard]] status_t<Scalar> rhs(Scalar t, const State& all, State& derivative) const noexcept
    {
        const Point s = point(all);
        Point ds;
        auto status = model.rhs(t, s, ds);
        derivative.template head<M::dimension>() = ds;
        for (int k = 0; k < K; ++k) {
            const Point v = all.template segment<M::dimension>(M::dimension * (1 + k));
            Point dv;
            status = StatusOf<Scalar>::first(status, model.variational(t, s, v, dv));
            derivative.template segment<M::dimension>(M::dimension * (1 + k)) = dv;
        }
        return status;
    }

    [[nodiscard]] auto& parameter(std::size_t k) noexcept requires HasParameters<M> { return model.parameter(k); }
    [[nodiscard]] auto parameter_status() const noexcept requires HasParameterStatus<M>
    {
        return model.parameter_status();
    }
    [[nodiscard]] auto follow(Scalar t, const State& all) noexcept requires Follows<M>
    {
        return model.follow(t, point(all));
    }
    [[nodiscard]] auto domain(Scalar t, const State& all) const noexcept requires HasDomain<M>
    {
        return model.domain(t, point(all));
    }
    [[nodiscard]] auto events(Scalar t, const State& all) const noexcept requires HasEvents<M>
    {
        return model.events(t, point(all));
    }
    [[nodiscard]] Scalar energy(Scalar t, const State& all) const noexcept requires HasEnergy<M>
    {
        return model.energy(t, point(all));
    }
    [[nodiscard]] Scalar hamiltonian(Scalar t, const State& all) const noexcept requires HasHamiltonian<M>
    {
        return model.hamiltonian(t, point(all));
    }
    [[nodiscard]] auto constraints(Scalar t, const State& all) const noexcept requires HasConstraints<M>
    {
        return model.constraints(t, point(all));
    }
    [[nodiscard]] auto casimirs(Scalar t, const State& all) const noexcept requires HasCasimirs<M>
    {
        return model.casimirs(t, point(all));
    }
    [[nodiscard]] auto invariants(Scalar t, const State& all) const noexcept requires HasInvariants<M>
    {
        return model.invariants(t, point(all));
    }
    [[nodiscard]] auto observables(Scalar t, const State& all) const noexcept requires HasObservables<M>
    {
        return model.observables(t, point(all));
    }
};

} // namespace lagen
