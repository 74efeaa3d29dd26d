// SPDX-License-Identifier: GPL-2.0-or-later
/// Arrays from their entries, and entries of arrays.
#include "expression/combine.hpp"

#include <fmt/format.h>

namespace lagen {

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

/// What an index picks: one entry, or a range of them.
struct Picked {
    std::size_t first, count;
    bool is_range;
};

/// What the index number `which` (from 1) picks of `count` entries.
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

} // namespace lagen
