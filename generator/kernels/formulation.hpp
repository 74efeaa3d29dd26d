// SPDX-License-Identifier: GPL-2.0-or-later
/// A form of the equations as nodes of a graph: what every kernel is made from. Names that observables, events and
/// invariants may use are in `binding`; what the model declares wins.
///   lagrange    state (x, y):   W ydot = rho_a(L) + Q_a - (d2L/dydx) rho y - d2L/dydt - p_c C^c_ab y^b
///   hamilton    state (x, mu):  xdot = rho dH/dmu, mudot_a = -(rho_a(H) + mu_c C^c_ab dH/dmu_b) + Q_a
///   pontryagin  state (x, mu):  the same with H = mu_a sigma^a - cost where u maximises it          [Martinez 2004]
///   first_order state x:         xdot as it is given
///   discrete    state (x, g, mu):  mu = F^-L(g),  F^+L(g) = F^-L(g') where t(g) = s(g')             [Martinez 2001]
#pragma once

#include "graph/core/lower.hpp"
#include "graph/kernel.hpp"
#include "mechanics/hamilton.hpp"
#include "model/scene_form.hpp"
#include "verify/verify.hpp"

namespace lagen {

struct Formulation {
    const EquationForm* form = nullptr;
    NodeId time = 0;
    std::vector<NodeId> parameters;
    std::vector<NodeId> x;                  ///< x^i, shape (n)
    std::vector<NodeId> lanes;              ///< the other lanes of the state, shape (r)
    std::vector<NodeId> states;             ///< first-order states, the last lanes
    std::vector<NodeId> inputs;             ///< of the system
    std::vector<NamedTree> given_inputs;    ///< of a scene, with their values
    std::vector<NodeId> derivative;         ///< of x, then of the lanes, then of the states
    std::vector<NodeId> pivots;             ///< 1 x 1 blocks of what is solved for the derivative
    std::vector<std::string> documentation; ///< of the right-hand side
    std::string failures;                   ///< of the right-hand side, as in KernelChecks
    std::vector<ImplicitBlock> implicit;
    std::vector<Kernel> kernels;                 ///< of this form alone, in order; empty outputs are left out
    std::vector<Kernel> constants;               ///< the same, free of time and state
    std::vector<LaneGroup> groups;               ///< of x and the lanes; empty: Base and those of the form
    std::optional<StepNumbers> step;             ///< discrete
    std::optional<HamiltonianNodes> hamiltonian; ///< of Hamilton's form
    /// As in KernelModule: what this form asks of the parameters, beside the domain.
    std::vector<std::pair<std::string, NodeId>> parameter_conditions;
    Binding binding;
};

/// What a form is made with.
struct FormulationRequest {
    bool hessians = false;           ///< kernels of the second derivatives of L and H
    bool inverse_dynamics = false;   ///< its kernel, where accelerations determine the inputs
    bool hamiltonian = false;        ///< of a discrete form: H of [lagrangian] beside it
    std::vector<std::size_t> states; ///< numbers of the first-order states that it carries
    std::vector<NamedTree> inputs;   ///< those that a scene gives, over t, x, y, first-order states and parameters
};

/// Throw MathematicsError where the system has no such form: no L, no H, no control problem, no discrete Lagrangian; a
/// degenerate L; a Hamiltonian that the controls do not maximise in a way that can be solved for. `graph`: a copy of
/// the system's.
[[nodiscard]] Formulation lagrange_form(Graph& graph, const System& system, const Report& report,
                                        const FormulationRequest& request);
[[nodiscard]] Formulation hamilton_form(Graph& graph, const System& system, const Report& report,
                                        const FormulationRequest& request);
[[nodiscard]] Formulation pontryagin_form(Graph& graph, const Model& model, const System& system, const Report& report,
                                          const FormulationRequest& request);
[[nodiscard]] Formulation discrete_form(Graph& graph, const Model& model, const System& system, const Report& report,
                                        const FormulationRequest& request);
[[nodiscard]] Formulation first_order_form(Graph& graph, const System& system, const FormulationRequest& request);

/// That of the form `kind`.
[[nodiscard]] Formulation formulation(Graph& graph, const Model& model, const System& system, const Report& report,
                                      FormKind kind, const FormulationRequest& request);

/// A form without motion, names and kernels: what all of them share. `lanes`: y, mu, ..
[[nodiscard]] Formulation empty_form(const System& system, FormKind form, std::vector<NodeId> lanes,
                                     const FormulationRequest& request);
/// Takes the rates and the names of a system on E*, and of the system itself.
void set_motion(Graph& graph, const System& system, const PhaseSystem& phase, Formulation& form);
/// Appends the rates of the states that the form carries, once its names are bound.
void append_state_rates(Graph& graph, const System& system, Formulation& form);
/// Binds t, parameters and base coordinates, which win over what is bound already; inputs at last.
void bind_system(Graph& graph, const System& system, Formulation& form);

/// What is known of W for every value of the parameters. (What holds for the file's values alone says nothing of a
/// header whose parameters may be changed.)
[[nodiscard]] MatrixStructure mass_structure(const Regularity& regularity);
/// Throws MathematicsError, which names `form`, where there is no L or it is degenerate.
void require_regular_lagrangian(const System& system, const Regularity& regularity, const char* form);
/// Entries of an r x r matrix that are alone in their row and column and no constants: divisors of a solve.
[[nodiscard]] std::vector<NodeId> single_blocks(const Graph& graph, const std::vector<NodeId>& W, std::size_t r);

/// Kernels and names of a form that has its derivative: ambient_velocity, reaction (reaction.Y), and where there is a
/// drift moving_energy and the power of the energy. `nodes`: at the lanes of the form.
void add_constrained(Graph& graph, const System& system, const ConstrainedNodes& nodes, Formulation& form);

/// Where the sections follow from constraints, what these were solved by is a divisor too.
void add_minor(const Graph& graph, const System& system, Formulation& form);

/// A column of all entries.
[[nodiscard]] KernelOutput column(std::string name, const std::vector<NodeId>& values);
/// The entries of a rows x columns matrix that are no zeros by structure.
[[nodiscard]] KernelOutput matrix(const Graph& graph, std::string name, std::size_t rows, std::size_t columns,
                                  const std::vector<NodeId>& values);
/// The entries that `rows` have along unit vectors in the place of `directions`, but zeros by structure.
[[nodiscard]] KernelOutput entries_along(const Graph& graph, std::string name, const std::vector<NodeId>& rows,
                                         const std::vector<NodeId>& directions);
/// The lanes of the state: x, then the others.
[[nodiscard]] std::vector<NodeId> state_of(const Formulation& form);
/// A kernel at (t, s) as its row in the table of kernels says; its inputs are not there yet.
[[nodiscard]] Kernel table_kernel(const Formulation& form, const std::string& name, KernelOutput output);
[[nodiscard]] Kernel scalar_kernel(const Formulation& form, const std::string& name, NodeId value);
/// The derivatives of `first` = df/ds with respect to the state, through the implicit blocks.
[[nodiscard]] Kernel hessian_kernel(Graph& graph, const Formulation& form, const std::string& name,
                                    const std::vector<NodeId>& first);

} // namespace lagen
