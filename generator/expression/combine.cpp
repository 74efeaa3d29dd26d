// SPDX-License-Identifier: GPL-2.0-or-later
/// Operations on shapes: which fit, and what comes of them. Entries of arrays, sums, products and powers.
#include "expression/combine.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr long most_stumpff = 32;

bool is_scalar(const Value& value)
{
    return value->shape.rank == Rank::scalar;
}

/// Every argument a scalar, and a scalar for a result.
bool of_scalars(const TreeNode& node, std::span<const Value> arguments)
{
    if (node.kind == TreeKind::array || node.kind == TreeKind::index || is_range(node)) return false;
    if (node.kind == TreeKind::call && entry_of(node.function).array) return false;
    return std::all_of(arguments.begin(), arguments.end(), is_scalar);
}

/// The k of stumpff(k, z) as a literal number, which is what later stages expect.
void require_order(const Maker& maker, const Tree& tree, std::vector<ClosedTree>& arguments)
{
    const std::optional<long> k = integer_of(*scalar(arguments[0]));
    if (!k || *k < 0 || *k > most_stumpff)
        refuse(tree->arguments[0], "the first argument of stumpff is not an integer from 0 to 32",
               "stumpff(k, z) = 1/k! - z/(k+2)! + z^2/(k+4)! - ...");
    if (arguments[0].tree->kind != TreeKind::number) arguments[0] = maker.number(*k);
}

Value combine_scalars(const Maker& maker, const Tree& tree, std::span<const Value> arguments, bool open)
{
    std::vector<ClosedTree> trees;
    trees.reserve(arguments.size());
    for (const Value& argument : arguments) trees.push_back(maker.entry(*argument, 0));
    if (tree->kind == TreeKind::call && tree->function == Function::stumpff && !open) require_order(maker, tree, trees);
    Value result = scalar(maker.operation(tree, std::move(trees)));
    result->open = open;
    const auto neutral = [](const Value& value) { return value->neutral; };
    switch (tree->kind) {
    case TreeKind::negate:
    case TreeKind::multiply: result->neutral = std::any_of(arguments.begin(), arguments.end(), neutral); break;
    case TreeKind::add: result->neutral = std::all_of(arguments.begin(), arguments.end(), neutral); break;
    case TreeKind::divide: result->neutral = arguments[0]->neutral; break;
    default: break;
    }
    return result;
}

Value negate_array(const Maker& maker, const Value& value)
{
    std::vector<ClosedTree> entries;
    entries.reserve(value->shape.size());
    for (const ClosedTree& entry : maker.entries(*value)) entries.push_back(maker.negate(entry));
    return array_value(maker, value->shape, std::move(entries));
}

Value divide_array(const Maker& maker, const Tree& tree, const Value& above, const Value& below)
{
    if (!is_scalar(below))
        refuse(tree, fmt::format("{} is divided by {}", to_text(above->shape), to_text(below->shape)),
               below->shape.rank == Rank::matrix ? "A^-1 b is written inverse(A)*b" : "the divisor is a scalar");
    const ClosedTree& divisor = maker.entry(*below, 0);
    std::vector<ClosedTree> entries;
    entries.reserve(above->shape.size());
    for (const ClosedTree& entry : maker.entries(*above)) entries.push_back(maker.divide(entry, divisor));
    return array_value(maker, above->shape, std::move(entries));
}

[[noreturn]] void refuse_comparison(const Tree& tree, std::span<const Value> arguments)
{
    const std::size_t k = is_scalar(arguments[0]) ? 1 : 0;
    refuse(tree->arguments[k], fmt::format("{} is compared", to_text(arguments[k]->shape)),
           "scalars are compared: entries, or a norm");
}

Value combine_arrays(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    switch (tree->kind) {
    case TreeKind::array: return join_entries(maker, tree, arguments);
    case TreeKind::index: return pick_entry(maker, tree, arguments);
    case TreeKind::apply: return close_range(tree, arguments);
    case TreeKind::negate: return negate_array(maker, arguments[0]);
    case TreeKind::add: return add_values(maker, arguments, tree->arguments);
    case TreeKind::multiply: return multiply_values(maker, arguments);
    case TreeKind::divide: return divide_array(maker, tree, arguments[0], arguments[1]);
    case TreeKind::power: return power_of_matrix(maker, tree, arguments[0], arguments[1]);
    case TreeKind::compare: refuse_comparison(tree, arguments);
    case TreeKind::call: return call_on_arrays(maker, tree, arguments);
    default: break;
    }
    throw InternalError("closing: an operation on arrays that is none");
}

} // namespace

void refuse(const Tree& argument, const std::string& message, const std::string& hint)
{
    throw ModelError(message, argument->where, hint);
}

Value combine(const Maker& maker, const Tree& tree, std::vector<Value> arguments)
{
    const bool open = std::any_of(arguments.begin(), arguments.end(), [](const Value& value) { return value->open; });
    if (of_scalars(*tree, arguments)) return combine_scalars(maker, tree, arguments, open);
    if (!open) return combine_arrays(maker, tree, arguments);
    return open_value(tree->where);
}

Value open_value(const SourceRange& where)
{
    const Tree stand_in = name("?", where); // nothing is said of shapes
    Value result = scalar({stand_in, measure(*stand_in, {}, closing_limits())});
    result->open = true;
    return result;
}

// Arrays from their entries, and entries of arrays.

