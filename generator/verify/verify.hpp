// SPDX-License-Identifier: GPL-2.0-or-later
/// The structure equations and the other claims of a model, each proved, refuted or undecided.
///   antisymmetry  C^c_ab + C^c_ba = 0                                       (where both orders are given)
///   anchor        rho_a(rho^i_b) - rho_b(rho^i_a) - rho^i_c C^c_ab = 0       a < b, all i
///   jacobi        sum_cyc(a,b,c) [ rho_a(C^v_bc) + C^m_bc C^v_am ] = 0       a < b < c, all v
///   tangency      rho_a(h) = 0 on M for each base constraint h
///   casimir       rho_a(f) = 0
///   unit          x.1 = x                                                     of an action groupoid
///   action        x.(W W') = (x.W).W'                                         likewise
///   algebroid_of_groupoid   rho and C are those of the groupoid               (where both are given)
///   closed        d A = 0, by components (A, a, b, ..)                        of E-forms that claim it
///   equals        A - B = 0, by components (A, a, ..)
///   legendre      H(t, x, dL/dy) = y^a dL/dy^a - L                            (where both are given)
///   independent   sections (else constraints) of a nonholonomic system are so at every point
///   constraint    its sections and drift satisfy the constraints beside them, and there are as many as needed
///   symmetry      s^c(L) = 0 (else of H), (<-s - ->s)(L) = 0 of a discrete L    of the sections of [symmetries]
///   invariant     df/dt = 0 along the equations of motion of the model's default form
/// Of tangency, casimir and invariant a proof says that the rate vanishes wherever the function and the motion are
/// defined; where that leaves holes and jumps `Check::where` names them.
#pragma once

#include "mechanics/system.hpp"
#include "proof/decide.hpp"

namespace lagen {

struct Check {
    std::string name; ///< "anchor", "jacobi", ...
    std::vector<std::string>
        indices; ///< names, e.g. {"w1", "w2", "g3"} for anchor (a, b, i); {"w1","w2","w3","w1"} for jacobi (a, b, c, v)
    Decision decision;
    std::string hint = {};               ///< may be empty
    std::vector<std::string> where = {}; ///< of what is proved there alone: strict conditions, which the domain does
                                         ///< not imply; what is constant may change where a motion crosses them
    std::string meaning = {};            ///< what the residual is, where `name` and `indices` do not tell
};

enum class Verdict { valid, invalid, undecided };
[[nodiscard]] const char* to_text(Verdict verdict);

/// Of the fibre Hessian W = d2L/dy2, or of another matrix that the equations of motion are solved with.
struct Regularity {
    enum class Matrix {
        lagrangian,  ///< d2L/dy2
        hamiltonian, ///< d2H/dmu2, where the model has H and no L
        constrained, ///< d2L/dY2 on a distribution: A_alpha^a A_beta^b d2L/dY^a dY^b
        newton,      ///< N_ab = <-e_b (F^-L_a) of the discrete L
    } of = Matrix::lagrangian;
    enum class Kind { regular, generically_regular, degenerate, absent, undecided } kind = Kind::absent;
    std::size_t rank = 0;               ///< generic rank, by a witness
    bool positive_definite = false;     ///< proved on the whole domain
    bool for_given_parameters = false;  ///< `regular` and `positive_definite` rest on the parameter values of the file
    std::string evidence;               ///< why `undecided`; may be empty
    std::string legendre_obstacle;      ///< why y -> dL/dy is not shown to be one-to-one; empty where it is
    std::vector<Rational> newton_start; ///< a y where dL/dy is defined, if it is not at 0; else empty
    /// The parameters, with their values (nodes of the system's graph), for which alone that is shown; empty: for all.
    std::vector<std::pair<NodeId, NodeId>> legendre_values;
    bool singular_everywhere = false;    ///< generically_regular, but det W = 0 for the parameter values of the file
    std::vector<NamedPoint> singular_at; ///< known singular points
    std::string coordinates;             ///< what those of points and kernels stand for; empty: those of the model
    std::vector<std::string> singular_where; ///< where L is defined W is singular where one of these vanishes, for the
                                             ///< parameter values of the file; empty where that is not known
    std::vector<std::vector<std::pair<std::string, Tree>>>
        kernel; ///< where degenerate: vectors k with W k = 0, proved, as components by fibre coordinate (and inner
                ///< unknown)

