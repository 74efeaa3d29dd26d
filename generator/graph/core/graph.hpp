// SPDX-License-Identifier: GPL-2.0-or-later
/// The hash-consed expression graph. Equal sub-expressions are the same node: sharing is not a pass and cannot miss.
/// Nodes are numbered in order of creation, operands always have smaller numbers than their users, so that "for id in
/// 0..size" is a topological walk and nothing ever recurses. It knows nothing of mechanics.
#pragma once

#include "expression/tree.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace lagen {

using NodeId = std::uint32_t;

/// One entry a node kind; value, derivative, cost and spelling of each stand in graph/operators.*, nowhere else.
enum class Op : std::uint8_t {
    constant, ///< exact rational, `value(id)`
    pi,
    input, ///< a named input, `input_name(id)`
    add,
    subtract,
    multiply,
    divide,
    negate,
    power,      ///< integer power, exponent `payload(id)` (as int32_t), never 0 or 1; negative allowed
    real_power, ///< a^b for anything else
    sqrt,
    sin,
    cos,
    tan,
    asin,
    acos,
    atan,
    atan2,
    sinh,
    cosh,
    tanh,
    exp,
    log,
    abs,
    minimum,
    maximum,
    sign,
    stumpff, ///< c_k(z) = sum_j (-z)^j / (2j+k)!; payload: k
    erf,
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal, ///< 1 or 0
    select,    ///< operands c, a, b: a where c != 0, else b
    factor,    ///< factorisation of an n x n matrix; operands: its n*n entries by rows; payload: MatrixStructure
    solve,     ///< operands: a `factor` node, then the n entries of b; z = A^-1 b
    component, ///< operand: a `solve` node; payload: k, the entry z_k
};

/// What is known of a matrix that is factorised.
enum class MatrixStructure : std::uint32_t {
    general,           ///< row-pivoted LU
    symmetric,         ///< symmetric, definiteness unknown: pivoted
    positive_definite, ///< proved: LDL^T without pivoting
};

/// Where a matrix comes from: its entry (a, b) is d2 value / d variables[a] d variables[b].
struct HessianOrigin {
    NodeId value = 0;
    std::vector<NodeId> variables; ///< inputs
};

/// A divisor is the constant 0, or the base of a negative power.
class DivisionByZero : public MathematicsError {
  public:
    using MathematicsError::MathematicsError;
};

class Graph {
  public:
    // Leaves.
    NodeId constant(const Rational& value);
    NodeId constant(long value) { return constant(Rational(value)); }
    NodeId pi();
    NodeId input(const std::string& name); ///< the same name is the same node
    /// From now on `name` is `value`: input(name) answers it. Throws InternalError where the name is known already.
    void bind(const std::string& name, NodeId value);

    // Operations. Each applies the exact local rules that hold everywhere the operands are defined (x + 0, 1 * x,
    // constants folded exactly, -(-x), x - x, x + x = 2 x, x * x = x^2, a sign pulled out of products, 0 * x = 0), then
    // interns. Terms and factors keep the order in which they were first written; a number is the first factor.
    NodeId add(NodeId a, NodeId b);
    NodeId subtract(NodeId a, NodeId b);
    NodeId multiply(NodeId a, NodeId b);
    NodeId divide(NodeId a, NodeId b); ///< throws DivisionByZero where b is the constant 0
    NodeId negate(NodeId a);
    NodeId power(NodeId a, int exponent);
    NodeId apply(Op op, NodeId a);           ///< sqrt .. abs, sign
    NodeId apply(Op op, NodeId a, NodeId b); ///< real_power, atan2, minimum, maximum, comparisons
    NodeId select(NodeId condition, NodeId a, NodeId b);
    /// Any operation but leaves and linear algebra, by the functions above and below.
    NodeId make(Op op, std::uint32_t payload, std::span<const NodeId> operands);
    /// c_k(z), 1/k! at the constant 0. Throws MathematicsError where k > largest_stumpff_order.
    NodeId stumpff(unsigned k, NodeId z);
    /// The components z_0 .. z_{n-1} of A^-1 b; `matrix` has n*n entries by rows. n = 1 is a division; a diagonal or
    /// block-diagonal matrix is split into its blocks, so that only coupled unknowns share a factorisation.
    std::vector<NodeId> solve(std::span<const NodeId> matrix, std::span<const NodeId> right, MatrixStructure structure);
    /// Several right-hand sides: columns[k] is a vector of n entries; one factorisation.
    std::vector<std::vector<NodeId>> solve(std::span<const NodeId> matrix,
                                           const std::vector<std::vector<NodeId>>& columns, MatrixStructure structure);

