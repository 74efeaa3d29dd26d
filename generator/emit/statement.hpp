// SPDX-License-Identifier: GPL-2.0-or-later
/// A function body between the graph and a language: statements of expressions over named variables. The passes before
/// work on nodes; a printer makes text of statements, and needs nothing else.
#pragma once

#include "graph/core/graph.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lagen {

/// An operator of the operator table on its operands; a variable with operands is the call of a function.
struct Expression {
    Op op = Op::input;         ///< constant: `value`; input: the variable `name`
    std::uint32_t payload = 0; ///< the exponent of a power, the order of a Stumpff function
    Rational value = {};
    std::string name = {};                 ///< of select: the type of what it chooses between
    std::optional<std::size_t> entry = {}; ///< of the array `name`
    std::vector<Expression> operands = {};

    [[nodiscard]] bool is_variable() const { return op == Op::input; }
};

[[nodiscard]] Expression variable(std::string name, std::optional<std::size_t> entry = {});
[[nodiscard]] Expression literal(const Rational& value);
[[nodiscard]] Expression operation(Op op, Expression a);
[[nodiscard]] Expression operation(Op op, Expression a, Expression b);

/// n: the number of `expressions`.
struct Statement {
    enum class Kind {
        load,        ///< the input `node` gets its local name; the printer knows where it stands
        define,      ///< names[0] = expressions[0]
        angles,      ///< names[0], names[1]: sine and cosine of expressions[0]; arrays of n where there are several
        roots,       ///< array names[0] of n square roots
        reciprocals, ///< array names[0] of n reciprocals
        terms,       ///< vector names[0] = expressions[0], lanes of alike terms; names[1], where it is, its lanes
        stumpff,     ///< array names[0] of c_k(expressions[0]), index <= k <= last
        factor,      ///< names[0] = the pivoted LU of a matrix of the order `index`, n entries by rows
        solve,       ///< array names[0]: the solution by the LU names[1] for n right-hand sides
        check,       ///< fails where expressions[0] is 0; with a second, where it is at most its rounding error, that
                     ///< of elimination in a matrix of the order `index`, relative to expressions[1]
        store,       ///< the output `index` = expressions[0]
        keep,        ///< the place `index` of the workspace = expressions[0]
        recall,      ///< names[0] = the place `index` of the workspace
    } kind = Kind::define;
    std::vector<std::string> names = {}; ///< that it defines, but names[1] of `solve`
    std::vector<Expression> expressions = {};
    std::size_t index = 0;
    std::size_t last = 0;
    NodeId node = 0;
    bool checked = false;   ///< factor: fails where the matrix is singular
    std::string type = "S"; ///< of what it defines
};

/// Statements one after the other; longer bodies are several of them, which hand values on by a workspace.
using BodyPart = std::vector<Statement>;

struct Body {
    std::vector<BodyPart> parts;
    std::size_t workspace = 0;           ///< places
    std::vector<NodeId> inputs;          ///< that are read, ascending
    std::string type = "S";              ///< of the places
    std::vector<std::string> terms = {}; ///< names of the groups of terms
};

/// True where a statement may fail.
[[nodiscard]] bool has_checks(const BodyPart& part);
[[nodiscard]] bool has_checks(const Body& body);
[[nodiscard]] bool contains(const Body& body, Statement::Kind kind);

/// The operators of all expressions.
[[nodiscard]] std::set<Op> operators_in(const Body& body);

} // namespace lagen
