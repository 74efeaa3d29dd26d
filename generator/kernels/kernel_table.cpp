// SPDX-License-Identifier: GPL-2.0-or-later
#include "kernels/kernel_table.hpp"

#include <algorithm>
#include <array>

namespace lagen {

namespace {

constexpr Forms lagrange = only(FormKind::lagrange);
constexpr Forms hamilton = only(FormKind::hamilton);
constexpr Forms pontryagin = only(FormKind::pontryagin);
constexpr Forms discrete = only(FormKind::discrete);
constexpr Forms first_order = only(FormKind::first_order);
constexpr Forms flow = lagrange | hamilton | pontryagin | first_order; ///< those with rates
constexpr Forms mechanical = lagrange | hamilton;
constexpr Forms every = flow | discrete;

constexpr OutputSignature number{};
constexpr OutputSignature column_of_values{.rank = 1};
constexpr OutputSignature column_of_values_checked{.rank = 1, .checked = true};
constexpr OutputSignature dense_matrix{.rank = 2};
constexpr OutputSignature sparse_matrix{.rank = 2, .sparse = true};
constexpr OutputSignature rate{.rank = 1, .role = ArrayRole::tangent, .checked = true};

constexpr std::array kernel_rows{
    KernelRow{"rhs", flow, rate, "The equations of motion."},
    KernelRow{"jacobian", flow, sparse_matrix,
              "Derivative of ds with respect to s: the entries that are not zero by structure."},
    KernelRow{
        "input_jacobian", flow, sparse_matrix,
        "Derivative of ds with respect to the inputs, a column each: the entries that are not zero by structure."},
    KernelRow{"variational", flow, rate,
              "The variational equations at s: dv = (d rhs / d s) v. v and dv may be the same object.", true},
    KernelRow{"taylor", flow, rate, "Taylor coefficients of the motion through s at t.", true},
    KernelRow{"event_series", flow, column_of_values_checked, "Taylor coefficients of the events along the motion x.",
              true},
    KernelRow{"domain_series", flow, column_of_values_checked,
              "Taylor coefficients of the conditions of the domain along the motion x.", true},
    KernelRow{"flows", hamilton, rate, "The flow of a part of H: s + ds is where it takes s in the time h.", true},
    KernelRow{"mass_matrix", lagrange, dense_matrix, "W_ab = d2L/dy^a dy^b, shape ({0}, {1}), symmetric."},
    KernelRow{"momentum", lagrange, column_of_values, "p_a = dL/dy^a, shape ({0})."},
    KernelRow{"inverse_dynamics", lagrange, column_of_values_checked,
              "The inputs that give the accelerations ydot, in the order of input_names, shape ({0})."},
    KernelRow{"velocity", hamilton, column_of_values, "y^a = dH/dmu_a, shape ({0})."},
    KernelRow{"controls", pontryagin, column_of_values, "The controls that maximise H."},
    KernelRow{"energy", lagrange, number, "E = y^a p_a - L."},
    KernelRow{"energy", hamilton, number, "E = H(t, x, mu)."},
    KernelRow{"power", lagrange, number, "dE/dt = Q_a y^a - dL/dt along the motion."},
    KernelRow{"power", hamilton, number, "dE/dt = Q_a y^a + dH/dt along the motion."},
    KernelRow{"power", pontryagin, number, "dH/dt along the motion."},
    KernelRow{"hamiltonian", hamilton, number, "H(t, x, mu)."},
    KernelRow{"hamiltonian", pontryagin, number, "H = mu_a sigma^a - cost at these controls."},
    KernelRow{"lagrangian", lagrange, number, "L(t, x, y)."},
    KernelRow{"lagrangian", hamilton, number, "L at y = dH/dmu."},
    KernelRow{"ambient_velocity", mechanical, column_of_values_checked,
              "Y^a = b^a + A_alpha^a y^alpha, the velocity in the ambient algebroid, shape ({0})."},
    KernelRow{"reaction", mechanical, column_of_values_checked,
              "The reactions lambda_a on the right of Lagrange's equations on the ambient algebroid, shape ({0})."},
    KernelRow{"moving_energy", mechanical, number, "E - P_a b^a."},
    KernelRow{"cost", pontryagin, number, "The running cost."},
    KernelRow{"constraints", every, column_of_values, "Base constraints: each is 0 on M."},
    KernelRow{"casimirs", every, column_of_values, "Functions on M that are constant along every motion: rho(f) = 0."},
    KernelRow{"domain", every, column_of_values, "Positive inside the domain of the model."},
    KernelRow{"observables", every, column_of_values, "Observables of the model."},
    KernelRow{"invariants", every, column_of_values, "Functions that are constant along solutions."},
    KernelRow{"lagrangian_hessian", lagrange, dense_matrix, "d2L/ds2 over the lanes of the state, symmetric.", true},
    KernelRow{"hamiltonian_hessian", hamilton, dense_matrix, "d2H/ds2 over the lanes of the state, symmetric.", true},
    KernelRow{"step", discrete, number, "The length h of a step."},
    KernelRow{"forward", discrete, column_of_values,
              "Behind the step: x = t(g), shape ({0}), and its momenta mu = F^+L(g) by those that the state has."},
    KernelRow{"arrow_equation", discrete, column_of_values,
              "The equation of the arrow g: R_a = mu_a - F^-L(g)_a, shape ({0})."},
    KernelRow{"explicit_step", discrete, column_of_values, "The state behind the step, where that is explicit."},
    KernelRow{
        "cayley_step", discrete, dense_matrix,
        "The group part of a move by d along the source fibre, W' = W (1 + V), by Cayley's map; shape ({0}, {1})."},
    KernelRow{"cayley_coordinates", discrete, column_of_values,
              "d with cay(d) = W, shape ({0}): zeros, then coordinates over the generators."},
    KernelRow{"algebra_matrix", discrete, dense_matrix,
              "The group part of a direction d of the source fibre, dW = W A, shape ({0}, {1})."},
    KernelRow{"in_algebra", discrete, column_of_values,
              "d with the group part A, shape ({0}): zeros, then the coordinates of A over the generators."},
    KernelRow{"element", discrete, dense_matrix, "The group part W of the arrow, shape ({0}, {1})."},
    KernelRow{"momentum", discrete, column_of_values, "F^-L(g)_a = (->e_a L)(g), shape ({0})."},
    KernelRow{"energy", discrete, number, "E = -dL/dh."},
    KernelRow{"lagrangian", discrete, number, "L(g)."},
    KernelRow{"hamiltonian", discrete, number, "H(t, x, mu), the Legendre transform of [lagrangian].", true},
    KernelRow{"algebra_element", mechanical, column_of_values_checked,
              "The element xi(t, s) of the Lie algebra by which a group moves lanes of the state, s' = A(xi) s; shape "
              "({0})."},
    KernelRow{"algebra_action", mechanical, column_of_values,
              "A(xi) s, linear in xi and in the lanes that the group moves; 0 in the others."},
    KernelRow{"algebra_bracket", mechanical, column_of_values,
              "[xi, eta], shape ({0}): A([xi, eta]) = A(eta) A(xi) - A(xi) A(eta)."},
    KernelRow{"events", flow, column_of_values, "Events: each happens where its value crosses 0."},
    KernelRow{"jumps", mechanical | first_order, dense_matrix,
              "The states behind jumps at s, shape ({0}, {1}): column k is that behind the event jumps_names[k]."},
};

} // namespace

std::span<const KernelRow> kernel_table()
{
    return kernel_rows;
}

const KernelRow& kernel_row(const std::string& name, FormKind form)
{
    const auto* const row = std::ranges::find_if(
        kernel_rows, [&](const KernelRow& each) { return name == each.name && has_form(each, form); });
    if (row == kernel_rows.end())
        throw InternalError(std::string("the form ") + entry_of(form).name + " has no kernel " + name);
    return *row;
}

} // namespace lagen
