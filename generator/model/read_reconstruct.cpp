// SPDX-License-Identifier: GPL-2.0-or-later
/// The [reconstruct] block: `R = "SO(3)"`, matrices of named groups with g' = g xi. Their entries are first-order
/// states.
#include "model/algebroid_draft.hpp"
#include "model/families.hpp"
#include "model/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

/// The first of the sections that xi has components on, or nothing where the algebroid has none.
std::optional<std::size_t> first_vertical(const Model& model)
{
    const std::size_t n = model.base.coordinates.size();
    switch (model.algebroid.kind) {
    case AlgebroidKind::lie_algebra:
    case AlgebroidKind::action: return 0;
    case AlgebroidKind::atiyah: return n;
    case AlgebroidKind::groupoid:
        if (!model.groupoid->has_group()) return std::nullopt;
        return model.groupoid->has_targets() ? n : 0;
    default: return std::nullopt;
    }
}

void require_rank(const Model& model, const GroupoidBlock& group, std::size_t first)
{
    const std::size_t found = model.fibre.coordinates.size() - first;
    if (found == group.generators.size()) return;
    throw ModelError(fmt::format("the group {} has {} generators, where the algebroid has {} sections for them",
                                 group.group, group.generators.size(), found),
                     group.group_where, "one generator a section, in the order of [fibre]");
}

/// xi^c: the fibre coordinate, less A^c_i xdot^i.
Tree velocity_on(const Model& model, std::size_t section)
{
    std::vector<Tree> terms{name(model.fibre.coordinates[section].name)};
    for (const ConnectionEntry& entry : model.algebroid.connection)
        if (entry.section == section)
            terms.push_back(negate(product_of(entry.value, name(model.fibre.coordinates[entry.coordinate].name))));
    return terms.size() == 1 ? terms[0] : add(terms);
}

/// (g xi)_ij = g_ik xi^c (E_c)_kj, by rows.
void set_rates(Model& model, const Reconstruction& g)
{
    const std::size_t n = g.size;
    std::vector<std::vector<Tree>> xi(n * n);
    for (std::size_t c = 0; c < g.generators.size(); ++c) {
        const Tree velocity = velocity_on(model, g.first_section + c);
        for (std::size_t k = 0; k < n * n; ++k)
            if (const Tree& entry = g.generators[c].entries[k]; entry->number != 0)
                xi[k].push_back(product_of(entry, velocity));
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            std::vector<Tree> terms;
            for (std::size_t k = 0; k < n; ++k)
                for (const Tree& each : xi[k * n + j])
                    terms.push_back(product_of(name(model.states[g.first + i * n + k].symbol.name), each));
            model.states[g.first + i * n + j].rate = terms.empty()       ? number(0)
                                                     : terms.size() == 1 ? terms[0]
                                                                         : add(terms);
        }
}

} // namespace

void declare_reconstructions(ModelReader& reader)
{
    if (reader.reconstruct == nullptr) return;
    Model& model = reader.model;
    const TableReader table(reader.reconstruct->value, "[reconstruct]");
    const std::optional<std::size_t> first = first_vertical(model);
    if (!first)
        throw ModelError("[reconstruct] needs an algebroid whose fibre is a Lie algebra, wholly or in part",
                         reader.reconstruct->where(), "kinds: lie_algebra, action, atiyah");
    for (const TomlEntry& entry : reader.reconstruct->value.entries) {
        require_identifier(entry.name(), entry.where(), "a name");
        GroupoidBlock group;
        read_named_group(reader, group, entry, fmt::format("the group of '{}'", entry.name()));
        require_rank(model, group, *first);
        Reconstruction g{group.group,         group.generators, *first,           group.generators[0].shape.rows,
                         model.states.size(), entry.name(),     group.group_where};
        std::vector<Symbol> symbols;
        for (std::size_t k = 0; k < g.size * g.size; ++k)
            symbols.push_back(
                Symbol{entry_name(entry.name(), group.generators[0].shape, k), entry.where(), {}, {}, {}});
        declare_symbols(reader, symbols, Role::state);
        for (std::size_t k = 0; k < g.size; ++k) model.states[g.first + k * (g.size + 1)].start = 1;
        model.reconstructions.push_back(std::move(g));
    }
}

void read_reconstructions(ModelReader& reader)
{
    for (const Reconstruction& g : reader.model.reconstructions) set_rates(reader.model, g);
}

} // namespace lagen
