// SPDX-License-Identifier: GPL-2.0-or-later
/// Closed expressions: scalars, vectors and matrices of closed trees with their sizes.
#pragma once

#include "expression/array.hpp"
#include "expression/measure.hpp"
#include "expression/tree_identity.hpp"

#include <optional>

namespace lagen {

/// An index that is many, 2..n, or ':' without arguments: an application of what no text can call.
inline constexpr std::string_view range_name = "..";
[[nodiscard]] inline bool is_range(const TreeNode& node)
{
    return node.kind == TreeKind::apply && node.name == range_name;
}

/// A closed tree with its size.
struct ClosedTree {
    Tree tree; ///< null: not asked for yet
    Measure measure;
};

/// A scalar, vector or matrix. Entries are made when they are asked for: x[3] of a family of thousands is one name, and
/// inverse(A)*b needs no inverse.
struct Closed {
    Shape shape;
    std::vector<ClosedTree> entries;    ///< by rows; empty or null trees where they are not made yet
    std::string family;                 ///< not empty: the entries are the symbols entry_name(family, shape, k)
    std::shared_ptr<Closed> inverse_of; ///< not null: the inverse of that matrix
    /// The ends of an index that is a range, nothing for one that is no integer constant. A range poses as a scalar.
    std::vector<std::optional<long>> range;

    /// In a function's body that is checked on its own, a parameter of unknown shape and what depends on it. It poses
    /// as a scalar, and nothing is said of shapes.
    bool open = false;
    bool neutral = false;              ///< the 0 of an empty sum, which is the zero of every shape
    std::optional<std::size_t> number; ///< the same for values with the same entries, within one expansion
};
using Value = std::shared_ptr<Closed>;

/// The bounds of the parser; several definitions may stand inside one another, and products grow beyond their texts.
inline constexpr std::size_t deepest_closed = 2000;
[[nodiscard]] const ParseLimits& closing_limits();

[[nodiscard]] Value scalar(ClosedTree tree);

/// The value of a scalar that is an integer constant: index arithmetic is exact.
[[nodiscard]] std::optional<long> integer_of(const Closed& value);

/// Counts the operations of what is written out, up to a bound that its error names.
struct Budget {
    std::size_t spent = 0;
    const char* message; ///< with one {} for the bound
    const char* hint;

    void spend(std::size_t operations, const SourceRange& where);
};

/// Makes closed nodes, measured and counted. `add` .. `power` fold zeros and ones of arrays as they go and draw signs
/// out of products: hat matrices are mostly zeros.
class Maker {
  public:
    Maker(Budget& budget, SignedIdentity& identity, SourceRange where)
        : budget_(budget), identity_(identity), where_(std::move(where))
    {
    }

    [[nodiscard]] const SourceRange& where() const { return where_; }
    [[nodiscard]] SignedIdentity& identity() const { return identity_; }

    /// The node itself where its arguments are closed already, else a copy with closed arguments; the number that a
    /// sine of a right angle is.
    [[nodiscard]] ClosedTree operation(const Tree& tree, std::vector<ClosedTree> arguments) const;
    /// All of the terms or factors as they are.
    [[nodiscard]] ClosedTree join(TreeKind kind, std::vector<ClosedTree> arguments) const
    {
        return make(kind, std::move(arguments));
    }
    /// Counts operations.
    void count(std::size_t operations = 1) const { budget_.spend(operations, where_); }
    [[nodiscard]] ClosedTree number(const Rational& value) const;
    [[nodiscard]] ClosedTree negate(const ClosedTree& a) const;
    [[nodiscard]] ClosedTree add(std::vector<ClosedTree> terms) const;
    [[nodiscard]] ClosedTree subtract(const ClosedTree& a, const ClosedTree& b) const { return add({a, negate(b)}); }
    [[nodiscard]] ClosedTree multiply(std::vector<ClosedTree> factors) const;
    [[nodiscard]] ClosedTree divide(const ClosedTree& a, const ClosedTree& b) const;
    [[nodiscard]] ClosedTree square(const ClosedTree& a) const;
    [[nodiscard]] ClosedTree call(Function function, std::vector<ClosedTree> arguments) const;
    /// Component k of A^-1 b.
    [[nodiscard]] ClosedTree solve(std::vector<ClosedTree> matrix, const std::vector<ClosedTree>& right,
                                   std::size_t k) const;

    /// The entry k, or all of them, made where they are not there yet.
    const ClosedTree& entry(Closed& value, std::size_t k) const;
    const std::vector<ClosedTree>& entries(Closed& value) const;

    [[noreturn]] void fail(const std::string& message, const std::string& hint) const;

  private:
    [[nodiscard]] ClosedTree make(TreeNode node, std::vector<ClosedTree> arguments) const;
    [[nodiscard]] ClosedTree make(TreeKind kind, std::vector<ClosedTree> arguments) const;

    Budget& budget_;
    SignedIdentity& identity_;
    SourceRange where_;
};

/// Throws ModelError: more than 4096 entries.
void require_size(const Maker& maker, const Shape& shape);
/// A value of the shape with these entries.
[[nodiscard]] Value array_value(const Maker& maker, const Shape& shape, std::vector<ClosedTree> entries);

[[nodiscard]] Shape vector_shape(std::size_t n);
[[nodiscard]] Shape matrix_shape(std::size_t rows, std::size_t columns);
[[nodiscard]] bool is_number(const ClosedTree& entry, long value);

} // namespace lagen