    /// H = mu_a X^a(t, x) + f(t, x): x' = rho(X), whatever the momenta are.
    [[nodiscard]] bool is_first_order() const
    {
        return of == Matrix::hamiltonian && kind == Kind::degenerate && rank == 0;
    }
};

/// What is proved for one value of a parameter alone is taken to hold of others that differ from it by less than one
/// part in so many: they are the same number, rounded.
inline constexpr long proved_value_parts = 1'000'000'000'000;

/// True where other values of the parameters might be decided otherwise.
[[nodiscard]] bool rests_on_values(const Regularity& known);

/// Of the controls of Pontryagin's equations.
struct ControlMaximum {
    enum class Kind {
        absent,     ///< no control problem, or not asked
        maximal,    ///< proved: the closed form, dH/du = 0, or a bound, is the maximum of H
        stationary, ///< no bounds: dH/du = 0 is solved, and is not proved to be a maximum
        unsolved,   ///< dH/du = 0 does not determine the controls, or not the maximum between bounds
        nonsmooth,  ///< there is no dH/du
        refuted,    ///< dH/du = 0 is certainly no maximum
    } kind = Kind::absent;
    std::string reason; ///< "d2H/du2 < 0 was not proved"; where `maximal` what is known of angles, else empty
    std::string hint;
    bool on_part = false;                    ///< `maximal`, where H is defined on a convex set of controls alone
    std::vector<Rational> newton_start = {}; ///< u in that set, if 0 is not; else empty
    /// Controls in which H = a + b cos u + c sin u, proved: their maximum is known in closed form, and stands apart
    /// from what is said of the others, which `newton_start` is of too.
    std::vector<std::size_t> angles = {};
};

/// What every text says of stationary controls.
inline constexpr const char* stationary_controls =
    "Stationary controls: dH/du = 0; that H is largest there is not proved.";

/// An E-form of [forms] and whether d of it is zero, which stands outside the verdict.
struct FormReport {
    std::string name;
    std::size_t degree = 0;
    ProofStatus closed = ProofStatus::undecided;
};

/// What is known of the candidate of [hamilton_jacobi]; `lifts` and `action` stand outside the verdict.
struct HamiltonJacobiReport {
    ProofStatus closed = ProofStatus::undecided;
    ProofStatus equation = ProofStatus::undecided; ///< H o alpha is constant on leaves
    ProofStatus lifts = ProofStatus::undecided;    ///< integral curves of rho(F_H o alpha) lift to solutions
    std::optional<ProofStatus> action;             ///< <alpha, sigma> = L o sigma + H o alpha along them; of an L
};

/// Which claims hold: the structure equations of the algebroid, and what else its model says of it.
struct StructureReport {
    std::vector<Check> checks;
    std::size_t trivial = 0; ///< residuals that are zero by structure: counted, not listed
    Verdict verdict = Verdict::undecided;
    std::vector<FormReport> forms;
    std::optional<HamiltonJacobiReport> hamilton_jacobi;
    std::string note; ///< e.g. "no regular point was found: ..."

    /// The check that a residual is zero, by a Judge or what decides like one; zeros by structure are counted.
    template <class Decider>
    void append(const Graph& graph, std::string name, std::vector<std::string> indices, NodeId residual,
                Decider& decider)
    {
        if (graph.is_zero(residual))
            ++trivial;
        else
            checks.push_back({std::move(name), std::move(indices), decider.decide(residual)});
    }
};

/// Says whether the brackets of a distribution's sections lie in it, which stands outside the verdict.
struct Integrability {
    bool has_drift = false;       ///< which plays no part in it
    bool moves_with_time = false; ///< the sections depend on t: brackets are those of one t, and D is no subbundle of E
    ProofStatus status = ProofStatus::undecided;
    // Of the first bracket that does not, where refuted:
    std::vector<std::string> bracket;                            ///< its two sections
    std::vector<std::pair<std::string, std::string>> components; ///< on the ambient frame, as text
    std::string violates;                                        ///< a linear form that vanishes on D and not on it
    std::optional<Witness> witness;
};

/// The energy of a nonholonomic system that has no reactions in its rate, and whether that is zero.
struct ConservedEnergy {
    std::string name; ///< "energy", or "moving_energy" where there is a drift
    ProofStatus status = ProofStatus::undecided;
};

/// Says whether the equations of motion are determined.
struct MechanicsReport {
    Regularity regularity;                    ///< of L, else of H
    Regularity discrete;                      ///< of the discrete L
    std::optional<Integrability> integrable;  ///< of a nonholonomic system
    std::optional<ConservedEnergy> conserved; ///< likewise
};

/// Says whether the equations of motion are those of extremals.
struct ControlReport {
    ControlMaximum maximum;
};

/// `invalid` where a check is refuted, `undecided` where one is or where there is a note.
[[nodiscard]] Verdict verdict_of(const StructureReport& structure);

/// What is known of a system.
struct Report {
    StructureReport structure;
    MechanicsReport mechanics;
    ControlReport control;
};

/// Runs every check that the system calls for, on extra invariants (closed trees from the command line) too. A smaller
/// `budget` leaves more undecided, sooner.
[[nodiscard]] Report verify(const System& system, const std::vector<NamedTree>& extra_invariants = {},
                            const ProofBudget& budget = {});

/// What `verify` says of the fibre Hessian, alone.
[[nodiscard]] Regularity verify_regularity(const System& system);

/// Of a subbundle: a check "involutive" (a, b) for each pair of sections, from its anchor equations.
void append_involutive(StructureReport& structure, const System& system);

/// What `Decision::evidence` says where the construction of an algebroid holds.
inline constexpr const char* construction_argument =
    "by construction: a frame of what is proved to be an algebroid, and its determinant is not zero";

} // namespace lagen
