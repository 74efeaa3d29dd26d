// SPDX-License-Identifier: GPL-2.0-or-later
/// A mechanical or control system on a Lie algebroid, lowered once: everything that is proved, printed or emitted of a
/// model is derived from these nodes. Whoever derives works on a copy of the graph, in which the nodes keep their
/// numbers. It knows nothing of files; a system may be built by hand:
///
///   System system;
///   Graph& graph = system.graph;
///   system.algebroid = lie_algebra(graph, {"w1", "w2", "w3"}, {{0, 1, 2, 1}, {1, 2, 0, 1}, {2, 0, 1, 1}});
///   system.lagrangian = ..;
#pragma once

#include "geometry/form.hpp"
#include "geometry/groupoid.hpp"
#include "geometry/structure_equations.hpp"
#include "graph/core/lower.hpp"
#include "mechanics/written_algebroid.hpp"

#include <optional>

namespace lagen {

/// Optimal control of xdot = rho(sigma(t, x, u)) with the running cost L(t, x, u).
struct ControlProblem {
    std::vector<NodeId> u;     ///< inputs
    std::vector<NodeId> sigma; ///< sigma^a, shape (r)
    NodeId cost = 0;
    std::vector<std::optional<NodeId>> lower, upper; ///< bounds, of each control
    std::vector<NodeId> parts;                       ///< partial operations of sigma and cost as they are written

