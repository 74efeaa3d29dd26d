// SPDX-License-Identifier: MIT
/// `lagen::CompiledModel`: a model that was compiled as a shared object (lagen/compiled_model.h), loaded into the
/// process as a model whose number of lanes is known at run time:
///   auto [status, top] = lagen::CompiledModel::load("heavy_top.so");
///   if (status != lagen::LoadStatus::ok) ..
///   top.set_parameter(3, 9.81);   // parameter_names()[3]
///   auto run = lagen::integrate(top, s, {0.0, 10.0}, lagen::Dop853{.tolerance = 1e-10});
/// It satisfies the kernel contract with dimension = Eigen::Dynamic. Memory is taken when it is loaded or copied; a
/// kernel takes none. Kernels of one object may use the same scratch, so every thread needs a copy of its own.
/// A model may come in several parts, each a shared object with some of the kernels: the first has the right-hand side.
#pragma once

#include "lagen/requirements.hpp"

#include "lagen/compiled_model.h"
#include "lagen/kernel.hpp"
#include "lagen/loaded_library.hpp"
#include "lagen/series.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lagen {

namespace detail {

/// Bytes of an instance, at a multiple of 64.
class InstanceBytes {
  public:
    explicit InstanceBytes(const lagen_compiled_model& table) : size_((table.instance_size + 63) / 64 * 64)
    {
        bytes_.reset(static_cast<std::byte*>(::operator new(size_, std::align_val_t(64))));
        table.construct(bytes_.get());
    }
    InstanceBytes(const InstanceBytes& other) : size_(other.size_)
    {
        bytes_.reset(static_cast<std::byte*>(::operator new(size_, std::align_val_t(64))));
        std::memcpy(bytes_.get(), other.bytes_.get(), size_);
    }
    InstanceBytes(InstanceBytes&&) noexcept = default;
    InstanceBytes& operator=(const InstanceBytes&) = delete;
    InstanceBytes& operator=(InstanceBytes&&) noexcept = default;
    ~InstanceBytes() = default;

    [[nodiscard]] std::byte* get() noexcept { return bytes_.get(); }
    [[nodiscard]] const std::byte* get() const noexcept { return bytes_.get(); }

  private:
    struct Free {
        void operator()(std::byte* bytes) const noexcept { ::operator delete(bytes, std::align_val_t(64)); }
    };
    std::size_t size_;
    std::unique_ptr<std::byte, Free> bytes_;
};

} // namespace detail

class CompiledModel {
  public:
    using Scalar = double;
    using State = Eigen::VectorXd;
    using Values = Eigen::Map<const Eigen::VectorXd>; ///< until the same kernel is asked again
    static constexpr int dimension = Eigen::Dynamic;
    static constexpr SecondOrder second_order = SecondOrder::velocity_free; ///< at most: order_of_system() tells

    /// The kernels that are functions of time and state.
    enum class Function {
        energy,
        power,
        hamiltonian,
        lagrangian,
        momentum,
        mass_matrix,
        observables,
        invariants,
        constraints,
        casimirs,
        events,
        jumps,
        domain
    };

    struct Loaded;
    /// Loads one object, or the parts of a model. A model that was not loaded has no lanes.
    [[nodiscard]] static Loaded load(const std::string& path);
    [[nodiscard]] static Loaded load(const std::vector<std::string>& paths);

    CompiledModel() = default;
    CompiledModel(const CompiledModel& other) : parts_(other.parts_) { look_up(); }
    CompiledModel(CompiledModel&&) noexcept = default;
    CompiledModel& operator=(const CompiledModel& other) { return *this = CompiledModel(other); }
    CompiledModel& operator=(CompiledModel&&) noexcept = default;
    ~CompiledModel() = default;

    [[nodiscard]] Eigen::Index lanes() const noexcept { return lanes_; }
    [[nodiscard]] Eigen::Index base_lanes() const noexcept { return parts_.front().table->base_dimension; }
    [[nodiscard]] SecondOrder order_of_system() const noexcept
    {
        return static_cast<SecondOrder>(parts_.front().table->second_order);
    }
    [[nodiscard]] const char* name() const noexcept { return parts_.front().table->name; }
    [[nodiscard]] std::span<const char* const> state_names() const noexcept
    {
        return {parts_.front().table->state_names, static_cast<std::size_t>(lanes_)};
    }

    // ---- parameters and inputs, the same in every part ----

