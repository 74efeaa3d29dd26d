// SPDX-License-Identifier: GPL-2.0-or-later
/// Sums, products and powers of vectors and matrices.
#include "expression/combine.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr long largest_power = 64;

bool is_vector(const Value& value)
{
    return value->shape.rank == Rank::vector;
}

[[noreturn]] void refuse_product(const Maker& maker, const Shape& a, const Shape& b)
{
    std::string hint = "a matrix with n columns multiplies a vector of n or a matrix with n rows";
    if (a.rank == Rank::vector && b.rank == Rank::vector)
        hint = "the scalar product is written dot(a, b), the vector product cross(a, b)";
    else if (a.rank == Rank::vector)
        hint = "a vector is a column: write transpose(A)*v, or dot(v, A*w) for v^T A w";
    maker.fail(fmt::format("{} is multiplied by {}", to_text(a), to_text(b)), hint);
}

/// z with A z = b, a column of b at a time.
Value solve_columns(const Maker& maker, Closed& matrix, const Value& right)
{
    const std::size_t m = matrix.shape.rows;
    const std::size_t columns = right->shape.columns;
    const std::vector<ClosedTree>& a = maker.entries(matrix);
    const std::vector<ClosedTree>& b = maker.entries(*right);
    std::vector<ClosedTree> result(m * columns);
    for (std::size_t column = 0; column < columns; ++column) {
        std::vector<ClosedTree> side;
        for (std::size_t row = 0; row < m; ++row) side.push_back(b[row * columns + column]);
        const bool is_zero = std::all_of(side.begin(), side.end(), [](const ClosedTree& e) { return is_number(e, 0); });
        for (std::size_t row = 0; row < m; ++row)
            result[row * columns + column] = m == 1    ? maker.divide(side[0], a[0])
                                             : is_zero ? maker.number(0)
                                                       : maker.solve(a, side, row);
    }
    return array_value(maker, right->shape, std::move(result));
}

/// sum_k a_ik b_kj, without the terms that are zero as written.
Value multiply_pair(const Maker& maker, const Value& a, const Value& b)
{
    const bool outer = is_vector(a) && b->shape.rank == Rank::matrix && b->shape.rows == 1;
    if ((is_vector(a) && !outer) || a->shape.columns != b->shape.rows) refuse_product(maker, a->shape, b->shape);
    if (a->inverse_of) return solve_columns(maker, *a->inverse_of, b);
    const std::size_t rows = a->shape.rows;
    const std::size_t inner = a->shape.columns;
    const std::size_t columns = b->shape.columns;
    const Shape shape = is_vector(b) ? vector_shape(rows) : matrix_shape(rows, columns);
    require_size(maker, shape);
    const std::vector<ClosedTree>& left = maker.entries(*a);
    const std::vector<ClosedTree>& right = maker.entries(*b);
    std::vector<ClosedTree> entries;
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            std::vector<ClosedTree> terms;
            for (std::size_t k = 0; k < inner; ++k)
                terms.push_back(maker.multiply({left[i * inner + k], right[k * columns + j]}));
            entries.push_back(maker.add(std::move(terms)));
        }
    return array_value(maker, shape, std::move(entries));
}

/// A*B*v is A*(B*v): products with vectors are cheaper, and inverse(A) is solved for them.
Value multiply_chain(const Maker& maker, std::vector<Value> arrays)
{
    const auto vectors = std::count_if(arrays.begin(), arrays.end(), is_vector);
    const bool from_right = vectors == 1 && is_vector(arrays.back());
    if (from_right) std::reverse(arrays.begin(), arrays.end());
    Value result = arrays.front();
    for (std::size_t k = 1; k < arrays.size(); ++k)
        result = from_right ? multiply_pair(maker, arrays[k], result) : multiply_pair(maker, result, arrays[k]);
    return result;
}

} // namespace

Value add_values(const Maker& maker, std::span<const Value> terms, std::span<const Tree> where_of)
{
    const Value* first = nullptr;
    for (std::size_t k = 0; k < terms.size(); ++k) {
        if (terms[k]->neutral) continue;
        if (!first) first = &terms[k];
        if (terms[k]->shape == (*first)->shape) continue;
        refuse(where_of[k], fmt::format("{} is added to {}", to_text(terms[k]->shape), to_text((*first)->shape)),
               "the terms of a sum have the same shape");
    }
    if (!first) return terms[0];
    std::vector<ClosedTree> entries;
    for (std::size_t e = 0; e < (*first)->shape.size(); ++e) {
        std::vector<ClosedTree> parts;
        for (const Value& term : terms)
            if (!term->neutral) parts.push_back(maker.entry(*term, e));
        entries.push_back(maker.add(std::move(parts)));
    }
    return array_value(maker, (*first)->shape, std::move(entries));
}

Value multiply_values(const Maker& maker, std::span<const Value> factors)
{
    std::vector<ClosedTree> scalars;
    std::vector<Value> arrays;
    for (const Value& factor : factors) {
        if (factor->neutral) return factor;
        if (factor->shape.rank == Rank::scalar)
            scalars.push_back(maker.entry(*factor, 0));
        else
            arrays.push_back(factor);
    }
    Value product = multiply_chain(maker, std::move(arrays));
    if (scalars.empty()) return product;
    const ClosedTree scale = maker.multiply(std::move(scalars));
    std::vector<ClosedTree> entries;
    for (const ClosedTree& entry : maker.entries(*product)) entries.push_back(maker.multiply({scale, entry}));
    return array_value(maker, product->shape, std::move(entries));
}

/// By repeated squaring; negative exponents through the inverse.
Value power_of_matrix(const Maker& maker, const Tree& tree, const Value& base, const Value& exponent)
{
    const Shape& shape = base->shape;
    if (exponent->shape.rank != Rank::scalar)
        refuse(tree->arguments[1], fmt::format("an exponent is {}", to_text(exponent->shape)),
               "an exponent is a scalar");
    if (shape.rank == Rank::vector)
        refuse(tree, fmt::format("a power of {} is not defined", to_text(shape)), "|v|^2 is written dot(v, v)");
    if (shape.rows != shape.columns)
        refuse(tree, fmt::format("a power of {} is not defined", to_text(shape)), "the matrix of a power is square");
    const std::optional<long> n = integer_of(*exponent);
    if (!n || *n > largest_power || *n < -largest_power)
        refuse(tree->arguments[1],
               fmt::format("the exponent of a matrix is not an integer from {} to {}", -largest_power, largest_power),
               "");
    Value square = *n < 0 ? inverse_matrix(maker, tree, base) : base;
    if (*n == -1) return square;
    Value result;
    for (long rest = std::abs(*n); rest > 0; rest /= 2) {
        if (rest % 2 == 1) result = result ? multiply_pair(maker, result, square) : square;
        if (rest > 1) square = multiply_pair(maker, square, square);
    }
    return result ? result : identity_matrix(maker, shape.rows);
}

} // namespace lagen
