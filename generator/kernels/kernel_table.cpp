// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/kernel_table.hpp"

#include <algorithm>
#include <array>

namespace lagen {

namespace {

using Of = FormKind;

constexpr OutputSignature number{};
constexpr OutputSignature column_of_values{.rank = 1};
constexpr OutputSignature column_of_values_checked{.rank = 1, .checked = true};
constexpr OutputSignature dense_matrix{.rank = 2};
constexpr OutputSignature sparse_matrix{.rank = 2, .sparse = true};
constexpr OutputSignature rate{.rank = 1, .role = ArrayRole::tangent, .checked = true};

constexpr auto every = std::nullopt;

constexpr std::array kernel_rows{
    KernelRow{"rhs", every, rate, "The equations of motion."},
    KernelRow{"jacobian", every, sparse_matrix,
              "Derivative of ds with respect to s: the entries that are not zero by structure."},
    KernelRow{"variational", every, rate,
              "The variational equations at s: dv = (d rhs / d s) v. v and dv may be the same object.", true},
    KernelRow{"taylor", every, rate, "Taylor coefficients of the motion through s at t.", true},
    KernelRow{"event_series", every, column_of_values_checked, "Taylor coefficients of the events along the motion x.",
              true},
    KernelRow{"domain_series", every, column_of_values_checked,
              "Taylor coefficients of the conditions of the domain along the motion x.", true},
    KernelRow{"flows", Of::hamilton, rate, "The flow of a part of H: s + ds is where it takes s in the time h.", true},
    KernelRow{"mass_matrix", Of::lagrange, dense_matrix, "W_ab = d2L/dy^a dy^b, shape ({0}, {1}), symmetric."},
    KernelRow{"momentum", Of::lagrange, column_of_values, "p_a = dL/dy^a, shape ({0})."},
    KernelRow{"velocity", Of::hamilton, column_of_values, "y^a = dH/dmu_a, shape ({0})."},
    KernelRow{"controls", Of::pontryagin, column_of_values, "The controls that maximise H."},
    KernelRow{"energy", Of::lagrange, number, "E = y^a p_a - L."},
    KernelRow{"energy", Of::hamilton, number, "E = H(t, x, mu)."},
    KernelRow{"power", Of::lagrange, number, "dE/dt = Q_a y^a - dL/dt along the motion."},
    KernelRow{"power", Of::hamilton, number, "dE/dt = Q_a y^a + dH/dt along the motion."},
    KernelRow{"power", Of::pontryagin, number, "dH/dt along the motion."},
    KernelRow{"hamiltonian", Of::hamilton, number, "H(t, x, mu)."},
    KernelRow{"hamiltonian", Of::pontryagin, number, "H = mu_a sigma^a - cost at these controls."},
    KernelRow{"lagrangian", Of::lagrange, number, "L(t, x, y)."},
    KernelRow{"lagrangian", Of::hamilton, number, "L at y = dH/dmu."},
    KernelRow{"cost", Of::pontryagin, number, "The running cost."},
    KernelRow{"constraints", every, column_of_values, "Base constraints: each is 0 on M."},
    KernelRow{"casimirs", every, column_of_values, "Functions on M that are constant along every motion: rho(f) = 0."},
    KernelRow{"domain", every, column_of_values, "Positive inside the domain of the model."},
    KernelRow{"observables", every, column_of_values, "Observables of the model."},
    KernelRow{"invariants", every, column_of_values, "Functions that are constant along solutions."},
    KernelRow{"lagrangian_hessian", Of::lagrange, dense_matrix, "d2L/ds2 over the lanes of the state, symmetric.",
              true},
    KernelRow{"hamiltonian_hessian", Of::hamilton, dense_matrix, "d2H/ds2 over the lanes of the state, symmetric.",
              true},
    KernelRow{"events", every, column_of_values, "Events: each happens where its value crosses 0."},
};

} // namespace

std::span<const KernelRow> kernel_table()
{
    return kernel_rows;
}

const KernelRow& kernel_row(const std::string& name, FormKind form)
{
    const auto* const row = std::ranges::find_if(
        kernel_rows, [&](const KernelRow& each) { return name == each.name && each.form.value_or(form) == form; });
    if (row == kernel_rows.end())
        throw InternalError(std::string("the form ") + entry_of(form).name + " has no kernel " + name);
    return *row;
}

} // namespace lagen
