// SPDX-License-Identifier: GPL-2.0-or-later
/// The matrices A_a of an action by a representation, rho_a = -(A_a x)^i d/dx^i, x the vector of base coordinates.
#include "model/algebroid_draft.hpp"

#include "model/families.hpp"
#include "model/read_values.hpp"

#include <fmt/format.h>

namespace lagen {

void read_representation(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& entry)
{
    block.representation_where = entry.value.where;
    if (entry.value.kind != TomlKind::array) {
        throw ModelError(
            fmt::format("'representation' is {}, where a list of matrices is required", kind_text(entry.value.kind)),
            entry.value.where, "representation = [A_1, ..], one matrix a section");
    }
    if (entry.value.items.size() != block.fibre.size()) {
        throw ModelError(
            fmt::format("the number of matrices in 'representation' is {}, where one a section is required: {}",
                        entry.value.items.size(), block.fibre.size()),
            entry.value.where);
    }
    const std::size_t n = block.base.size();
    const Shape wanted{Rank::matrix, n, n};
    for (std::size_t a = 0; a < block.fibre.size(); ++a) {
        const TomlValue& item = entry.value.items[a];
        const std::string what = fmt::format("the matrix of '{}'", block.fibre[a].name);
        ArrayValue matrix = reader.close_array(read_array_expression(item, what), {Role::parameter}, what);
        if (!(matrix.shape == wanted)) {
            throw ModelError(
                fmt::format("{} is {}, where {} is required", what, to_text(matrix.shape), to_text(wanted)), item.where,
                "it acts on the vector of all base coordinates");
        }
        block.representation.push_back(std::move(matrix));
    }
}

} // namespace lagen
