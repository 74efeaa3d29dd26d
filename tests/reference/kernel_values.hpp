// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels at states of reference cases, by the interpreter.
#pragma once

#include "graph/core/evaluate.hpp"
#include "graph/kernel.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "support/reference_case.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace lagen {

/// The values of a kernel's output array at a state of the case, row by row (columns = 1).
template <class Scalar>
std::vector<Scalar> kernel_values(const KernelModule& module, const std::string& name, const ReferenceCase& reference,
                                  const std::vector<std::string>& state)
{
    std::map<std::string, Scalar> inputs{{module.graph->input_name(module.time), Scalar(0)}};
    const auto set = [&](const Quantity& quantity, const std::string& text) {
        inputs[module.graph->input_name(quantity.input)] = static_cast<Scalar>(std::stold(text));
    };
    for (std::size_t k = 0; k < module.parameters.size(); ++k)
        set(module.parameters[k], reference.parameters[k].second);
    const std::vector<Quantity> lanes = lanes_of(module);
    for (std::size_t k = 0; k < lanes.size(); ++k) set(lanes[k], state[k]);
    solve_unknowns(*module.graph, module.implicit, inputs);

    const auto kernel = std::find_if(module.kernels.begin(), module.kernels.end(),
                                     [&](const Kernel& candidate) { return candidate.name == name; });
    REQUIRE(kernel != module.kernels.end());
    const std::vector<Scalar> found = evaluate<Scalar>(*module.graph, nodes_of(*kernel), inputs);
    const KernelOutput& output = kernel->outputs[0];
    std::vector<Scalar> values(output.shape.rows, Scalar(0));
    for (std::size_t k = 0; k < found.size(); ++k) values.at(output.entries[k].row) = found[k];
    return values;
}

/// max |found - expected| / max |expected|.
template <class Scalar>
Scalar relative_error(const std::vector<Scalar>& found, const std::vector<std::string>& expected)
{
    REQUIRE(found.size() == expected.size());
    Scalar difference = 0;
    Scalar size = 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        const auto value = static_cast<Scalar>(std::stold(expected[k]));
        if (!std::isfinite(found[k])) return std::numeric_limits<Scalar>::infinity();
        difference = std::max(difference, std::abs(found[k] - value));
        size = std::max(size, std::abs(value));
    }
    return size > 0 ? difference / size : difference; // a control may vanish
}

} // namespace lagen
