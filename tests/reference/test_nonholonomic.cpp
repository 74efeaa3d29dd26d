// SPDX-License-Identifier: GPL-2.0-or-later
/// Nonholonomic systems against data that share no code with lagen: hand-written classical equations with multipliers.
#include "model/read_model.hpp"
#include "reference/kernel_values.hpp"
#include "support/constrained_case.hpp"
#include "support/model_kernels.hpp"
#include "support/stages.hpp"
#include "support/tolerances.hpp"

#include <catch2/catch.hpp>

using namespace lagen;

namespace {

/// The largest error of what both forms have, relative to the largest entry of each column.
template <class Scalar>
Scalar shared_error(const KernelModule& module, const ConstrainedCase& constrained, std::size_t k,
                    const std::vector<std::string>& state)
{
    const ReferenceCase& reference = constrained.reference;
    const ConstrainedPoint& point = constrained.points[k];
    const auto error = [&](const char* kernel, const std::vector<std::string>& expected) {
        return relative_error(kernel_values<Scalar>(module, kernel, reference, state), expected);
    };
    Scalar largest = std::max({error("energy", {reference.points[k].energy}),
                               error("ambient_velocity", point.ambient_velocity), error("reaction", point.reaction)});
    if (!constrained.drift.empty()) largest = std::max(largest, error("moving_energy", {point.moving_energy}));
    return largest;
}

template <class Scalar>
Scalar lagrangian_error(const KernelModule& module, const ConstrainedCase& constrained)
{
    Scalar largest = 0;
    for (std::size_t k = 0; k < constrained.points.size(); ++k) {
        const ReferencePoint& point = constrained.reference.points[k];
        const auto error = [&](const char* kernel, const std::vector<std::string>& expected) {
            return relative_error(kernel_values<Scalar>(module, kernel, constrained.reference, point.state), expected);
        };
        largest = std::max({largest, error("rhs", point.state_dot), error("momentum", point.momenta),
                            shared_error<Scalar>(module, constrained, k, point.state)});
    }
    return largest;
}

template <class Scalar>
Scalar hamiltonian_error(const KernelModule& module, const ConstrainedCase& constrained)
{
    Scalar largest = 0;
    const auto n = static_cast<std::ptrdiff_t>(constrained.reference.base.size());
    for (std::size_t k = 0; k < constrained.points.size(); ++k) {
        const ReferencePoint& point = constrained.reference.points[k];
        std::vector<std::string> state(point.state.begin(), point.state.begin() + n);
        std::vector<std::string> rate(point.state_dot.begin(), point.state_dot.begin() + n);
        state.insert(state.end(), point.momenta.begin(), point.momenta.end());
        rate.insert(rate.end(), point.momenta_dot.begin(), point.momenta_dot.end());
        const std::vector<Scalar> found = kernel_values<Scalar>(module, "rhs", constrained.reference, state);
        largest = std::max({largest, relative_error(found, rate), shared_error<Scalar>(module, constrained, k, state)});
    }
    return largest;
}

} // namespace

TEST_CASE("nonholonomic rates, momenta, energies and reactions agree with the reference at every point")
{
    const std::vector<ConstrainedCase> cases = read_constrained_cases();
    REQUIRE(cases.size() == 8);
    for (const ConstrainedCase& constrained : cases) {
        INFO(constrained.reference.name);
        const Model model = read_model_text(constrained.reference.name + ".toml", model_text(constrained));
        const ModelReport verified = verify(model);
        CHECK(std::string(to_text(verified.structure.verdict)) == "valid");
        REQUIRE(verified.mechanics.integrable);
        CHECK(verified.mechanics.integrable->status == ProofStatus::refuted);
        CHECK(verified.mechanics.integrable->bracket == constrained.bracket);
        CHECK(verified.mechanics.integrable->witness->value != 0);
        const KernelModule lagrange = form_kernels(model, verified);
        CHECK(lagrangian_error<double>(lagrange, constrained) < tolerance::roundoff(450)); // 1e-13
        CHECK(lagrangian_error<long double>(lagrange, constrained) < static_cast<long double>(tolerance::roundoff(1)));
        KernelRequest request;
        request.form = "hamilton";
        const KernelModule hamilton = form_kernels(model, verified, request);
        CHECK(hamiltonian_error<double>(hamilton, constrained) < tolerance::roundoff(450));
    }
}
