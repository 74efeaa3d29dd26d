// SPDX-License-Identifier: GPL-2.0-or-later
/// The functions of vectors and matrices, all but rotations.
#include "expression/combine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>

namespace lagen {

namespace {

constexpr std::size_t largest_determinant = 8;

[[noreturn]] void refuse_argument(const Tree& tree, std::size_t k, const Shape& shape, const char* wanted)
{
    const char* function = entry_of(tree->function).name;
    refuse(tree->arguments[k], fmt::format("an argument of {} is {}", function, to_text(shape)),
           fmt::format("{} takes {}", function, wanted));
}

void require_square(const Tree& tree, const Shape& shape)
{
    if (shape.rank != Rank::matrix || shape.rows != shape.columns) refuse_argument(tree, 0, shape, "a square matrix");
}

ClosedTree product_of(const Maker& maker, const ClosedTree& a, const ClosedTree& b)
{
    return a.tree == b.tree ? maker.square(a) : maker.multiply({a, b});
}

ClosedTree dot_entries(const Maker& maker, const Value& a, const Value& b)
{
    std::vector<ClosedTree> terms;
    for (std::size_t k = 0; k < a->shape.rows; ++k)
        terms.push_back(product_of(maker, maker.entry(*a, k), maker.entry(*b, k)));
    return maker.add(std::move(terms));
}

Value dot(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    for (std::size_t k = 0; k < 2; ++k)
        if (arguments[k]->shape.rank != Rank::vector) refuse_argument(tree, k, arguments[k]->shape, "two vectors");
    if (arguments[0]->shape != arguments[1]->shape)
        refuse(tree,
               fmt::format("dot is taken of {} and {}", to_text(arguments[0]->shape), to_text(arguments[1]->shape)),
               "the two vectors have the same length");
    return scalar(dot_entries(maker, arguments[0], arguments[1]));
}

Value cross(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    for (std::size_t k = 0; k < 2; ++k)
        if (arguments[k]->shape != vector_shape(3)) refuse_argument(tree, k, arguments[k]->shape, "two vectors of 3");
    const std::vector<ClosedTree>& a = maker.entries(*arguments[0]);
    const std::vector<ClosedTree>& b = maker.entries(*arguments[1]);
    std::vector<ClosedTree> entries;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        entries.push_back(maker.subtract(maker.multiply({a[i], b[j]}), maker.multiply({a[j], b[i]})));
    }
    return array_value(maker, vector_shape(3), std::move(entries));
}

Value norm(const Maker& maker, const Tree& tree, const Value& v)
{
    if (v->shape.rank != Rank::vector) refuse_argument(tree, 0, v->shape, "a vector");
    return scalar(maker.call(Function::sqrt, {dot_entries(maker, v, v)}));
}

Value trace(const Maker& maker, const Tree& tree, const Value& a)
{
    require_square(tree, a->shape);
    std::vector<ClosedTree> terms;
    for (std::size_t k = 0; k < a->shape.rows; ++k) terms.push_back(maker.entry(*a, k * a->shape.columns + k));
    return scalar(maker.add(std::move(terms)));
}

Value transpose_entries(const Maker& maker, const Value& a)
{
    const std::size_t rows = a->shape.rows;
    const std::size_t columns = a->shape.columns;
    const std::vector<ClosedTree>& entries = maker.entries(*a);
    std::vector<ClosedTree> result;
    for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t i = 0; i < rows; ++i) result.push_back(entries[i * columns + j]);
    return array_value(maker, matrix_shape(columns, rows), std::move(result));
}

Value transpose(const Maker& maker, const Tree& tree, const Value& a)
{
    if (a->shape.rank == Rank::scalar) refuse_argument(tree, 0, a->shape, "a vector or a matrix");
    if (!a->inverse_of) return transpose_entries(maker, a);
    return inverse_matrix(maker, tree, transpose_entries(maker, a->inverse_of)); // stays a solve
}

Value diag(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    std::vector<ClosedTree> diagonal;
    if (arguments.size() == 1 && arguments[0]->shape.rank == Rank::vector) {
        diagonal = maker.entries(*arguments[0]);
    } else {
        for (std::size_t k = 0; k < arguments.size(); ++k) {
            if (arguments[k]->shape.rank != Rank::scalar)
                refuse_argument(tree, k, arguments[k]->shape, "one vector, or scalars");
            diagonal.push_back(maker.entry(*arguments[k], 0));
        }
    }
    const std::size_t n = diagonal.size();
    require_size(maker, matrix_shape(n, n));
    std::vector<ClosedTree> entries(n * n, maker.number(0));
    for (std::size_t k = 0; k < n; ++k) entries[k * n + k] = std::move(diagonal[k]);
    return array_value(maker, matrix_shape(n, n), std::move(entries));
}

