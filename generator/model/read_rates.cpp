// SPDX-License-Identifier: GPL-2.0-or-later
/// Lines of an anchor by base coordinates: x = "..", which says x' = .., linear in the fibre coordinates. R =
/// "R*hat(w)".
#include "model/algebroid_draft.hpp"

#include "expression/derivative.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// The fibre coordinates of an inner frame are none of the model's names.
Scope scope_with_fibre(const Scope& scope, const std::vector<Symbol>& fibre)
{
    Scope wider = scope;
    for (const SymbolGroup& group : group_symbols(fibre))
        if (!wider.has_symbol(group.name) && wider.find_family(group.name) == nullptr)
            wider.declare_family(group.name, group.shape, fibre[group.first].where);
    return wider;
}

} // namespace

bool is_rate_line(const Model& model, const AlgebroidBlock& block, const TomlEntry& line)
{
    return line.value.kind != TomlKind::table && resolve_key(coordinates_of(model, block), line.name()).has_value();
}

void read_rate_line(const ModelReader& reader, AlgebroidBlock& block, const TomlEntry& line)
{
    const std::string what = fmt::format("the rate of '{}'", line.name());
    const ResolvedKey key = *resolve_key(coordinates_of(reader.model, block), line.name());
    const std::vector<std::string> fibre = names_of(block.fibre);
    const Names::Entry* own = fibre.empty() ? nullptr : reader.names.find(fibre[0]);
    const Tree parsed = read_array_expression(line.value, what);
    const ArrayValue closed =
        reader.close_array_in(scope_with_fibre(reader.model.scope, block.fibre), parsed,
                              {Role::parameter, Role::base, own != nullptr ? own->role : Role::built_in}, what, false);
    const std::vector<Tree> rates = fit_values(closed, key.shape, what, line.value.where);
    for (std::size_t k = 0; k < rates.size(); ++k) {
        const std::size_t i = block.base[key.indices[k]];
        const auto same = [&](const AnchorEntry& entry) { return entry.coordinate == i; };
        if (std::ranges::any_of(block.anchor, same))
            throw ModelError(fmt::format("{} is given twice", what), line.where(),
                             "by the lines of the sections too: keep one of them");
        const std::optional<std::vector<Tree>> coefficients = linear_coefficients(rates[k], fibre);
        if (!coefficients)
            throw ModelError(
                fmt::format("{} is not linear in the fibre coordinates", what), line.value.where,
                "an anchor is linear: x' = rho^x_a y^a, and each term has one fibre coordinate for a factor");
        for (std::size_t a = 0; a < fibre.size(); ++a)
            if ((*coefficients)[a]) block.anchor.push_back(AnchorEntry{a, i, (*coefficients)[a], line.value.where});
    }
}

} // namespace lagen
