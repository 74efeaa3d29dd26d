// SPDX-License-Identifier: GPL-2.0-or-later
/// The [groupoid] block: its kind and its group first (the rank of its algebroid depends on them), the coordinates of
/// an arrow and the action once expressions can be closed. The [reconstruct] block: `R = "SO(3)"`, matrices of named
/// groups with g' = g xi, whose entries are first-order states.
#include "geometry/named_algebra.hpp"
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

/// A group lies over a point, the others over M.
void require_base_of_kind(const ModelReader& reader, const Item& block, GroupoidKind kind)
{
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    if (kind == GroupoidKind::group && !base.empty())
        throw ModelError(
            fmt::format("a group is a groupoid over a point, but the base coordinate '{}' is declared", base[0].name),
            block.where(), "a group that moves the points of a base is a groupoid of kind \"action\"");
    if (kind != GroupoidKind::group && base.empty())
        throw complain::needs(fmt::format("a groupoid of kind '{}'", block.at("kind").text()), "base coordinates",
                              block.where(), "[base] coordinates = [\"x\", \"y\"]");
}

std::string group_meant(std::string name)
{
    for (char& c : name)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return algebra_of_group(name) ? name : nearest_name(name, named_group_names());
}

ArrayValue basis_matrix(const SparseMatrix& matrix, std::size_t size, const SourceRange& where)
{
    ArrayValue out{{Rank::matrix, size, size}, {}};
    for (const Rational& entry : dense(matrix, size)) out.entries.push_back(number(entry, where));
    return out;
}

void declare_element(ModelReader& reader, const Item& item)
{
    const Shape shape = reader.model.groupoid->generators[0].shape;
    const std::string name = item ? item.text() : "W";
    const SourceRange where = item ? item.value().where : reader.model.groupoid->where;
    require_identifier(name, where, "the name of the group element");
    declare_symbols(reader, symbols_called(name, shape, where), Role::element);
}

void declare_targets(ModelReader& reader)
{
    declare_symbols(reader, with_names(reader.model.base.coordinates, next_name), Role::next);
}

/// A model may give [algebroid] too.
void require_rank_of_groupoid(const Model& model)
{
    const std::size_t rank = rank_of(*model.groupoid, model.base.coordinates.size());
    const std::size_t found = model.fibre.coordinates.size();
    if (rank != found)
        throw complain::wrong_number("fibre coordinates", found, "the groupoid", rank, model.groupoid->where,
                                     "one a base coordinate (pair, atiyah), then one a generator of the group");
}

/// xi^c: the fibre coordinate, less A^c_i xdot^i.
Tree velocity_on(const Model& model, std::size_t section)
{
    std::vector<Tree> terms{name(model.fibre.coordinates[section].name)};
    for (const ConnectionEntry& entry : model.algebroid.connection)
        if (entry.section == section)
            terms.push_back(negate(product_of(entry.value, name(model.fibre.coordinates[entry.coordinate].name))));
    return sum_of(terms);
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
            model.states[g.first + i * n + j].rate = sum_of(terms);
        }
}

} // namespace

void read_named_group(const ModelReader& reader, GroupoidBlock& block, const Item& item)
{
    block.group = with_sizes(item.text(), reader.model.sizes);
    block.group_where = item.value().where;
    const std::optional<NamedAlgebra> algebra = algebra_of_group(block.group);
    if (!algebra) {
        const std::string near = group_meant(block.group);
        throw ModelError(
            fmt::format("there is no group called \"{}\" of rank at most {}", block.group, named_algebra_rank_limit),
            block.group_where,
            fmt::format("{}known are {}, the last three with any number, and sums A + B",
                        near.empty() ? "" : fmt::format("did you mean \"{}\"? ", near),
                        comma_list(named_group_names())));
    }
    for (const SparseMatrix& matrix : algebra->basis)
        block.generators.push_back(basis_matrix(matrix, algebra->size, block.group_where));
}

std::size_t rank_of(const GroupoidBlock& block, std::size_t n)
{
    return (block.has_targets() ? n : 0) + block.generators.size();
}

void declare_groupoid(ModelReader& reader)
{
    const Item block = reader.at("groupoid");
    if (!block) return;
    GroupoidBlock groupoid;
    groupoid.where = block.where();
    groupoid.kind = static_cast<GroupoidKind>(place_of_kind("groupoid", block.at("kind").text()));
    require_base_of_kind(reader, block, groupoid.kind);
    if (const Item group = block.at("group")) read_named_group(reader, groupoid, group);
    if (const Item generators = block.at("generators")) { // their entries are read when expressions can be closed
        groupoid.group_where = generators.value().where;
        groupoid.generators.resize(generators.value().items.size());
    }
    reader.model.groupoid = std::move(groupoid);
}

void declare_arrows(ModelReader& reader)
{
    if (!reader.model.groupoid) return;
    GroupoidBlock& block = *reader.model.groupoid;
    if (const Item generators = reader.at("groupoid").at("generators"))
        block.generators = read_matrices(reader, generators, std::nullopt, "all generators have the size of the first",
                                         [](std::size_t c) { return fmt::format("the generator number {}", c + 1); });
    require_rank_of_groupoid(reader.model);
    if (block.has_group()) declare_element(reader, reader.at("groupoid").at("element"));
    if (block.has_targets()) declare_targets(reader);
}

void read_action(ModelReader& reader)
{
    if (!reader.model.groupoid || reader.model.groupoid->kind != GroupoidKind::action) return;
    GroupoidBlock& block = *reader.model.groupoid;
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    const Item action = reader.at("groupoid").at("action");
    block.action.resize(base.size());
    reader.read_values(action, base, "base coordinate",
                       [&](std::size_t i, const Tree& value, const Item&) { block.action[i] = value; });
    for (std::size_t i = 0; i < base.size(); ++i)
        if (!block.action[i])
            throw complain::leaves_out(
                "the action", fmt::format("the base coordinate '{}'", base[i].name), action.where(),
                fmt::format("a coordinate that does not move is written {0} = \"{0}\"", base[i].name));
}

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

void declare_reconstructions(ModelReader& reader)
{
    const Item block = reader.at("reconstruct");
    if (!block) return;
    Model& model = reader.model;
    const std::size_t first = first_vertical(model).value();
    for (const Item& item : block.items()) {
        require_identifier(item.name(), item.where(), "a name");
        GroupoidBlock group;
        read_named_group(reader, group, item);
        if (const std::size_t found = model.fibre.coordinates.size() - first; found != group.generators.size())
            throw complain::wrong_number("generators of " + group.group, group.generators.size(), "the algebroid",
                                         found, group.group_where, "one generator a section, in the order of [fibre]");
        const Shape& shape = group.generators[0].shape;
        Reconstruction g{group.group, group.generators, first, shape.rows, model.states.size(),
                         item.name(), group.group_where};
        declare_symbols(reader, symbols_called(item.name(), shape, item.where()), Role::state);
        for (std::size_t k = 0; k < g.size; ++k) model.states[g.first + k * (g.size + 1)].start = 1;
        model.reconstructions.push_back(std::move(g));
    }
}

void read_reconstructions(ModelReader& reader)
{
    for (const Reconstruction& g : reader.model.reconstructions) set_rates(reader.model, g);
}

} // namespace lagen
