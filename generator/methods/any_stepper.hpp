// SPDX-License-Identifier: GPL-2.0-or-later
/// A method of which only at run time is known which it is, for compiled models: the loop over steps is compiled once
/// for all adaptive methods and once for all methods of fixed steps, and asks the stepper of one of them by virtual
/// functions (lagen/integrate/stepper.hpp says what is asked of a stepper). A step costs one such call.
#pragma once

#include "lagen/compiled_model.hpp"
#include "lagen/integrate/control.hpp"
#include "lagen/integrate/stepper.hpp"

#include "methods/in_place.hpp"

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace lagen {

class StepperFace {
  public:
    using State = CompiledModel::State;

    StepperFace() = default;
    StepperFace& operator=(const StepperFace&) = delete;
    virtual ~StepperFace() = default;
    [[nodiscard]] virtual std::unique_ptr<StepperFace> copy() const = 0;

    virtual Status begin(const CompiledModel& model, double t, const State& s) = 0;
    virtual Status attempt(const CompiledModel& model, double t, const State& s, double h, State& s1) noexcept = 0;
    virtual void accept() noexcept = 0;
    virtual void forget() noexcept = 0;
    virtual Status interpolate(const CompiledModel& model, double t, const State& s, double h, const State& s1,
                               double theta, State& out) noexcept = 0;
    [[nodiscard]] virtual detail::Work work() const noexcept = 0;
    [[nodiscard]] virtual std::size_t dense_order() const noexcept = 0;
    virtual bool polynomial(double theta, State& out) const noexcept = 0;

    // ---- of adaptive methods ----

    [[nodiscard]] virtual double first_step(const CompiledModel& model, double t, double length,
                                            const State& s) noexcept = 0;
    [[nodiscard]] virtual double error() const noexcept = 0;
    virtual Status finish(const CompiledModel& model, double t1, const State& s1) noexcept = 0;
    [[nodiscard]] virtual const State& derivative() const noexcept = 0;
    [[nodiscard]] virtual double after_accepted(double h, double error) noexcept = 0;
    [[nodiscard]] virtual double after_rejected(double h, double error) noexcept = 0;
    [[nodiscard]] virtual double after_failure(double h) noexcept = 0;

  protected:
    StepperFace(const StepperFace&) = default;
};

/// The stepper of one method, of a model of n lanes or of any number. Adaptive ones that leave the lengths to the loop
/// bring its controller along.
template <class Method, int n = Eigen::Dynamic>
class StepperOf final : public StepperFace {
    using Lanes = InPlace<n>;
    using Model = std::conditional_t<n == Eigen::Dynamic, const CompiledModel&, const Lanes>;
    using Stepper = typename Method::template Stepper<std::remove_cvref_t<Model>>;
    static constexpr bool adaptive = Stepper::adaptive;
    static constexpr bool chooses_lengths = requires(Stepper stepper, double h) { stepper.after_failure(h); };

  public:
    explicit StepperOf(const Method& method) : stepper_(method)
    {
        if constexpr (adaptive && !chooses_lengths)
            lengths_ = detail::Controller<double>(method.control(), Stepper::error_order, Stepper::beta_share);
    }

    [[nodiscard]] std::unique_ptr<StepperFace> copy() const override { return std::make_unique<StepperOf>(*this); }
    Status begin(const CompiledModel& model, double t, const State& s) override
    {
        derivative_ = s;
        return stepper_.begin(Model(model), t, Lanes::in_place(s));
    }
    Status attempt(const CompiledModel& model, double t, const State& s, double h, State& s1) noexcept override
    {
        return stepper_.attempt(Model(model), t, Lanes::in_place(s), h, Lanes::in_place(s1));
    }
    void accept() noexcept override { stepper_.accept(); }
    void forget() noexcept override
    {
        if constexpr (requires { stepper_.forget(); }) stepper_.forget();
    }
    Status interpolate(const CompiledModel& model, double t, const State& s, double h, const State& s1, double theta,
                       State& out) noexcept override
    {
        return stepper_.interpolate(Model(model), t, Lanes::in_place(s), h, Lanes::in_place(s1), theta,
                                    Lanes::in_place(out));
    }
    [[nodiscard]] detail::Work work() const noexcept override { return detail::Work().with(stepper_); }
    [[nodiscard]] std::size_t dense_order() const noexcept override { return detail::dense_order_of(stepper_); }
    bool polynomial(double theta, State& out) const noexcept override
    {
        if constexpr (requires { stepper_.polynomial(theta, Lanes::in_place(out)); })
            return stepper_.polynomial(theta, Lanes::in_place(out));
        return false;
    }

    [[nodiscard]] double first_step(const CompiledModel& model, double t, double length,
                                    const State& s) noexcept override
    {
        if constexpr (adaptive) return stepper_.first_step(Model(model), t, length, Lanes::in_place(s));
        return length;
    }
    [[nodiscard]] double error() const noexcept override
    {
        if constexpr (adaptive) return stepper_.error();
        return 0;
    }
    Status finish(const CompiledModel& model, double t1, const State& s1) noexcept override
    {
        if constexpr (adaptive) return stepper_.finish(Model(model), t1, Lanes::in_place(s1));
        return Status::ok;
    }
    [[nodiscard]] const State& derivative() const noexcept override
    {
        if constexpr (adaptive && n == Eigen::Dynamic) return stepper_.derivative();
        if constexpr (adaptive && n != Eigen::Dynamic) derivative_ = stepper_.derivative();
        return derivative_;
    }
    [[nodiscard]] double after_accepted(double h, double error) noexcept override
    {
        if constexpr (chooses_lengths) return stepper_.after_accepted(h, error);
        return lengths_.after_accepted(h, error);
    }
    [[nodiscard]] double after_rejected(double h, double error) noexcept override
    {
        if constexpr (chooses_lengths) return stepper_.after_rejected(h, error);
        return lengths_.after_rejected(h, error);
    }
    [[nodiscard]] double after_failure(double h) noexcept override
    {
        if constexpr (chooses_lengths) return stepper_.after_failure(h);
        return lengths_.after_failure(h);
    }

  private:
    Stepper stepper_;
    detail::Controller<double> lengths_{StepControl{}, 5, 0.0};
    mutable State derivative_; ///< a copy, of states in place
};

/// The stepper that the loop over steps has.
template <bool is_adaptive>
class AnyStepper {
  public:
    using State = CompiledModel::State;
    static constexpr bool adaptive = is_adaptive;

    template <class Method>
    explicit AnyStepper(const Method& method) : one_(method.stepper())
    {
    }
    AnyStepper(const AnyStepper& other) : one_(other.one_->copy()) {}
    AnyStepper(AnyStepper&&) noexcept = default;
    AnyStepper& operator=(const AnyStepper& other)
    {
        one_ = other.one_->copy();
        return *this;
    }
    AnyStepper& operator=(AnyStepper&&) noexcept = default;
    ~AnyStepper() = default;

    Status begin(const CompiledModel& model, double t, const State& s) { return one_->begin(model, t, s); }
    Status attempt(const CompiledModel& model, double t, const State& s, double h, State& s1) noexcept
    {
        return one_->attempt(model, t, s, h, s1);
    }
    void accept() noexcept { one_->accept(); }
    void forget() noexcept { one_->forget(); }
    Status interpolate(const CompiledModel& model, double t, const State& s, double h, const State& s1, double theta,
                       State& out) noexcept
    {
        return one_->interpolate(model, t, s, h, s1, theta, out);
    }
    [[nodiscard]] std::size_t dense_order() const noexcept { return one_->dense_order(); }
    bool polynomial(double theta, State& out) const noexcept { return one_->polynomial(theta, out); }
    [[nodiscard]] std::size_t calls() const noexcept { return one_->work().calls; }
    [[nodiscard]] std::size_t newton_iterations() const noexcept { return one_->work().newton_iterations; }
    [[nodiscard]] std::size_t decompositions() const noexcept { return one_->work().decompositions; }

    [[nodiscard]] double first_step(const CompiledModel& model, double t, double length, const State& s) noexcept
    {
        return one_->first_step(model, t, length, s);
    }
    [[nodiscard]] double error() const noexcept { return one_->error(); }
    Status finish(const CompiledModel& model, double t1, const State& s1) noexcept
    {
        return one_->finish(model, t1, s1);
    }
    [[nodiscard]] const State& derivative() const noexcept { return one_->derivative(); }
    [[nodiscard]] double after_accepted(double h, double error) noexcept requires(is_adaptive)
    {
        return one_->after_accepted(h, error);
    }
    [[nodiscard]] double after_rejected(double h, double error) noexcept requires(is_adaptive)
    {
        return one_->after_rejected(h, error);
    }
    [[nodiscard]] double after_failure(double h) noexcept requires(is_adaptive) { return one_->after_failure(h); }

  private:
    std::unique_ptr<StepperFace> one_;
};

/// An adaptive method, by the function that makes its stepper and its own numbers of step control.
struct AnyAdaptive {
    std::unique_ptr<StepperFace> (*make)(Eigen::Index lanes, double relative, double absolute) = nullptr;
    StepControl numbers{};
    double tolerance = 1e-9, relative = -1, absolute = -1;
    Eigen::Index lanes = 0; ///< of the model

    [[nodiscard]] StepControl control() const noexcept
    {
        StepControl all = numbers;
        all.relative = relative;
        all.absolute = absolute;
        return all;
    }
    [[nodiscard]] std::unique_ptr<StepperFace> stepper() const { return make(lanes, relative, absolute); }
    template <class M>
    using Stepper = AnyStepper<true>;
};

/// A method of fixed steps.
struct AnyFixed {
    std::unique_ptr<StepperFace> (*make)(Eigen::Index lanes) = nullptr;
    double step = 0;
    Eigen::Index lanes = 0; ///< of the model

    [[nodiscard]] std::unique_ptr<StepperFace> stepper() const { return make(lanes); }
    template <class M>
    using Stepper = AnyStepper<false>;
};

/// The stepper of a method for so many lanes: one in place where there are from 1 to `in_place` of them.
template <int in_place, class Method>
[[nodiscard]] std::unique_ptr<StepperFace> stepper_of(const Method& method, Eigen::Index lanes)
{
    if constexpr (in_place > 0)
        return lanes == in_place ? std::make_unique<StepperOf<Method, in_place>>(method)
                                 : stepper_of<in_place - 1>(method, lanes);
    else
        return std::make_unique<StepperOf<Method>>(method);
}

/// The method of this type, AnyAdaptive or AnyFixed; with steppers in place for up to so many lanes.
template <class Method, int in_place = 0>
[[nodiscard]] AnyAdaptive any_adaptive()
{
    return {[](Eigen::Index lanes, double relative, double absolute) -> std::unique_ptr<StepperFace> {
                Method method{};
                method.relative = relative;
                method.absolute = absolute;
                return stepper_of<in_place>(method, lanes);
            },
            Method{}.control()};
}
template <class Method, int in_place = 0>
[[nodiscard]] AnyFixed any_fixed()
{
    return {[](Eigen::Index lanes) -> std::unique_ptr<StepperFace> {
        return stepper_of<in_place>(Method{.step = 1}, lanes);
    }};
}

} // namespace lagen
