// SPDX-License-Identifier: MIT
/// Makes the C interface of lagen/compiled_model.h of a generated class. The whole source of a compiled model is
///   #include "lagen/export_model.hpp"
///   #include "model.hpp"
///   LAGEN_EXPORT_MODEL(lagen::models::NAME)
/// compiled as a shared object with EIGEN_MAX_ALIGN_BYTES=16, so that states may begin wherever malloc puts them
/// (docs/compiled_models.md). LAGEN_EXPORT_MODEL_WITH_PACKS adds the right-hand side over packs.
#pragma once

#include "lagen/compiled_model.h"
#include "lagen/integrate/retract.hpp"
#include "lagen/integrate/taylor_order.hpp"
#include "lagen/kernel.hpp"
#include "lagen/lanes/pack.hpp"
#include "lagen/lanes/packed_stages.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

namespace lagen::detail {

/// The functions behind the pointers of the C interface, of the class M over double; `packs`: those over packs too.
template <class M, bool packs>
class ModelExport {
    using State = typename M::State;
    static_assert(std::is_same_v<typename M::Scalar, double>, "a compiled model computes in double");
    static_assert(std::is_trivially_copyable_v<M> && std::is_trivially_destructible_v<M> && alignof(M) <= 64,
                  "an instance is copied byte by byte");
    static_assert(alignof(State) <= 16, "compile with EIGEN_MAX_ALIGN_BYTES=16");

  public:
    [[nodiscard]] static const lagen_compiled_model* table() noexcept
    {
        static const auto functions = list_functions();
        static const lagen_compiled_model all = describe(functions.first, functions.second);
        return &all;
    }

  private:
    static const M& model(const void* instance) noexcept { return *static_cast<const M*>(instance); }
    static const State& state(const double* s) noexcept { return *reinterpret_cast<const State*>(s); }
    static State& state(double* s) noexcept { return *reinterpret_cast<State*>(s); }
    static std::int32_t number(Status status) noexcept { return static_cast<std::int32_t>(status); }

    static void construct(void* instance) { ::new (instance) M(); }
    static std::int32_t rhs(const void* instance, double t, const double* s, double* ds)
    {
        return number(model(instance).rhs(t, state(s), state(ds)));
    }

    /// One model over packs, with the parameters of an instance.
    template <int width>
    static void rhs_of_packs(const void* instance, const double* t, const double* s, double* ds, std::uint8_t* status)
    {
        using P = Pack<double, width>;
        using Wide = typename WithScalar<M, P>::type;
        constexpr auto lanes = static_cast<std::size_t>(M::dimension);
        Wide wide;
        give_numbers(model(instance), wide, [](P& to, double from) { to = P(from); });
        typename Wide::State state, rate;
        P time;
        std::memcpy(&time, t, sizeof time);
        for (std::size_t i = 0; i < lanes; ++i)
            std::memcpy(&state[static_cast<Eigen::Index>(i)], s + i * width, sizeof time);
        const auto found = wide.rhs(time, state, rate);
        for (std::size_t i = 0; i < lanes; ++i)
            std::memcpy(ds + i * width, &rate[static_cast<Eigen::Index>(i)], sizeof time);
        for (int lane = 0; lane < width; ++lane) status[lane] = static_cast<std::uint8_t>(found[lane]);
    }

    static double* parameter(void* instance, std::int32_t k)
    {
        return &static_cast<M*>(instance)->parameter(static_cast<std::size_t>(k));
    }
    static double* input(void* instance, std::int32_t k)
    {
        return &static_cast<M*>(instance)->input(static_cast<std::size_t>(k));
    }

    template <class Names>
    static const char* const* data_of(const Names& names) noexcept
    {
        return names.data();
    }

    // ---- functions of time and state ----

    static void put(double value, double* values) noexcept { *values = value; }
    template <class Matrix>
    static void put(const Matrix& found, double* values) noexcept
    {
        for (Eigen::Index k = 0; k < found.size(); ++k) values[k] = found.data()[k];
    }

    template <class Found>
    static constexpr std::pair<std::int32_t, std::int32_t> shape_of() noexcept
    {
        if constexpr (std::is_same_v<Found, double>)
            return {1, 1};
        else
            return {static_cast<std::int32_t>(Found::RowsAtCompileTime),
                    static_cast<std::int32_t>(Found::ColsAtCompileTime)};
    }

