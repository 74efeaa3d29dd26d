// SPDX-License-Identifier: GPL-2.0-or-later
/// Texts of shapes and names of entries.
#include "expression/array.hpp"

#include "expression/parse.hpp"

#include <fmt/format.h>

namespace lagen {

std::string to_text(const Shape& shape)
{
    switch (shape.rank) {
    case Rank::scalar: break;
    case Rank::vector: return fmt::format("a vector of {}", shape.rows);
    case Rank::matrix: return fmt::format("a {} x {} matrix", shape.rows, shape.columns);
    }
    return "a scalar";
}

bool is_too_large(const Shape& shape)
{
    return shape.rows > most_array_entries || shape.columns > most_array_entries || shape.size() > most_array_entries;
}

std::string entry_name(const std::string& name, const Shape& shape, std::size_t k)
{
    switch (shape.rank) {
    case Rank::scalar: break;
    case Rank::vector: return fmt::format("{}[{}]", name, k + 1);
    case Rank::matrix: return fmt::format("{}[{},{}]", name, k / shape.columns + 1, k % shape.columns + 1);
    }
    return name;
}

std::string value_name(const std::string& text, const Shape& shape, std::size_t k)
{
    return entry_name(shape.rank == Rank::scalar || is_identifier(text) ? text : "(" + text + ")", shape, k);
}

} // namespace lagen
