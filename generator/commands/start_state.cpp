// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/start_state.hpp"

#include "diagnostic.hpp"
#include "graph/evaluate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr int most_iterations = 100;
constexpr long double small = 1e-17L;

using Values = std::map<std::string, long double>;

const Kernel& kernel_of(const KernelModule& module, const std::string& name)
{
    for (const Kernel& kernel : module.kernels)
        if (kernel.name == name) return kernel;
    throw InternalError(fmt::format("the module has no kernel '{}'", name));
}

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

/// Solves A x = b by Gauss elimination with row pivoting; false where A is singular. Both are used up; x replaces b.
bool solve_linear(std::vector<long double>& a, std::vector<long double>& b)
{
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t row = k + 1; row < n; ++row)
            if (std::abs(a[row * n + k]) > std::abs(a[pivot * n + k])) pivot = row;
        if (!(std::abs(a[pivot * n + k]) > 0)) return false;
        for (std::size_t column = 0; column < n; ++column) std::swap(a[k * n + column], a[pivot * n + column]);
        std::swap(b[k], b[pivot]);
        for (std::size_t row = k + 1; row < n; ++row) {
            const long double factor = a[row * n + k] / a[k * n + k];
            for (std::size_t column = k; column < n; ++column) a[row * n + column] -= factor * a[k * n + column];
            b[row] -= factor * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t column = k + 1; column < n; ++column) b[k] -= a[k * n + column] * b[column];
        b[k] /= a[k * n + k];
    }
    return true;
}

[[noreturn]] void fail(const char* why)
{
    throw MathematicsError(
        fmt::format("error: the momenta of the start have no fibre coordinates that Newton's method finds: {}\n"
                    "hint: give the fibre coordinates in `initial` instead",
                    why));
}

std::vector<long double> invert_legendre(const KernelModule& module, const SceneValues& values, Values inputs)
{
    const Kernel& momentum = kernel_of(module, "momentum");
    const Kernel& mass = kernel_of(module, "mass_matrix");
    std::vector<long double> y(module.fibre.size(), 0);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        for (std::size_t a = 0; a < y.size(); ++a) inputs[module.fibre[a].name] = y[a];
        std::vector<long double> residual = dense(module, momentum, inputs);
        for (std::size_t a = 0; a < y.size(); ++a) residual[a] = values.momenta[a].second - residual[a];
        std::vector<long double> matrix = dense(module, mass, inputs);
        if (!solve_linear(matrix, residual)) fail("the mass matrix is singular");
        long double change = 0;
        long double size = 0;
        for (std::size_t a = 0; a < y.size(); ++a) {
            y[a] += residual[a];
            change = std::max(change, std::abs(residual[a]));
            size = std::max(size, std::abs(y[a]));
        }
        if (!std::isfinite(change)) fail("the iterates are not finite");
        if (change <= small * (1 + size)) return y;
    }
    fail("no convergence in 100 iterations");
}

} // namespace

std::vector<long double> start_state(const KernelModule& module, const SceneValues& values)
{
    Values inputs;
    std::vector<long double> state;
    for (const auto& [name, value] : values.parameters) inputs[name] = value;
    for (const auto& [name, value] : values.base) {
        inputs[name] = value;
        state.push_back(value);
    }
    inputs["t"] = values.start;
    if (values.momenta.empty()) {
        for (const auto& [name, value] : values.fibre) state.push_back(value);
        return state;
    }
    const std::vector<long double> y = invert_legendre(module, values, inputs);
    state.insert(state.end(), y.begin(), y.end());
    return state;
}

} // namespace lagen
