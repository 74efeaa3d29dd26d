// SPDX-License-Identifier: MIT
/// What a scene asks of a model: of a generated class what the compiler knows, of lagen::CompiledModel what is known at
/// run time.
#pragma once

#include "lagen/compiled_model.hpp"
#include "lagen/integrate/follow.hpp"
#include "lagen/kernel.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>

namespace lagen::detail {

using Names = std::span<const char* const>;

template <class M>
inline constexpr bool is_compiled_model = std::is_same_v<M, CompiledModel>;

template <class M>
[[nodiscard]] Eigen::Index lane_count([[maybe_unused]] const M& model) noexcept
{
    if constexpr (is_compiled_model<M>)
        return model.lanes();
    else
        return M::dimension;
}

// The names of a group of numbers or functions of the class M, none where it has none; of a compiled model COMPILED.
#define LAGEN_NAMES_OF(FUNCTION, MEMBER, COMPILED)                                                                     \
    template <class M>                                                                                                 \
    [[nodiscard]] Names FUNCTION([[maybe_unused]] const M& model) noexcept                                             \
    {                                                                                                                  \
        if constexpr (is_compiled_model<M>)                                                                            \
            return COMPILED;                                                                                           \
        else if constexpr (requires { M::MEMBER.size(); })                                                             \
            return {M::MEMBER.data(), M::MEMBER.size()};                                                               \
        else                                                                                                           \
            return {};                                                                                                 \
    }
LAGEN_NAMES_OF(parameters_of, parameter_names, model.parameter_names())
LAGEN_NAMES_OF(inputs_of, input_names, model.input_names())
LAGEN_NAMES_OF(events_of, events_names, model.events_names)
LAGEN_NAMES_OF(jumps_of, jumps_names, model.jumps_names)
LAGEN_NAMES_OF(observables_of, observables_names, model.observables_names)
LAGEN_NAMES_OF(invariants_of, invariants_names, model.invariants_names)
LAGEN_NAMES_OF(constraints_of, constraints_names, model.constraints_names)
LAGEN_NAMES_OF(casimirs_of, casimirs_names, model.casimirs_names)
#undef LAGEN_NAMES_OF

template <class M>
void set_parameter(M& model, std::size_t k, double value)
{
    if constexpr (is_compiled_model<M>)
        model.set_parameter(k, value);
    else if constexpr (HasParameters<M>)
        model.parameter(k) = value;
}

template <class M>
void set_input(M& model, std::size_t k, double value)
{
    if constexpr (is_compiled_model<M>)
        model.set_input(k, value);
    else if constexpr (requires { model.input(k); })
        model.input(k) = value;
}

/// The model of a run, or a copy of it that learns along the rows what it follows. The run may set its inputs.
template <class M>
class ObservedModel {
  public:
    explicit ObservedModel(const M& model) : model_(&model)
    {
        if (follows(model)) copy_.emplace(model);
    }
    [[nodiscard]] const M& operator*() const noexcept { return copy_ ? *copy_ : *model_; }

    /// A failure is the run's affair.
    void follow([[maybe_unused]] double t, [[maybe_unused]] const typename M::State& s) noexcept
    {
        if constexpr (Follows<M>)
            if (copy_) static_cast<void>(copy_->follow(t, s));
    }
    void hold_input(std::size_t k, double value)
    {
        if (copy_) set_input(*copy_, k, value);
    }

  private:
    const M* model_;
    std::optional<M> copy_;
};

/// Has it this kernel? HasEnergy and its like are true of every compiled model.
template <class M>
[[nodiscard]] bool has_energy([[maybe_unused]] const M& model) noexcept
{
    if constexpr (is_compiled_model<M>) return model.has(CompiledModel::Function::energy);
    return HasEnergy<M>;
}
template <class M>
[[nodiscard]] bool has_hamiltonian([[maybe_unused]] const M& model) noexcept
{
    if constexpr (is_compiled_model<M>) return model.has(CompiledModel::Function::hamiltonian);
    return HasHamiltonian<M>;
}
template <class M>
[[nodiscard]] bool has_power([[maybe_unused]] const M& model) noexcept
{
    if constexpr (is_compiled_model<M>) return model.has(CompiledModel::Function::power);
    return HasPower<M>;
}

} // namespace lagen::detail