    template <class Kernel>
    static void add(std::array<lagen_values, 16>& list, std::int32_t& count, const char* name,
                    const char* const* names) noexcept
    {
        using Found =
            std::remove_cvref_t<decltype(Kernel::of(std::declval<const M&>(), 0.0, std::declval<const State&>()))>;
        const auto [rows, columns] = shape_of<Found>();
        list[static_cast<std::size_t>(count++)] = {name, rows, columns, names,
                                                   [](const void* instance, double t, const double* s, double* values) {
                                                       put(Kernel::of(model(instance), t, state(s)), values);
                                                   }};
    }

// A kernel that the class has, with the names of its entries where it has them.
#define LAGEN_ADD_KERNEL(KERNEL, NAMES)                                                                                \
    if constexpr (requires(const M& m, const State& s) { m.KERNEL(0.0, s); }) {                                        \
        struct Kernel {                                                                                                \
            static auto of(const M& m, double t, const State& s) { return m.KERNEL(t, s); }                            \
        };                                                                                                             \
        const char* const* names = nullptr;                                                                            \
        if constexpr (requires { M::NAMES; }) names = data_of(M::NAMES);                                               \
        add<Kernel>(list, count, #KERNEL, names);                                                                      \
    }

    static std::pair<std::array<lagen_values, 16>, std::int32_t> list_functions() noexcept
    {
        std::array<lagen_values, 16> list{};
        std::int32_t count = 0;
        LAGEN_ADD_KERNEL(energy, energy_names)
        LAGEN_ADD_KERNEL(power, power_names)
        LAGEN_ADD_KERNEL(hamiltonian, hamiltonian_names)
        LAGEN_ADD_KERNEL(lagrangian, lagrangian_names)
        LAGEN_ADD_KERNEL(momentum, momentum_names)
        LAGEN_ADD_KERNEL(mass_matrix, mass_matrix_names)
        LAGEN_ADD_KERNEL(observables, observables_names)
        LAGEN_ADD_KERNEL(invariants, invariants_names)
        LAGEN_ADD_KERNEL(constraints, constraints_names)
        LAGEN_ADD_KERNEL(casimirs, casimirs_names)
        LAGEN_ADD_KERNEL(events, events_names)
        LAGEN_ADD_KERNEL(jumps, jumps_names)
        LAGEN_ADD_KERNEL(domain, domain_names)
        return {list, count};
    }
#undef LAGEN_ADD_KERNEL

    // ---- series ----

    static constexpr int highest = highest_taylor_order<double>;
    template <int count>
    using Series = TaylorSeries<double, count, highest>;

    static constexpr bool has_unit = requires(const M& m, const State& s, Series<M::dimension>& x)
    {
        m.taylor(0.0, s, 8, x, 1.0);
    };

    /// call(unit), or call() where the kernels have none.
    template <class Call>
    static std::int32_t in_units(double unit, const Call& call)
    {
        if constexpr (has_unit)
            return number(call(unit));
        else
            return number(call());
    }

    static std::int32_t motion(const void* instance, double t, const double* s, std::int32_t order, double unit,
                               double* x)
    {
        auto& series = *reinterpret_cast<Series<M::dimension>*>(x);
        return in_units(
            unit, [&](const auto&... units) { return model(instance).taylor(t, state(s), order, series, units...); });
    }

// The series of the functions of one kernel along the motion.
#define LAGEN_SERIES_ALONG(FUNCTION, KERNEL, COUNT)                                                                    \
    static std::int32_t FUNCTION(const void* instance, double t, const double* s, std::int32_t order, double unit,     \
                                 const double* x, double* e)                                                           \
    {                                                                                                                  \
        const auto& series = *reinterpret_cast<const Series<M::dimension>*>(x);                                        \
        auto& along = *reinterpret_cast<Series<COUNT<M>()>*>(e);                                                       \
        return in_units(unit, [&](const auto&... units) {                                                              \
            return model(instance).KERNEL(t, state(s), order, series, along, units...);                                \
        });                                                                                                            \
    }
    LAGEN_SERIES_ALONG(events_along, event_series, event_count)
    LAGEN_SERIES_ALONG(domain_along, domain_series, condition_count)
#undef LAGEN_SERIES_ALONG

    static void describe_series(lagen_series& series) noexcept
    {
        if constexpr (HasTaylor<M>) {
            series.highest_order = highest;
            series.has_unit = has_unit;
            if constexpr (requires { M::taylor_sums; }) series.sums = M::taylor_sums;
            series.motion = motion;
            if constexpr (HasEventSeries<M>) series.events = events_along;
            if constexpr (HasDomainSeries<M>) series.domain = domain_along;
        }
    }

    // ---- the table ----

    static void describe_jacobian(lagen_jacobian& jacobian) noexcept
    {
        if constexpr (HasJacobian<M>) {
            constexpr std::size_t count = M::jacobian_rows.size();
            static const auto places = [] {
                std::array<std::array<std::int32_t, count == 0 ? 1 : count>, 2> all{};
                for (std::size_t k = 0; k < count; ++k) {
                    all[0][k] = static_cast<std::int32_t>(M::jacobian_rows[k]);
                    all[1][k] = static_cast<std::int32_t>(M::jacobian_columns[k]);
                }
                return all;
            }();
            jacobian.count = static_cast<std::int32_t>(count);
            jacobian.rows = places[0].data();
            jacobian.columns = places[1].data();
            jacobian.values = [](const void* instance, double t, const double* s, double* entries) {
                model(instance).jacobian_values(t, state(s), *reinterpret_cast<std::array<double, count>*>(entries));
            };
        }
    }

    static lagen_compiled_model describe(const std::array<lagen_values, 16>& functions, std::int32_t count) noexcept
    {
        lagen_compiled_model all{};
        all.version = LAGEN_COMPILED_MODEL_VERSION;
        all.size = sizeof all;
        if constexpr (requires { M::model_name; }) all.name = M::model_name, all.hash = M::model_hash;
        all.dimension = M::dimension;
        if constexpr (requires { M::base_dimension; }) all.base_dimension = M::base_dimension;
        all.second_order = static_cast<std::int32_t>(second_order<M>);
        if constexpr (requires { M::state_names; }) all.state_names = data_of(M::state_names);
        all.instance_size = sizeof(M);
        all.construct = construct;
        if constexpr (HasParameters<M>)
            all.parameters = {static_cast<std::int32_t>(M::parameter_names.size()), data_of(M::parameter_names),
                              parameter};
        if constexpr (requires { M::input_names; })
            all.inputs = {static_cast<std::int32_t>(M::input_names.size()), data_of(M::input_names), input};
        if constexpr (HasParameterStatus<M>)
            all.parameter_status = [](const void* instance) { return number(model(instance).parameter_status()); };
        all.rhs = rhs;
        if constexpr (packs && TakesPacks<M>) all.rhs4 = rhs_of_packs<4>, all.rhs8 = rhs_of_packs<8>;
        if constexpr (Follows<M>)
            all.follow = [](void* instance, double t, const double* s) {
                return number(static_cast<M*>(instance)->follow(t, state(s)));
            };
        if constexpr (StaysOnGroups<M>)
            all.stay_on_groups = [](const void* instance, const double* s0, double* s1) {
                model(instance).stay_on_groups(state(s0), state(s1));
            };
        describe_jacobian(all.jacobian);
        describe_series(all.series);
        all.functions = count;
        all.function = functions.data();
        return all;
    }
};

} // namespace lagen::detail

/// The symbols of a compiled model; with packs or without.
#define LAGEN_EXPORT_SYMBOLS(MODEL, PACKS)                                                                             \
    extern "C" __attribute__((visibility("default"))) const char lagen_compiled_model_machine[] =                      \
        LAGEN_COMPILED_MODEL_MACHINE;                                                                                  \
    extern "C" __attribute__((visibility("default"))) const lagen_compiled_model* lagen_compiled_model_of(void)        \
    {                                                                                                                  \
        return lagen::detail::ModelExport<MODEL<double>, PACKS>::table();                                              \
    }
#define LAGEN_EXPORT_MODEL(MODEL) LAGEN_EXPORT_SYMBOLS(MODEL, false)
#define LAGEN_EXPORT_MODEL_WITH_PACKS(MODEL) LAGEN_EXPORT_SYMBOLS(MODEL, true)
