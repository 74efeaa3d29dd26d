// SPDX-License-Identifier: GPL-2.0-or-later
/// The portfolio: the same outputs as written, with like terms collected and common factors drawn out, and expanded
/// under a term budget and factored again; the form with the least weighted operations is kept.
#pragma once

#include "graph/core/graph.hpp"

#include <string>

namespace lagen {

/// Operation counts of what is reachable from some roots.
struct OperationCount {
    std::size_t additions = 0; ///< + - and unary minus that is not absorbed
    std::size_t multiplications = 0;
    std::size_t divisions = 0;
    std::size_t functions = 0; ///< sin and cos of one angle count once
    std::size_t solves = 0;
    double weight = 0; ///< sum of the weights of the operator table
};

[[nodiscard]] OperationCount count_operations(const Graph& graph, std::span<const NodeId> roots);

/// The terms of the node with all products and small powers multiplied out, none of them collected; `most` where there
/// are more. A function is one term.
[[nodiscard]] std::size_t expanded_terms(const Graph& graph, NodeId node, std::size_t most);

/// The same values in the cheapest form found. Nodes of the result live in the same graph. Equalities of real numbers
/// only: rational algebra, sqrt(a)^2 = a, sin^2 + cos^2 = 1, sums of angles. The values agree wherever the original is
/// defined; where it is not (0/0 from x/x), the result may be. A shared reciprocal narrows the range: x/w is x * (1/w)
/// where several terms need it, so that a divisor below 1/max (6e-309 in double, 3e-39 in float) overflows.
/// Careful forms survive: an output takes a new form only where that does not lose digits
/// (graph/simplify/probe_rounding.hpp). Cheap candidates that lose digits near a cancellation are (a - b)^2 multiplied
/// out or 2 x (y + 1/2) as x + 2 x y; among the models of models/ the check refuses such forms for the double pendulum
/// and for Henon-Heiles. Same outputs, same graph, same result; outputs that reach more than 50,000 nodes stay as they
/// are. Linear systems whose matrix is a remembered Hessian (Graph::remember_hessian) may be solved through its terms,
/// where that costs less (graph/elimination/sparse_hessian.hpp).
[[nodiscard]] std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs);

/// What a line of a report is about: one pass over a form of the portfolio, or outputs that are finished.
enum class Stage {
    pass,       ///< one pass over one form
    lightest,   ///< the lightest form that keeps its digits
    mixed,      ///< outputs of several forms: the end of a search
    eliminated, ///< solved through the terms of a Hessian: the end of a search that another may follow
};
[[nodiscard]] const char* to_text(Stage stage);

/// What one pass made of one form of the portfolio, or a stage of the outputs.
struct PassReport {
    std::string form; ///< "flattened, shared, factored": the choices of the strategy; of a stage its text
    std::string pass; ///< "factor pairs shared"; empty of a stage
    OperationCount before;
    OperationCount after;
    Stage stage = Stage::pass;
};

/// A named term of the result with the operations that it adds to those of the terms in it.
struct CostlyTerm {
    std::string text;
    double weight = 0;
    std::size_t uses = 0;
};

/// Everything that was tried, in order, and what it came to.
struct SimplifyReport {
    OperationCount written;
    std::vector<PassReport> passes;
    OperationCount kept;
    std::vector<CostlyTerm> costliest; ///< by weight, the heaviest first
};

/// The same; `divisors` receives what rows of matrices were divided by, and the pivots of eliminations: where one of
/// these is zero, a matrix that stood in the outputs is singular, and the new one may not be. `report`, where it is not
/// null, receives what was tried; the result does not depend on it.
[[nodiscard]] std::vector<NodeId> simplify(Graph& graph, std::span<const NodeId> outputs, std::vector<NodeId>& divisors,
                                           SimplifyReport* report = nullptr);

/// The `count` terms of the outputs that cost most.
[[nodiscard]] std::vector<CostlyTerm> costliest_terms(const Graph& graph, std::span<const NodeId> outputs,
                                                      std::size_t count);

} // namespace lagen