    [[nodiscard]] std::span<const char* const> parameter_names() const noexcept { return names_in(numbers(false)); }
    [[nodiscard]] std::span<const char* const> input_names() const noexcept { return names_in(numbers(true)); }
    [[nodiscard]] double parameter(std::size_t k) const noexcept { return *entry(parts_.front(), false, k); }
    void set_parameter(std::size_t k, double value) noexcept { set(false, k, value); }
    void set_input(std::size_t k, double value) noexcept { set(true, k, value); }

    // ---- the kernel contract ----

    [[nodiscard]] Status parameter_status() const noexcept
    {
        Status status = Status::ok;
        for (const Part& part : parts_)
            if (status == Status::ok && part.table->parameter_status != nullptr)
                status = status_of(part.table->parameter_status(part.instance.get()));
        return status;
    }

    /// `ds` may be of any size before; one that is no rate yet takes memory.
    [[nodiscard]] [[gnu::always_inline]] Status rhs(double t, const State& s, State& ds) const noexcept
    {
        if (ds.size() != lanes_) [[unlikely]]
            ds.resize(lanes_);
        return rhs(t, s.data(), ds.data());
    }
    [[nodiscard]] [[gnu::always_inline]] Status rhs(double t, const double* s, double* ds) const noexcept
    {
        return status_of(rhs_(instance_, t, s, ds));
    }

    /// The same of `width` states at once, 4 or 8, as lagen/compiled_model.h says; takes_packs() tells whether it is
    /// there.
    [[nodiscard]] bool takes_packs() const noexcept { return parts_.front().table->rhs8 != nullptr; }
    template <int width>
    void rhs_of_packs(const double* t, const double* s, double* ds, std::uint8_t* status) const noexcept
    {
        static_assert(width == 4 || width == 8);
        (width == 4 ? parts_.front().table->rhs4 : parts_.front().table->rhs8)(instance_, t, s, ds, status);
    }

