// SPDX-License-Identifier: GPL-2.0-or-later
/// The syntax tree of the expression language: what a user wrote, with exact numbers and positions.
/// Trees are immutable and shared, so a definition that is used twice is one tree with two parents; every walk over
/// trees memoises by address or it could take exponential time.
#pragma once

#include "expression/functions.hpp"
#include "text/diagnostic.hpp"

#include <gmpxx.h>

#include <memory>
#include <string>
#include <vector>

namespace lagen {

using Rational = mpq_class; ///< always canonical

/// The length of numerator and denominator together, in bits.
[[nodiscard]] inline std::size_t bits_of(const Rational& value)
{
    return mpz_sizeinbase(value.get_num_mpz_t(), 2) + mpz_sizeinbase(value.get_den_mpz_t(), 2);
}

enum class TreeKind {
    number,   ///< `number`
    pi,       ///< the constant; as parsed (then with its name) what a model declares as "pi" may still take its place
    name,     ///< a symbol: coordinate, parameter, time, or (before expansion) a definition
    negate,   ///< -arguments[0]
    add,      ///< arguments[0] + arguments[1] + ... (n-ary; a - b is add(a, negate(b)))
    multiply, ///< arguments[0] * arguments[1] * ... (n-ary)
    divide,   ///< arguments[0] / arguments[1]
    power,    ///< arguments[0] ^ arguments[1]
    call,     ///< built-in `function` of the arguments
    apply,    ///< a function of the model, `name`(arguments); gone after expansion
    compare,  ///< arguments[0] `comparison` arguments[1]; in domains and in the condition of if(c, a, b)
    solve,    ///< component `number` (from 0) of A^-1 b: arguments are the m*m entries of A by rows, then the m of b
    // Gone after closing:
    array,        ///< [a, b, c]; a matrix is an array of arrays, its rows
    index,        ///< arguments[0] [ arguments[1] ] or [ arguments[1], arguments[2] ], counted from 1
    sum_over,     ///< sum(`name`, arguments[0], arguments[1], arguments[2]): from, to, body; empty: 0
    product_over, ///< product(..), likewise; empty: 1
};

struct TreeNode;
using Tree = std::shared_ptr<const TreeNode>;

struct TreeNode {
    TreeKind kind = TreeKind::number;
    Rational number;                          ///< of `number`
    std::string name;                         ///< of `name` and `apply`; the index of `sum_over`, `product_over`
    Function function = Function::sin;        ///< of `call`
    Comparison comparison = Comparison::less; ///< of `compare`
    std::vector<Tree> arguments;
    SourceRange where; ///< the text of this very sub-expression

    ~TreeNode(); ///< iterative: a deep tree does not overflow the stack when it goes
};

// Builders, for tests and for the stages that make trees. They do not simplify.
[[nodiscard]] Tree number(Rational value, SourceRange where = {});
[[nodiscard]] Tree name(std::string symbol, SourceRange where = {});
[[nodiscard]] Tree negate(Tree a);
[[nodiscard]] Tree add(std::vector<Tree> terms);
[[nodiscard]] Tree multiply(std::vector<Tree> factors);
[[nodiscard]] Tree divide(Tree a, Tree b);
[[nodiscard]] Tree power(Tree base, Tree exponent);
[[nodiscard]] Tree call(Function function, std::vector<Tree> arguments);
[[nodiscard]] Tree compare(Comparison comparison, Tree a, Tree b);
[[nodiscard]] Tree constant_pi(SourceRange where = {});
[[nodiscard]] Tree application(std::string function, std::vector<Tree> arguments); ///< TreeKind::apply
/// Component k (from 0) of A^-1 b; `matrix` has m*m entries by rows, `right` m.
[[nodiscard]] Tree solve_component(std::vector<Tree> matrix, const std::vector<Tree>& right, std::size_t k);
/// The unknowns m of a TreeKind::solve with m*m + m arguments.
[[nodiscard]] std::size_t solve_order(std::size_t arguments);

/// The text of a tree in the expression language, with the fewest parentheses: parse(to_text(t)) has the value of t.
/// A number prints as an integer, a fraction p/q, or a finite decimal where that is shorter (21e399 where it
/// would be long). Brackets that only regroup a sum or a product are dropped. A text above 10^6 characters (a shared
/// tree written out) is cut and ends with "...".
[[nodiscard]] std::string to_text(const Tree& tree);

/// The names that occur in a tree, in order of first occurrence (depth first, left to right).
[[nodiscard]] std::vector<std::string> names_in(const Tree& tree);

/// True where `name` occurs in the tree.
[[nodiscard]] bool mentions(const Tree& tree, const std::string& name);

/// Same structure, numbers and names (positions aside).
[[nodiscard]] bool same_tree(const Tree& a, const Tree& b);

} // namespace lagen
