// SPDX-License-Identifier: GPL-2.0-or-later
/// End to end against data that share no code with lagen: model text -> verified algebroid -> kernels -> interpreter.
#include "model/read_model.hpp"
#include "reference/kernel_values.hpp"
#include "support/model_kernels.hpp"
#include "support/stages.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <iostream>

using namespace lagen;

namespace {

template <class Scalar>
Scalar largest_error(const KernelModule& module, const ReferenceCase& reference)
{
    Scalar largest = 0;
    for (const ReferencePoint& point : reference.points) {
        const auto error = [&](const char* kernel, const std::vector<std::string>& expected) {
            return relative_error(kernel_values<Scalar>(module, kernel, reference, point.state), expected);
        };
        largest = std::max({largest, error("rhs", point.state_dot), error("momentum", point.momenta),
                            error("energy", {point.energy})});
    }
    return largest;
}

} // namespace

TEST_CASE("derivatives, momenta and energy agree with the reference at every point of every case")
{
    std::cout << "case: relative error (max norm) in double, in long double\n";
    for (const ReferenceCase& reference : read_reference_cases()) {
        INFO(reference.name);
        const Model model = read_model_text(reference.name + ".toml", model_text(reference));
        const ModelReport verified = verify(model);
        CHECK(std::string(to_text(verified.structure.verdict)) == "valid");
        const KernelModule module = form_kernels(model, verified);
        const double in_double = largest_error<double>(module, reference);
        const long double in_long_double = largest_error<long double>(module, reference);
        CHECK(in_double < tolerance::roundoff(450)); // 1e-13
        CHECK(in_long_double < static_cast<long double>(tolerance::roundoff(1)));
        std::cout << "  " << reference.name << ": " << in_double << ", " << in_long_double << '\n';
    }
}

namespace {

/// From (x, mu): derivatives, velocities and energy.
template <class Scalar>
Scalar largest_hamiltonian_error(const KernelModule& module, const ReferenceCase& reference)
{
    Scalar largest = 0;
    for (const ReferencePoint& point : reference.points) {
        const auto n = static_cast<std::ptrdiff_t>(reference.base.size());
        std::vector<std::string> state(point.state.begin(), point.state.begin() + n);
        std::vector<std::string> rate(point.state_dot.begin(), point.state_dot.begin() + n);
        const std::vector<std::string> velocity(point.state.begin() + n, point.state.end());
        state.insert(state.end(), point.momenta.begin(), point.momenta.end());
        rate.insert(rate.end(), point.momenta_dot.begin(), point.momenta_dot.end());
        const auto error = [&](const char* kernel, const std::vector<std::string>& expected) {
            return relative_error(kernel_values<Scalar>(module, kernel, reference, state), expected);
        };
        largest =
            std::max({largest, error("rhs", rate), error("velocity", velocity), error("hamiltonian", {point.energy})});
    }
    return largest;
}

} // namespace

TEST_CASE("the Hamiltonian form agrees with the reference at every point of every case")
{
    std::cout << "case, Hamiltonian form: relative error (max norm) in double, in long double\n";
    for (const ReferenceCase& reference : read_reference_cases()) {
        INFO(reference.name);
        const Model model = read_model_text(reference.name + ".toml", model_text(reference));
        KernelRequest request;
        request.form = "hamilton";
        const KernelModule module = form_kernels(model, verify(model), request);
        const double in_double = largest_hamiltonian_error<double>(module, reference);
        const long double in_long_double = largest_hamiltonian_error<long double>(module, reference);
        CHECK(in_double < tolerance::roundoff(450)); // 1e-13
        CHECK(in_long_double < static_cast<long double>(tolerance::roundoff(1)));
        std::cout << "  " << reference.name << ": " << in_double << ", " << in_long_double << '\n';
    }
}

TEST_CASE("the controls of Pontryagin's form agree with every sample of every reference extremal")
{
    const std::vector<ReferenceCase> cases = read_control_cases();
    CHECK(cases.size() == 8);
    for (const ReferenceCase& reference : cases) {
        INFO(reference.name);
        const Model model = read_model_text(reference.name + ".toml", model_text(reference));
        const ModelReport verified = verify(model);
        CHECK(verified.structure.verdict == Verdict::valid);
        const KernelModule module = form_kernels(model, verified, {});
        CHECK(module.form == "pontryagin");
        for (const ReferenceSample& sample : reference.samples) {
            const std::vector<double> u = kernel_values<double>(module, "controls", reference, sample.state);
            CHECK(relative_error(u, sample.controls) < tolerance::roundoff(450));
        }
    }
}

TEST_CASE("every reference definition gets the verdict that it deserves, by the checks that fail")
{
    for (const ReferenceDefinition& definition : read_reference_definitions()) {
        INFO(definition.algebroid.name);
        const Model model = read_model_text(definition.algebroid.name + ".toml", model_text(definition.algebroid));
        const ModelReport verified = verify(model);
        CHECK(std::string(to_text(verified.structure.verdict)) == (definition.valid ? "valid" : "invalid"));
        for (const std::string& name : definition.failing)
            CHECK(std::any_of(verified.structure.checks.begin(), verified.structure.checks.end(),
                              [&](const Check& check) {
                                  return check.name == name && check.decision.status == ProofStatus::refuted &&
                                         check.decision.witness;
                              }));
    }
}
