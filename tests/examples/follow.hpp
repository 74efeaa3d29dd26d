// SPDX-License-Identifier: GPL-2.0-or-later
/// The committed header of an example against the reference case that describes the same system: right-hand side,
/// momenta and energy at its points, then the trajectory by DOP853. State lanes are matched by position, parameters by
/// name.
#pragma once

#include "lagen/lagen.hpp"
#include "support/constrained_case.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <functional>

namespace lagen::examples {

inline const ReferenceCase& reference(const std::string& name)
{
    static const std::vector<ReferenceCase> cases = [] {
        std::vector<ReferenceCase> all = read_reference_cases();
        for (const ConstrainedCase& each : read_constrained_cases()) all.push_back(each.reference);
        return all;
    }();
    const auto found =
        std::find_if(cases.begin(), cases.end(), [&](const ReferenceCase& each) { return each.name == name; });
    REQUIRE(found != cases.end());
    return *found;
}

inline double decimal(const std::string& text)
{
    return std::strtod(text.c_str(), nullptr);
}

template <class State>
State state_of(const std::vector<std::string>& texts)
{
    State s;
    REQUIRE(static_cast<std::size_t>(s.size()) == texts.size());
    for (std::size_t k = 0; k < texts.size(); ++k) s[static_cast<Eigen::Index>(k)] = decimal(texts[k]);
    return s;
}

/// The example with the parameters of the case; those that it does not have must be in `absent`.
template <class Model>
Model with_parameters(const ReferenceCase& reference, const std::vector<std::string>& absent)
{
    Model model;
    for (const auto& [name, value] : reference.parameters) {
        const auto place = std::find(Model::parameter_names.begin(), Model::parameter_names.end(), name);
        if (place == Model::parameter_names.end()) {
            CAPTURE(name);
            CHECK(std::find(absent.begin(), absent.end(), name) != absent.end());
            continue;
        }
        if constexpr (Model::parameter_names.size() > 0)
            model.parameter(static_cast<std::size_t>(place - Model::parameter_names.begin())) = decimal(value);
    }
    return model;
}

/// max norm of the difference over the max norm of the reference, which is not zero.
template <class Vector>
double relative_error(const Vector& found, const Vector& expected)
{
    const double size = expected.cwiseAbs().maxCoeff();
    REQUIRE(size > 0);
    return (found - expected).cwiseAbs().maxCoeff() / size;
}

/// d(state)/dt at the points of the case.
template <class Model>
void check_points(const Model& model, const ReferenceCase& reference)
{
    using State = typename Model::State;
    REQUIRE(reference.points.size() == 3);
    for (const ReferencePoint& point : reference.points) {
        State ds;
        const State s = state_of<State>(point.state);
        REQUIRE(model.rhs(0, s, ds) == Status::ok);
        CHECK(relative_error(ds, state_of<State>(point.state_dot)) < 1e-13);
        const double energy = decimal(point.energy);
        CHECK(std::abs(model.energy(0, s) - energy) <= 1e-13 * std::max(1.0, std::abs(energy)));
    }
}

/// What `integrate` reads of a model, behind one type for all of a dimension: DOP853 is compiled once for each.
template <int n>
struct AnyModel {
    using Scalar = double;
    using State = Eigen::Matrix<double, n, 1>;
    static constexpr int dimension = n;
    std::function<Status(double, const State&, State&)> derivative;
    std::function<double(double, const State&)> margin; ///< the least of its domain, which is positive inside
    Status of_parameters = Status::ok;

    template <RightHandSide Model>
    explicit AnyModel(const Model& model)
        : derivative([model](double t, const State& s, State& ds) { return model.rhs(t, s, ds); }),
          margin([](double, const State&) { return 1; }), of_parameters(model.parameter_status())
    {
        static_assert(!Follows<Model>);
        if constexpr (HasDomain<Model>)
            margin = [model](double t, const State& s) { return model.domain(t, s).minCoeff(); };
    }

    Status rhs(double t, const State& s, State& ds) const noexcept { return derivative(t, s, ds); }
    Eigen::Matrix<double, 1, 1> domain(double t, const State& s) const noexcept
    {
        return Eigen::Matrix<double, 1, 1>(margin(t, s));
    }
    Status parameter_status() const noexcept { return of_parameters; }
};

/// The samples of the case by DOP853 at 1e-13, in the first `lanes` lanes (all where 0), from `start`.
template <int n>
void check_trajectory(const AnyModel<n>& model, const ReferenceCase& reference,
                      const typename AnyModel<n>::State& start, Eigen::Index lanes = 0)
{
    std::vector<double> times;
    for (const ReferenceSample& sample : reference.samples) times.push_back(decimal(sample.t));
    REQUIRE(times.size() > 2);
    const auto run = integrate(model, start, {times.front(), times.back()}, Dop853{.tolerance = 1e-13}, {.at = times});
    REQUIRE(run.status() == Status::ok);
    REQUIRE(run.states.size() == times.size());
    for (std::size_t k = 0; k < times.size(); ++k) {
        const auto expected = state_of<typename AnyModel<n>::State>(reference.samples[k].state);
        const Eigen::Index count = lanes == 0 ? expected.size() : lanes;
        CHECK(relative_error<Eigen::VectorXd>(run.states[k].head(count), expected.head(count)) < 1e-10);
    }
}

template <class Model>
void follow(const std::string& name, const std::vector<std::string>& absent = {})
{
    CAPTURE(name);
    const ReferenceCase& known = reference(name);
    const Model model = with_parameters<Model>(known, absent);
    check_points(model, known);
    check_trajectory(AnyModel<Model::dimension>(model), known, state_of<typename Model::State>(known.initial));
}

/// The samples of the case by another method, to this error.
template <class Model, class Method>
void follow_by(const std::string& name, const Method& method, double error)
{
    CAPTURE(name);
    const ReferenceCase& known = reference(name);
    const Model model = with_parameters<Model>(known, {});
    std::vector<double> times;
    for (const ReferenceSample& sample : known.samples) times.push_back(decimal(sample.t));
    const auto start = state_of<typename Model::State>(known.initial);
    const auto run = integrate(model, start, {times.front(), times.back()}, method, {.at = times});
    REQUIRE(run.status() == Status::ok);
    double worst = 0;
    for (std::size_t k = 0; k < times.size(); ++k)
        worst = std::max(worst, relative_error(run.states[k], state_of<typename Model::State>(known.samples[k].state)));
    CAPTURE(worst);
    CHECK(worst < error);
}

} // namespace lagen::examples