    [[nodiscard]] bool bounded() const;
};

/// The work of forces in a step, along variations of the start, of the end and of the inner unknowns; empty where
/// there are no forces.
struct DiscreteWork {
    std::vector<NodeId> source, target, inner; ///< f^-_a, f^+_a, shapes (r), (r), (m)
};

/// Of curves exp(xi): the first inner unknowns are xi with exp(xi) = W. L is a function of xi, and W moves with it.
struct ArrowLogarithm {
    std::vector<NodeId> conditions;   ///< f^c(xi, W) = 0, shape (m)
    std::vector<NodeId> differential; ///< D by rows, shape (m, m): d exp(xi) exp(-xi) = D^a_c dxi^c E_a
    std::vector<NodeId> element;      ///< exp(xi) by rows
};

/// A discrete Lagrangian on the system's groupoid.
struct DiscreteSystem {
    NodeId step = 0;                  ///< h: an input, or the value of a bound parameter
    std::optional<NodeId> lagrangian; ///< L over t, h, the arrow's coordinates, the inner unknowns and parameters
    std::vector<NodeId> inner;        ///< inputs w at which L is stationary, of a scheme; shape (m)
    DiscreteWork work;                ///< of a scheme
    std::optional<ArrowLogarithm> logarithm; ///< of a scheme with exp
    bool written = false;                    ///< else a scheme made L
    std::string obstacle, hint;              ///< why there is no L, and what to write
};

/// A Jacobi field along the motion, by first-order states: delta x = rho(sigma), and delta y^a.
struct JacobiField {
    std::vector<NodeId> sigma, delta; ///< shapes (r)
};

/// What of the algebroid stands in the model file as it is here, so that a hint can ask to change it.
struct Editable {
    bool anchor = false;
    bool bracket = false;
    bool constant_bracket = false; ///< the file admits numbers and parameters alone in brackets
};

/// A named E-form with what is claimed of it.
struct FormClaim {
    std::string name;
    ExteriorForm form;
    bool closed = false;                ///< claimed: d of it is zero
    std::optional<ExteriorForm> equals; ///< claimed
    std::vector<NodeId> partial_parts;  ///< of its components as they are written
    std::vector<NodeId> equals_parts;   ///< the functions in `equals`, and their partial parts
};

/// A section alpha of E* that is claimed to solve Hamilton and Jacobi's equation.
struct HamiltonJacobiClaim {
    std::vector<NodeId> alpha; ///< alpha_a over x, shape (r)
    std::vector<NodeId> parts; ///< its partial operations as it is written
};

/// A section s = s^a e_a whose complete lift is claimed to leave L (H, the discrete L) invariant.
struct SymmetryClaim {
    std::string name;
    std::vector<NodeId> s; ///< s^a over x, shape (r)
};

/// An affine distribution b + D in the algebroid, Y = b + y^alpha e_alpha with e_alpha = A_alpha^a e_a, that motions
/// are constrained to: mechanics/nonholonomic.hpp. The system's L, forces and algebroid are those of the ambient Y
/// then.
struct Distribution {
    std::vector<NodeId> y;           ///< inputs y^alpha, shape (k); some of the Y where constraints alone are given
    std::vector<Section> sections;   ///< e_alpha, over x and t
    Section drift;                   ///< b, over x and t; empty: linear constraints
    std::vector<NodeId> constraints; ///< as given, over t, x and Y: 0 on b + D; may be empty
    std::vector<std::string> constraint_texts;
    std::optional<NodeId> minor; ///< what solving the constraints divides by; nothing where sections are given
    bool is_solved = false;      ///< sections and drift follow from the constraints
    bool has_dependent = false;  ///< the constraints are dependent everywhere, and the sections are none of theirs
};

/// The trees that the nodes were lowered from, for what asks how something is written and where.
struct Written {
    WrittenAlgebroid algebroid;
    std::optional<WrittenDistribution> distribution;
    std::vector<NamedTree> invariants;
    std::vector<Tree> phase;       ///< on E* and the controls: H, sigma, cost, bounds
    std::vector<NamedTree> states; ///< first-order states z with z', over what observables may use
    std::vector<Tree> all; ///< definitions, domain, constraints, Casimirs, rho, C, L, forces, observables, events
};

/// A constraint or a Casimir in words.
struct BaseFunctionText {
    std::string name;          ///< of a constraint the text
    std::vector<NodeId> parts; ///< its partial operations as it is written
};

struct System {
    std::string name; ///< of the model
    Graph graph;
    NodeId time = 0;
    std::vector<NodeId> parameters;                          ///< inputs
    std::vector<std::pair<NodeId, NodeId>> parameter_values; ///< with the values of the file
    Algebroid algebroid;
    BaseFunctions functions;                             ///< base constraints and Casimirs
    std::vector<BaseFunctionText> constraints, casimirs; ///< of these
    std::vector<NodeId> domain;                          ///< comparisons that hold on M
    std::vector<NodeId> mu;                              ///< inputs mu_a on E* (on D*), one a velocity
    std::optional<NodeId> lagrangian;                    ///< L(t, x, y), over the ambient Y of a distribution
    std::optional<NodeId> hamiltonian;                   ///< H(t, x, mu)
    std::vector<NodeId>
        rates; ///< xdot^i(t, x, z, u) of a system of first order, shape (n), which has no fibre; or empty
    std::vector<NodeId> states;                          ///< inputs z of [states]
    std::vector<NodeId> inputs;                          ///< inputs u of [inputs]
    std::vector<std::pair<NodeId, NodeId>> input_values; ///< with their defaults, over parameters
    std::optional<JacobiField> jacobi_field;
    std::vector<NodeId> forces;      ///< Q_a(t, x, y, z, u) = [forces] - dR/dy^a, shape (r); empty: none
    std::vector<NodeId> force_parts; ///< the given forces and R, each as it is written
    std::optional<ControlProblem> control;
    std::optional<Groupoid> groupoid;
    bool groupoid_is_claim = false; ///< the algebroid is given beside the groupoid, and claimed to be that of it
    std::optional<DiscreteSystem> discrete;
    std::optional<Distribution> distribution; ///< of a nonholonomic system
    std::vector<SymmetryClaim> symmetries;
    std::vector<FormClaim> forms;
    std::optional<HamiltonJacobiClaim> hamilton_jacobi;
    std::vector<NodeId> partial_parts; ///< must be defined, though folded away: log(-1 - x^2) of 0*log(-1 - x^2)
    bool is_distribution = false;      ///< a subbundle of TM: the anchor equations say that it is involutive
    bool is_level_set = false;         ///< its frame is made of the base constraints, which need not be triangular
    Editable editable;
    Written written;

    [[nodiscard]] std::size_t n() const { return algebroid.n(); }
    [[nodiscard]] std::size_t r() const { return algebroid.r(); }
    /// The lanes of a state behind x: y^a, or y^alpha of a distribution.
    [[nodiscard]] const std::vector<NodeId>& velocities() const { return distribution ? distribution->y : algebroid.y; }
    /// Q_a, zeros where there are none.
    [[nodiscard]] std::vector<NodeId> forces_or_zero(Graph& graph) const;
    /// True where a parameter, a coordinate of E, a first-order state or a control bears this name.
    [[nodiscard]] bool declares(const std::string& name) const;
};

/// Inputs with what is inserted for them: pairs for `substitute`.
using Replacements = std::vector<std::pair<NodeId, NodeId>>;
[[nodiscard]] Replacements replacements(const std::vector<NodeId>& inputs, const std::vector<NodeId>& nodes);

} // namespace lagen