    /// Notes that `matrix` (positive definite, n*n entries by rows) is the Hessian of `value`, which its factorisations
    /// cannot tell: `simplify` then may solve with it through the intermediate terms of `value`.
    void remember_hessian(std::span<const NodeId> matrix, std::span<const NodeId> variables, NodeId value);

    NodeId sum(std::span<const NodeId> terms);       ///< left to right; empty: 0
    NodeId product(std::span<const NodeId> factors); ///< left to right; empty: 1

    // Reading.
    [[nodiscard]] std::size_t size() const { return ops_.size(); }
    [[nodiscard]] Op op(NodeId id) const { return ops_[id]; }
    [[nodiscard]] std::span<const NodeId> operands(NodeId id) const;
    [[nodiscard]] std::uint32_t payload(NodeId id) const { return payloads_[id]; }
    /// Of a constant, and of an input; the reference stays valid while nodes are added.
    [[nodiscard]] const Rational& value(NodeId id) const;
    [[nodiscard]] const std::string& input_name(NodeId id) const;
    [[nodiscard]] bool is_constant(NodeId id) const { return ops_[id] == Op::constant; }
    [[nodiscard]] bool is_zero(NodeId id) const; ///< the constant 0 (structurally; not a proof of anything else)
    [[nodiscard]] bool is_one(NodeId id) const;
    [[nodiscard]] const std::vector<NodeId>& inputs() const { return inputs_; } ///< in order of declaration
    /// What remember_hessian() knows of a `factor`; null where it knows nothing.
    [[nodiscard]] const HessianOrigin* hessian_origin(NodeId factor) const;

  private:
    NodeId intern(Op op, std::span<const NodeId> operands, std::uint32_t payload);

    std::vector<Op> ops_;
    std::vector<std::uint32_t> payloads_;
    std::vector<std::uint32_t> first_; ///< start of the operands in `operands_`; size() + 1 entries
    std::vector<NodeId> operands_;
    std::deque<Rational> constants_; ///< value() and input_name() stay valid while nodes are added
    std::deque<std::string> names_;
    std::vector<NodeId> inputs_;
    std::unordered_map<std::string, NodeId> input_ids_;
    std::unordered_map<std::string, NodeId> constant_ids_;
    std::map<NodeId, HessianOrigin> hessians_;           ///< by factor
    std::unordered_multimap<std::size_t, NodeId> table_; ///< structural hash -> id; looked up, never iterated
};

/// The nodes that `roots` depend on, themselves included, in ascending (topological) order.
[[nodiscard]] std::vector<NodeId> reachable(const Graph& graph, std::span<const NodeId> roots);

/// Those of them that are evaluated whichever branches of `select` are taken, in ascending order.
[[nodiscard]] std::vector<NodeId> certainly_needed(const Graph& graph, std::span<const NodeId> roots);

/// For every node of the graph: is it one of `inputs`, or does it depend on one?
[[nodiscard]] std::vector<bool> depends_on(const Graph& graph, std::span<const NodeId> inputs);

/// Is one of `nodes` one of `inputs`, or does one depend on one?
[[nodiscard]] bool depends_on_any(const Graph& graph, std::span<const NodeId> nodes, std::span<const NodeId> inputs);

/// The node as a readable text, for tests and messages; shared parts are written out, cut at `limit` characters with
/// "...".
[[nodiscard]] std::string to_text(const Graph& graph, NodeId id, std::size_t limit = 400);

} // namespace lagen
