// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/kernel_table.hpp"

#include <algorithm>
#include <array>

namespace lagen {

namespace {

using Shape = KernelShape;
using Of = FormKind;

constexpr auto every = std::nullopt;

constexpr std::array kernel_rows{
    KernelRow{"rhs", every, Shape::right_hand_side, "The equations of motion."},
    KernelRow{"jacobian", every, Shape::sparse,
              "Derivative of ds with respect to s: the entries that are not zero by structure."},
    KernelRow{"variational", every, Shape::directional,
              "The variational equations at s: dv = (d rhs / d s) v. v and dv may be the same object.", true},
    KernelRow{"mass_matrix", Of::lagrange, Shape::matrix, "W_ab = d2L/dy^a dy^b, shape ({0}, {1}), symmetric."},
    KernelRow{"momentum", Of::lagrange, Shape::vector, "p_a = dL/dy^a, shape ({0})."},
    KernelRow{"velocity", Of::hamilton, Shape::vector, "y^a = dH/dmu_a, shape ({0})."},
    KernelRow{"controls", Of::pontryagin, Shape::vector, "The controls that maximise H."},
    KernelRow{"energy", Of::lagrange, Shape::scalar, "E = y^a p_a - L."},
    KernelRow{"energy", Of::hamilton, Shape::scalar, "E = H(t, x, mu)."},
    KernelRow{"power", Of::lagrange, Shape::scalar, "dE/dt = Q_a y^a - dL/dt along the motion."},
    KernelRow{"power", Of::hamilton, Shape::scalar, "dE/dt = Q_a y^a + dH/dt along the motion."},
    KernelRow{"power", Of::pontryagin, Shape::scalar, "dH/dt along the motion."},
    KernelRow{"hamiltonian", Of::hamilton, Shape::scalar, "H(t, x, mu)."},
    KernelRow{"hamiltonian", Of::pontryagin, Shape::scalar, "H = mu_a sigma^a - cost at these controls."},
    KernelRow{"lagrangian", Of::lagrange, Shape::scalar, "L(t, x, y)."},
    KernelRow{"lagrangian", Of::hamilton, Shape::scalar, "L at y = dH/dmu."},
    KernelRow{"cost", Of::pontryagin, Shape::scalar, "The running cost."},
    KernelRow{"constraints", every, Shape::vector, "Base constraints: each is 0 on M."},
    KernelRow{"domain", every, Shape::vector, "Positive inside the domain of the model."},
    KernelRow{"observables", every, Shape::vector, "Observables of the model."},
    KernelRow{"invariants", every, Shape::vector, "Functions that are constant along solutions."},
    KernelRow{"lagrangian_hessian", Of::lagrange, Shape::matrix, "d2L/ds2 over the lanes of the state, symmetric.",
              true},
    KernelRow{"hamiltonian_hessian", Of::hamilton, Shape::matrix, "d2H/ds2 over the lanes of the state, symmetric.",
              true},
    KernelRow{"events", every, Shape::vector, "Events: each happens where its value crosses 0."},
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