namespace {

/// How a message calls an array: its name where it has one.
std::string called(const Tree& array)
{
    return array->kind == TreeKind::name ? quote(array->name) : quote(to_text(array));
}

/// The offset from 0, below `count`, of the entry that `value`, which is `written`, asks for as index number `which`.
std::size_t offset_of(const Tree& tree, std::size_t which, const Tree& written, std::optional<long> value,
                      std::size_t count)
{
    if (!value)
        refuse(written, fmt::format("the index {} is not an integer constant", quote(to_text(written))),
               "an index is made of integers, sizes, and the indices of sum and product");
    if (*value < 1 || static_cast<std::size_t>(*value) > count) {
        const bool literal = written->kind == TreeKind::number;
        const char* part = tree->arguments.size() == 2 ? "index" : which == 1 ? "row" : "column";
        refuse(written,
               fmt::format("the {} {} of {} is outside 1..{}", part, *value, called(tree->arguments[0]), count),
               literal ? "" : fmt::format("{} is {} here", quote(to_text(written)), *value));
    }
    return static_cast<std::size_t>(*value) - 1;
}

/// The entries that an index picks: one, or a range of them.
struct Picked {
    std::size_t first, count;
    bool is_range;
};

/// The entries that the index number `which` (from 1) picks of `count` entries.
Picked picked_by(const Tree& tree, std::size_t which, const Closed& index, std::size_t count)
{
    const Tree& written = tree->arguments[which];
    if (is_range(*written)) {
        if (written->arguments.empty()) return {0, count, true};
        const std::size_t first = offset_of(tree, which, written->arguments[0], index.range[0], count);
        const std::size_t last = offset_of(tree, which, written->arguments[1], index.range[1], count);
        if (last < first)
            refuse(written, fmt::format("the range {} is empty", quote(to_text(written))),
                   "a range goes from the first index to the last one");
        return {first, last - first + 1, true};
    }
    if (index.shape.rank != Rank::scalar)
        refuse(written, fmt::format("an index is {}", to_text(index.shape)), "an index is an integer");
    return {offset_of(tree, which, written, integer_of(index), count), 1, false};
}

} // namespace

Value join_entries(const Maker& maker, const Tree& tree, std::span<const Value> entries)
{
    if (entries.empty()) maker.fail("an array has no entries", "a vector has one entry at least");
    const Shape first = entries[0]->shape;
    std::vector<ClosedTree> joined;
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const Shape& shape = entries[k]->shape;
        if (shape.rank == Rank::matrix)
            refuse(tree->arguments[k], fmt::format("an entry is {}", to_text(shape)),
                   "the entries of a vector are scalars, the rows of a matrix are vectors");
        if (shape.rank != first.rank)
            refuse(tree->arguments[k], fmt::format("{} stands beside {}", to_text(shape), to_text(first)),
                   "the entries of a vector are scalars, the rows of a matrix are vectors");
        if (shape.rows != first.rows)
            refuse(tree->arguments[k],
                   fmt::format("row {} has length {}, and row 1 has length {}", k + 1, shape.rows, first.rows),
                   "the rows of a matrix have the same length");
        const Shape so_far = first.rank == Rank::scalar ? vector_shape(k + 1) : matrix_shape(k + 1, first.rows);
        require_size(maker, so_far);
        const std::vector<ClosedTree>& row = maker.entries(*entries[k]);
        joined.insert(joined.end(), row.begin(), row.end());
    }
    const std::size_t n = entries.size();
    const Shape shape = first.rank == Rank::scalar ? vector_shape(n) : matrix_shape(n, first.rows);
    return array_value(maker, shape, std::move(joined));
}

Value pick_entry(const Maker& maker, const Tree& tree, std::span<const Value> arguments)
{
    Closed& base = *arguments[0];
    if (base.neutral) return arguments[0];
    const Tree& array = tree->arguments[0];
    const std::size_t indices = arguments.size() - 1;
    if (base.shape.rank == Rank::scalar)
        refuse(tree, fmt::format("{} is a scalar and has no entries", called(array)), "");
    const std::size_t wanted = base.shape.rank == Rank::vector ? 1 : 2;
    if (indices != wanted)
        refuse(tree,
               fmt::format("{} is {} and takes {}, and {} given", called(array), to_text(base.shape),
                           wanted == 1 ? "one index" : "two indices", indices == 1 ? "one is" : "two are"),
               wanted == 1 ? "its first entry is written with [1]"
                           : "its first entry is written with [1,1], its first row with [1,:]");
    const Picked rows = picked_by(tree, 1, *arguments[1], base.shape.rows);
    const Picked columns = wanted == 1 ? Picked{0, 1, false} : picked_by(tree, 2, *arguments[2], base.shape.columns);
    std::vector<ClosedTree> entries;
    for (std::size_t i = rows.first; i < rows.first + rows.count; ++i)
        for (std::size_t j = columns.first; j < columns.first + columns.count; ++j)
            entries.push_back(maker.entry(base, i * base.shape.columns + j));
    if (!rows.is_range && !columns.is_range) return scalar(std::move(entries[0]));
    const bool vector = rows.is_range != columns.is_range;
    const Shape shape = vector ? vector_shape(entries.size()) : matrix_shape(rows.count, columns.count);
    return array_value(maker, shape, std::move(entries));
}

Value close_range(const Tree& tree, std::span<const Value> ends)
{
    const Value result = scalar({tree, {}});
    for (std::size_t k = 0; k < ends.size(); ++k) {
        if (ends[k]->shape.rank != Rank::scalar)
            refuse(tree->arguments[k], fmt::format("an index is {}", to_text(ends[k]->shape)),
                   "an index is an integer");
        result->range.push_back(integer_of(*ends[k]));
    }
    return result;
}

// Sums, products and powers of vectors and matrices.

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
