// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/start_state.hpp"

#include "diagnostic.hpp"
#include "graph/dense_lu.hpp"
#include "graph/evaluate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr int most_iterations = 100;
constexpr long double small = 1e-17L;

using Values = std::map<std::string, long double>;

/// A kernel's output as a dense array by rows.
std::vector<long double> dense(const KernelModule& module, const Kernel& kernel, const Values& inputs)
{
    std::vector<NodeId> nodes;
    for (const KernelEntry& entry : kernel.output.entries) nodes.push_back(entry.node);
    const std::vector<long double> values = evaluate<long double>(*module.graph, nodes, inputs);
    std::vector<long double> array(kernel.output.rows * kernel.output.columns, 0);
    for (std::size_t k = 0; k < values.size(); ++k) {
        const KernelEntry& entry = kernel.output.entries[k];
        array[entry.row * kernel.output.columns + entry.column] = values[k];
    }
    return array;
}

/// An equation value(z) = target for the lanes `unknowns` of a module, by Newton's method from 0.
struct Inversion {
    const KernelModule& module;
    const Kernel& value;  ///< r entries
    const Kernel& matrix; ///< its derivative: the last r rows and columns
    const char* given;    ///< for the message
    const char* wanted;
};

[[noreturn]] void fail(const Inversion& inversion, const char* why)
{
    throw MathematicsError(fmt::format("error: the {} of the start have no {} that Newton's method finds: {}\n"
                                       "hint: give the {} in `initial` instead",
                                       inversion.given, inversion.wanted, why, inversion.wanted));
}

/// The last r rows and columns.
std::vector<long double> corner(const std::vector<long double>& array, std::size_t size, std::size_t r)
{
    std::vector<long double> result;
    for (std::size_t row = size - r; row < size; ++row)
        for (std::size_t column = size - r; column < size; ++column) result.push_back(array[row * size + column]);
    return result;
}

std::vector<long double> invert(const Inversion& inversion, const std::vector<NamedNumber>& target, Values inputs)
{
    const std::vector<Quantity>& unknowns = inversion.module.fibre;
    std::vector<long double> z(unknowns.size(), 0);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (std::size_t a = 0; a < z.size(); ++a) inputs[unknowns[a].name] = z[a];
        std::vector<long double> residual = dense(inversion.module, inversion.value, inputs);
        for (std::size_t a = 0; a < z.size(); ++a) residual[a] = target[a].second - residual[a];
        const auto matrix =
            factorise(corner(dense(inversion.module, inversion.matrix, inputs), inversion.matrix.output.rows, z.size()),
                      z.size());
        if (!matrix.regular) fail(inversion, "the matrix of the equations is singular");
        residual = substitute(matrix, residual);
        long double change = 0;
        long double size = 0;
        for (std::size_t a = 0; a < z.size(); ++a) {
            z[a] += residual[a];
            change = std::max(change, std::abs(residual[a]));
            size = std::max(size, std::abs(z[a]));
        }
        if (!std::isfinite(change)) fail(inversion, "the iterates are not finite");
        if (change <= small * (1 + size)) return z;
    }
    fail(inversion, "no convergence in 100 iterations");
}

/// y with dL/dy = the given momenta.
std::vector<long double> velocities_of(const KernelModule& module, const SceneValues& values, const Values& inputs)
{
    return invert(
        {module, kernel_named(module, "momentum"), kernel_named(module, "mass_matrix"), "momenta", "fibre coordinates"},
        values.momenta, inputs);
}

/// mu = dL/dy at the given fibre coordinates, or mu with dH/dmu = them.
std::vector<long double> momenta_of(const CheckedModel& checked, const SceneValues& values, Values inputs)
{
    const auto module_of = [&](const char* form, std::vector<std::string> only) {
        KernelRequest request;
        request.form = form;
        request.only = std::move(only);
        return form_kernels(checked.model, checked.verified, request);
    };
    if (checked.model.lagrangian) {
        const KernelModule module = module_of("lagrange", {"momentum"});
        for (const auto& [name, value] : values.fibre) inputs[name] = value;
        return values.fibre.empty() ? std::vector<long double>{}
                                    : dense(module, kernel_named(module, "momentum"), inputs);
    }
    const KernelModule module = module_of("hamilton", {"velocity", "hamiltonian_hessian"});
    return invert({module, kernel_named(module, "velocity"), kernel_named(module, "hamiltonian_hessian"),
                   "fibre coordinates", "momenta"},
                  values.fibre, inputs);
}

} // namespace

std::vector<long double> start_state(const CheckedModel& checked, const KernelModule& module, const SceneValues& values)
{
    Values inputs;
    std::vector<long double> state;
    for (const auto& [name, value] : values.parameters) inputs[name] = value;
    for (const auto& [name, value] : values.base) {
        inputs[name] = value;
        state.push_back(value);
    }
    inputs["t"] = values.start;
    const auto append = [&](const std::vector<long double>& lanes) {
        state.insert(state.end(), lanes.begin(), lanes.end());
        return state;
    };
    std::vector<long double> given;
    for (const auto& [name, value] : values.momenta.empty() ? values.fibre : values.momenta) given.push_back(value);
    const bool has_momenta = !values.momenta.empty();
    if (module.form == "lagrange") return append(has_momenta ? velocities_of(module, values, inputs) : given);
    if (has_momenta || given.empty()) return append(given);
    if (module.form == "pontryagin") throw InternalError("a scene in Pontryagin's form without momenta");
    return append(momenta_of(checked, values, inputs));
}

} // namespace lagen