Value identity(const Maker& maker, const Tree& tree, const Value& size)
{
    const std::optional<long> n = integer_of(*size);
    if (!n || *n < 1)
        refuse(tree->arguments[0], "the argument of identity is not a positive integer constant",
               "identity(3) is the 3 x 3 identity matrix");
    return identity_matrix(maker, static_cast<std::size_t>(*n));
}

/// Minors of the lower rows, by the set of columns that they use.
class Minors {
  public:
    Minors(const Maker& maker, std::span<const ClosedTree> entries, std::size_t n)
        : maker_(maker), entries_(entries), n_(n)
    {
    }

    /// The minor of the last popcount(columns) rows.
    ClosedTree operator()(unsigned columns)
    {
        if (columns == 0) return maker_.number(1);
        if (const auto known = known_.find(columns); known != known_.end()) return known->second;
        const std::size_t row = n_ - static_cast<std::size_t>(std::popcount(columns));
        std::vector<ClosedTree> terms;
        bool negative = false;
        for (std::size_t column = 0; column < n_; ++column) {
            if (!(columns & (1U << column))) continue;
            const ClosedTree& entry = entries_[row * n_ + column];
            if (!is_number(entry, 0)) {
                const ClosedTree term = maker_.multiply({entry, (*this)(columns & ~(1U << column))});
                terms.push_back(negative ? maker_.negate(term) : term);
            }
            negative = !negative;
        }
        return known_.emplace(columns, maker_.add(std::move(terms))).first->second;
    }

  private:
    const Maker& maker_;
    std::span<const ClosedTree> entries_;
    std::size_t n_;
    std::map<unsigned, ClosedTree> known_;
};

} // namespace

Value inverse_matrix(const Maker& maker, const Tree& tree, const Value& a)
{
    if (a->shape.rank != Rank::matrix || a->shape.rows != a->shape.columns)
        refuse(tree, fmt::format("the inverse of {} is not defined", to_text(a->shape)),
               "the matrix of an inverse is square");
    if (a->inverse_of) return a->inverse_of;
    Value result = array_value(maker, a->shape, {});
    result->inverse_of = a;
    return result;
}

Value identity_matrix(const Maker& maker, std::size_t n)
{
    require_size(maker, matrix_shape(n, n));
    std::vector<ClosedTree> entries(n * n, maker.number(0));
    for (std::size_t k = 0; k < n; ++k) entries[k * n + k] = maker.number(1);
    return array_value(maker, matrix_shape(n, n), std::move(entries));
}

Value determinant(const Maker& maker, const Tree& tree, const Value& a)
{
    require_square(tree, a->shape);
    const std::size_t n = a->shape.rows;
    if (n > largest_determinant)
        refuse(tree, fmt::format("the determinant of {} is too large", to_text(a->shape)),
               fmt::format("a determinant is written out up to {0} x {0}", largest_determinant));
    return scalar(Minors(maker, maker.entries(*a), n)((1U << n) - 1));
}

Value call_on_arrays(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    const Value& first = arguments[0];
    const auto neutral = std::find_if(arguments.begin(), arguments.end(), [](const Value& v) { return v->neutral; });
    switch (tree->function) {
    case Function::dot:
    case Function::cross:
    case Function::norm:
    case Function::trace:
    case Function::transpose:
        if (neutral != arguments.end()) return *neutral;
        break;
    default: break;
    }
    switch (tree->function) {
    case Function::dot: return dot(maker, tree, arguments);
    case Function::cross: return cross(maker, tree, arguments);
    case Function::norm: return norm(maker, tree, first);
    case Function::trace: return trace(maker, tree, first);
    case Function::transpose: return transpose(maker, tree, first);
    case Function::det: return determinant(maker, tree, first);
    case Function::inverse: return inverse_matrix(maker, tree, first);
    case Function::diag: return diag(maker, tree, arguments);
    case Function::identity: return identity(maker, tree, first);
    case Function::hat: return hat(maker, tree, first);
    case Function::vee: return vee(maker, tree, first);
    case Function::exp: return exponential(maker, tree, first);
    case Function::cay: return cayley(maker, tree, first);
    default: break;
    }
    const char* function = entry_of(tree->function).name;
    const auto array =
        std::find_if(arguments.begin(), arguments.end(), [](const Value& v) { return v->shape.rank != Rank::scalar; });
    refuse(tree->arguments[static_cast<std::size_t>(array - arguments.begin())],
           fmt::format("an argument of {} is {}", function, to_text((*array)->shape)),
           fmt::format("{} takes {}scalar{}", function, arguments.size() == 1 ? "a " : "",
                       arguments.size() == 1 ? "" : "s"));
}

} // namespace lagen