    [[nodiscard]] double energy(double t, const State& s) const noexcept { return one(Function::energy, t, s); }
    [[nodiscard]] double power(double t, const State& s) const noexcept { return one(Function::power, t, s); }
    [[nodiscard]] double hamiltonian(double t, const State& s) const noexcept
    {
        return one(Function::hamiltonian, t, s);
    }
    [[nodiscard]] Values observables(double t, const State& s) const noexcept
    {
        return all(Function::observables, t, s);
    }
    [[nodiscard]] Values invariants(double t, const State& s) const noexcept { return all(Function::invariants, t, s); }
    [[nodiscard]] Values constraints(double t, const State& s) const noexcept
    {
        return all(Function::constraints, t, s);
    }
    [[nodiscard]] Values casimirs(double t, const State& s) const noexcept { return all(Function::casimirs, t, s); }
    [[nodiscard]] Values events(double t, const State& s) const noexcept { return all(Function::events, t, s); }
    [[nodiscard]] Values domain(double t, const State& s) const noexcept { return all(Function::domain, t, s); }
    [[nodiscard]] Values momentum(double t, const State& s) const noexcept { return all(Function::momentum, t, s); }
    [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> jumps(double t, const State& s) const noexcept
    {
        return matrix(Function::jumps, t, s);
    }
    [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> mass_matrix(double t, const State& s) const noexcept
    {
        return matrix(Function::mass_matrix, t, s);
    }

    [[nodiscard]] bool has(Function function) const noexcept { return slot(function).function != nullptr; }
    /// How many values it has; 0 where there is no such kernel.
    [[nodiscard]] Eigen::Index count(Function function) const noexcept { return slot(function).values.size(); }
    /// The names of its entries (of jumps: of its columns), if they have names.
    [[nodiscard]] std::span<const char* const> names(Function function) const noexcept
    {
        const lagen_values* found = slot(function).function;
        if (found == nullptr || found->names == nullptr) return {};
        return {found->names, static_cast<std::size_t>(function == Function::jumps ? found->columns : found->rows)};
    }
    /// As the kernel contract has them.
    std::span<const char*const> observables_names, invariants_names, constraints_names, casimirs_names, events_names,
        jumps_names;

    [[nodiscard]] bool follows() const noexcept { return follows_; } ///< does some kernel search for something?
    [[nodiscard]] Status follow(double t, const State& s) noexcept
    {
        Status status = Status::ok;
        if (!follows_) return status;
        for (Part& part : parts_)
            if (status == Status::ok && part.table->follow != nullptr)
                status = status_of(part.table->follow(part.instance.get(), t, s.data()));
        return status;
    }

    void stay_on_groups(const State& s0, State& s1) const noexcept
    {
        if (stay_on_groups_ != nullptr) stay_on_groups_(instance_, s0.data(), s1.data());
    }

    [[nodiscard]] bool has_jacobian() const noexcept { return jacobian_ != nullptr; }
    [[nodiscard]] std::span<const std::int32_t> jacobian_rows() const noexcept
    {
        return {jacobian().rows, static_cast<std::size_t>(jacobian().count)};
    }
    [[nodiscard]] std::span<const std::int32_t> jacobian_columns() const noexcept
    {
        return {jacobian().columns, static_cast<std::size_t>(jacobian().count)};
    }
    void jacobian_values(double t, const State& s, std::span<double> values) const noexcept
    {
        jacobian_values(t, s.data(), values);
    }
    void jacobian_values(double t, const double* s, std::span<double> values) const noexcept
    {
        jacobian().values(jacobian_->instance.get(), t, s, values.data());
    }

    // ---- Taylor coefficients ----

    [[nodiscard]] const lagen_series* series() const noexcept
    {
        return series_ == nullptr ? nullptr : &series_->table->series;
    }
    [[nodiscard]] int taylor_sums() const noexcept { return series_ == nullptr ? 0 : series()->sums; }
    [[nodiscard]] bool takes_unit() const noexcept { return series_ != nullptr && series()->has_unit != 0; }

    /// As the kernel contract has them; invalid_input where the object has none, or none of this order.
    template <int most>
    [[nodiscard]] Status taylor(double t, const State& s, int order, TaylorSeries<double, Eigen::Dynamic, most>& x,
                                double unit = 1) const noexcept
    {
        if (series_ == nullptr || order > series()->highest_order) return Status::invalid_input;
        return status_of(series()->motion(series_->instance.get(), t, s.data(), order, unit, x[0].data()));
    }
    template <int most>
    [[nodiscard]] Status event_series(double t, const State& s, int order,
                                      const TaylorSeries<double, Eigen::Dynamic, most>& x,
                                      TaylorSeries<double, Eigen::Dynamic, most>& e, double unit = 1) const noexcept
    {
        return along(&lagen_series::events, t, s, order, x, e, unit);
    }
    template <int most>
    [[nodiscard]] Status domain_series(double t, const State& s, int order,
                                       const TaylorSeries<double, Eigen::Dynamic, most>& x,
                                       TaylorSeries<double, Eigen::Dynamic, most>& e, double unit = 1) const noexcept
    {
        return along(&lagen_series::domain, t, s, order, x, e, unit);
    }

  private:
    struct Part {
        std::shared_ptr<const detail::LoadedLibrary> library;
        const lagen_compiled_model* table;
        detail::InstanceBytes instance;
    };
    /// Where a function is, and its last values.
    struct Slot {
        const lagen_values* function = nullptr;
        const void* instance = nullptr;
        mutable Eigen::VectorXd values{};
    };

    static Status status_of(std::int32_t number) noexcept { return static_cast<Status>(number); }
    [[nodiscard]] const lagen_jacobian& jacobian() const noexcept { return jacobian_->table->jacobian; }

    [[nodiscard]] const lagen_numbers& numbers(bool inputs) const noexcept
    {
        return inputs ? parts_.front().table->inputs : parts_.front().table->parameters;
    }
    static std::span<const char* const> names_in(const lagen_numbers& numbers) noexcept
    {
        return {numbers.names, static_cast<std::size_t>(numbers.count)};
    }
    static double* entry(const Part& part, bool inputs, std::size_t k) noexcept
    {
        const lagen_numbers& all = inputs ? part.table->inputs : part.table->parameters;
        return all.entry(const_cast<std::byte*>(part.instance.get()), static_cast<std::int32_t>(k));
    }
    void set(bool inputs, std::size_t k, double value) noexcept
    {
        for (Part& part : parts_) *entry(part, inputs, k) = value;
    }

    [[nodiscard]] const Slot& slot(Function function) const noexcept
    {
        return slots_[static_cast<std::size_t>(function)];
    }
    void evaluate(const Slot& at, double t, const State& s) const noexcept
    {
        if (at.function != nullptr) at.function->evaluate(at.instance, t, s.data(), at.values.data());
    }
    [[nodiscard]] double one(Function function, double t, const State& s) const noexcept
    {
        const Slot& at = slot(function);
        if (at.function == nullptr) return std::numeric_limits<double>::quiet_NaN();
        evaluate(at, t, s);
        return at.values[0];
    }
    [[nodiscard]] Values all(Function function, double t, const State& s) const noexcept
    {
        const Slot& at = slot(function);
        evaluate(at, t, s);
        return {at.values.data(), at.values.size()};
    }
    [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> matrix(Function function, double t, const State& s) const noexcept
    {
        const Slot& at = slot(function);
        evaluate(at, t, s);
        return {at.values.data(), at.function == nullptr ? 0 : at.function->rows,
                at.function == nullptr ? 0 : at.function->columns};
    }

    /// The series of functions along the motion, those of which there are none included.
    template <class Kernel, class Series>
    [[nodiscard]] Status along(Kernel kernel, double t, const State& s, int order, const Series& x, Series& e,
                               double unit) const noexcept
    {
        if (e[0].empty()) return Status::ok;
        if (series_ == nullptr || series()->*kernel == nullptr || order > series()->highest_order)
            return Status::invalid_input;
        return status_of(
            (series()->*kernel)(series_->instance.get(), t, s.data(), order, unit, x[0].data(), e[0].data()));
    }

    /// Finds the kernels of all parts.
    void look_up()
    {
        static constexpr std::array<std::string_view, functions> kernels = {
            "energy",     "power",       "hamiltonian", "lagrangian", "momentum", "mass_matrix", "observables",
            "invariants", "constraints", "casimirs",    "events",     "jumps",    "domain"};
        if (parts_.empty()) return;
        lanes_ = parts_.front().table->dimension;
        rhs_ = parts_.front().table->rhs;
        stay_on_groups_ = parts_.front().table->stay_on_groups;
        instance_ = parts_.front().instance.get();
        for (const Part& part : parts_) {
            follows_ = follows_ || part.table->follow != nullptr;
            if (part.table->jacobian.values != nullptr) jacobian_ = &part;
            if (part.table->series.motion != nullptr) series_ = &part;
            for (const lagen_values& each :
                 std::span(part.table->function, static_cast<std::size_t>(part.table->functions)))
                for (std::size_t k = 0; k < kernels.size(); ++k)
                    if (kernels[k] == each.name)
                        slots_[k] = {&each, part.instance.get(), Eigen::VectorXd::Zero(each.rows * each.columns)};
        }
        observables_names = names(Function::observables);
        invariants_names = names(Function::invariants);
        constraints_names = names(Function::constraints);
        casimirs_names = names(Function::casimirs);
        events_names = names(Function::events);
        jumps_names = names(Function::jumps);
    }

    static constexpr std::size_t functions = 13;
    std::vector<Part> parts_;
    std::int32_t (*rhs_)(const void*, double, const double*, double*) = nullptr;
    void (*stay_on_groups_)(const void*, const double*, double*) = nullptr;
    const void* instance_ = nullptr; ///< of the first part
    bool follows_ = false;           ///< some part
    Eigen::Index lanes_ = 0;
    std::array<Slot, functions> slots_;
    const Part *jacobian_ = nullptr, *series_ = nullptr;
};

/// What was loaded: `if (auto [status, model] = CompiledModel::load(path); status == LoadStatus::ok) ..`
struct CompiledModel::Loaded {
    LoadStatus status = LoadStatus::not_found;
    CompiledModel model{};
};

inline CompiledModel::Loaded CompiledModel::load(const std::vector<std::string>& paths)
{
    Loaded loaded;
    for (const std::string& path : paths) {
        auto [status, library] = detail::LoadedLibrary::open(path);
        if (status != LoadStatus::ok) return {status, {}};
        const lagen_compiled_model& table = library->table();
        if (!loaded.model.parts_.empty() && loaded.model.parts_.front().table->dimension != table.dimension)
            return {LoadStatus::not_a_model, {}};
        loaded.model.parts_.push_back({library, &table, detail::InstanceBytes(table)});
        loaded.status = LoadStatus::ok;
    }
    loaded.model.look_up();
    return loaded;
}

inline CompiledModel::Loaded CompiledModel::load(const std::string& path)
{
    return load(std::vector<std::string>{path});
}

} // namespace lagen
