// SPDX-License-Identifier: GPL-2.0-or-later
/// The cases of tests/data: mechanical systems with trajectories and derivatives at points, and structure functions
/// with their verdicts, as records and as model files of kind `general`. See tests/data/README.md.
#pragma once

#include "support/json.hpp"

#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// "[e_a, e_b] contains value e_c", counted from 0.
struct ReferenceBracket {
    std::size_t a, b, c;
    std::string value;
};

/// d(state)/dt and what goes with it at one state; decimal texts.
struct ReferencePoint {
    std::vector<std::string> state;     ///< base, then fibre
    std::vector<std::string> state_dot; ///< same order
    std::vector<std::string> momenta;   ///< p_a = dL/dy^a, shape (r)
    std::string energy;
    std::vector<std::string> momenta_dot; ///< dp_a/dt = rho_a(L) - p_c C^c_ab y^b, shape (r)
};

struct ReferenceSample {
    std::string t;
    std::vector<std::string> state;
    std::vector<std::string> controls; ///< of control problems
};

struct ReferenceCase {
    std::string name;
    std::string description;
    std::vector<std::string> base;
    std::vector<std::string> fibre;
    std::vector<std::vector<std::string>> rho; ///< rho[i][a] = rho^i_a, shape (n, r)
    std::vector<ReferenceBracket> brackets;
    std::string lagrangian;            ///< empty where there is none
    std::vector<std::string> momenta;  ///< names; empty: those of the model
    std::vector<std::string> controls; ///< of a control problem, else empty
    std::vector<std::string> sigma;    ///< sigma^a, shape (r)
    std::string cost;
    std::string hamiltonian; ///< of a control problem: its value along the extremal
    std::vector<std::pair<std::string, std::string>> parameters;
    std::string t0, t_end;
    std::vector<std::string> initial; ///< base, then fibre
    std::vector<ReferenceSample> samples;
    std::vector<ReferencePoint> points;
};

/// The case in `file`, whose base, fibre, rho, C and L stand in `model`.
[[nodiscard]] ReferenceCase read_reference_case(const json::Value& file, const json::Value& model);

/// Every case of tests/data/continuous, sorted by name.
[[nodiscard]] std::vector<ReferenceCase> read_reference_cases();

/// Every control problem of tests/data/bvp, sorted by name: state (x, mu), started from the known initial costates.
[[nodiscard]] std::vector<ReferenceCase> read_control_cases();

/// The case as a model file of kind `general`, with its start as the scene `default`.
[[nodiscard]] std::string model_text(const ReferenceCase& reference);

/// One entry of tests/data/definitions/definitions.json.
struct ReferenceDefinition {
    ReferenceCase algebroid; ///< name, base, fibre (e1, e2, ...), rho, brackets, parameters (value 1)
    bool valid = false;
    std::vector<std::string> failing; ///< names of the checks that are refuted
};

[[nodiscard]] std::vector<ReferenceDefinition> read_reference_definitions();

/// Source and target of every entry of tests/data/definitions/morphisms.json: all are Lie algebroids.
[[nodiscard]] std::vector<ReferenceCase> read_morphism_algebroids();

} // namespace lagen
