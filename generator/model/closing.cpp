// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing expressions that may use only some of the model's names, and tables of them.
#include "expression/find_part.hpp"
#include "expression/name_hints.hpp"
#include "expression/rewrite.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/model_reader.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

Role role_of(const Names& names, const std::string& name)
{
    const Names::Entry* entry = names.find(name);
    return entry != nullptr ? entry->role : name == "t" ? Role::time : Role::built_in;
}

/// The first name in `trees` that plays none of `roles`.
Tree first_forbidden(const std::vector<Tree>& trees, const Names& names, Roles roles)
{
    return find_name(trees, [&](const std::string& name) { return !roles.has(role_of(names, name)); });
}

/// The roles that the model may have names of, in the order of the enumeration.
std::vector<Role> listed(const ModelReader& reader, Roles roles)
{
    std::vector<Role> out;
    for (Role role = Role::time; role <= Role::built_in; role = static_cast<Role>(static_cast<int>(role) + 1))
        if (roles.has(role) && (role != Role::ambient || is_nonholonomic(reader.model))) out.push_back(role);
    return out;
}

void require_roles(const std::vector<Tree>& closed, const ModelReader& reader, Roles roles, const SourceRange& where,
                   const std::string& what)
{
    const Tree bad = roles == any_role ? nullptr : first_forbidden(closed, reader.names, roles);
    if (bad == nullptr) return;
    throw complain::may_not_depend(
        what, fmt::format("{} ('{}')", role_text(role_of(reader.names, bad->name)), bad->name),
        bad->where.file ? bad->where : where, "allowed here: " + comma_list(listed(reader, roles), role_plural));
}

/// The names that an expression over `roles` may use: coordinates, controls and momenta, definitions over those, then
/// parameters and sizes.
std::vector<std::string> names_over(const ModelReader& reader, const Scope& scope, Roles roles)
{
    std::vector<std::string> known;
    const auto append = [&](Role role) {
        const std::vector<std::string> of_role = reader.names.of(role);
        known.insert(known.end(), of_role.begin(), of_role.end());
    };
    for (const Role role : listed(reader, roles))
        if (role != Role::parameter && role != Role::time) append(role);
    for (const Definition& definition : reader.model.definitions) {
        if (!definition.parameters.empty()) continue;
        try {
            const ArrayValue value = scope.close_array(name(definition.name));
            if (first_forbidden(value.entries, reader.names, roles) == nullptr) known.push_back(definition.name);
        } catch (const ModelError&) { // over names that are not legal here, or itself wrong
        }
    }
    if (roles.has(Role::time)) known.emplace_back("t");
    if (roles.has(Role::parameter)) append(Role::parameter);
    append(Role::size);
    return known;
}

/// The hint names what was meant, among the names that are legal here.
[[noreturn]] void refuse_unknown(const UnknownSymbol& error, const ModelReader& reader, const Scope& scope, Roles roles)
{
    if (error.is_explained() || roles == any_role) throw error;
    const auto refuse = [&error](const std::string& hint) {
        throw ModelError(error.diagnostic().message, error.diagnostic().where, hint);
    };
    const bool velocities = roles.has(Role::fibre) || roles.has(Role::ambient);
    const std::string meant = velocities                  ? hint_for_rate(error.name(), reader.rates)
                              : roles.has(Role::momentum) ? hint_for_momentum(error.name(), reader.rates)
                                                          : "";
    if (!meant.empty()) refuse(meant);
    if (velocities) throw error; // its hint lists all that may stand there
    const std::vector<std::string> known = names_over(reader, scope, roles);
    if (!known.empty()) refuse(hint_for_symbol(error.name(), known));
    const std::string& of_all = error.diagnostic().hint;
    if (of_all.starts_with("known names") || of_all.starts_with("did you mean"))
        refuse("parameters alone may stand here, and the model has none");
    throw error;
}

/// How a symbol that is given an array is declared as a family.
std::string family_hint(const std::string& name, const Shape& shape)
{
    if (shape.rank == Rank::vector)
        return fmt::format("a vector is declared with its range: \"{}[1..{}]\" = ..", name, shape.rows);
    return fmt::format("a matrix is declared with its ranges: \"{}[1..{},1..{}]\" = ..", name, shape.rows,
                       shape.columns);
}

} // namespace

Item ModelReader::at(std::string_view block) const
{
    // These two are about the sections of the algebroid, which a tangent probe leaves out.
    return is_tangent && (block == "groupoid" || block == "discrete") ? Item() : Item(document).at(block);
}

Roles ModelReader::legal(Roles roles) const
{
    if (!is_nonholonomic(model) || roles == any_role || !roles.has(Role::fibre) || roles.has(Role::ambient))
        return roles;
    roles.bits &= ~Roles(Role::fibre).bits;
    return roles | Role::ambient;
}

const Scope& ModelReader::scope_for(Roles roles) const
{
    if (roles.has(Role::element) || roles.has(Role::next)) return arrows;
    for (const Role role : {Role::momentum, Role::control, Role::state, Role::input})
        if (roles.has(role)) return mechanical;
    return model.scope;
}

ArrayValue ModelReader::close_in(const Scope& scope, const Tree& tree, Roles roles, const std::string& what,
                                 bool nonsmooth) const
{
    roles = legal(roles);
    try {
        ArrayValue closed = scope.close_array(tree, nonsmooth);
        require_roles(closed.entries, *this, roles, tree->where, what);
        return closed;
    } catch (const UnknownSymbol& error) {
        refuse_unknown(error, *this, scope, roles);
    }
}

ArrayValue ModelReader::close(const Tree& tree, Roles roles, const std::string& what, bool nonsmooth) const
{
    return close_in(scope_for(roles), tree, roles, what, nonsmooth);
}

Tree ModelReader::scalar(const Tree& tree, Roles roles, const std::string& what, bool nonsmooth) const
{
    roles = legal(roles);
    const Scope& scope = roles == any_role ? observer : scope_for(roles);
    try {
        const Tree closed = scope.close(tree, nonsmooth);
        require_roles({closed}, *this, roles, tree->where, what);
        return closed;
    } catch (const UnknownSymbol& error) {
        refuse_unknown(error, *this, scope, roles);
    }
}

ArrayValue ModelReader::array(const Item& item) const
{
    return close(read_array_expression(item.value(), item.title()), item.row().roles, item.title(),
                 item.row().nonsmooth);
}

Tree ModelReader::scalar(const Item& item) const
{
    return scalar(read_expression(item.value(), item.title()), item.row().roles, item.title(), item.row().nonsmooth);
}

std::vector<Tree> ModelReader::entries(const Item& item, const Shape& shape, Roles roles) const
{
    const ArrayValue closed = close(read_array_expression(item.value(), item.title()), roles, item.title());
    return fit_values(closed, shape, item.title(), item.value().where);
}

void ModelReader::read_values(const Item& table, const std::vector<Symbol>& symbols, const char* noun, const Take& take,
                              const Hint& hint) const
{
    std::map<std::size_t, std::string> given; // by which key
    for (const Item& item : table.items()) {
        const Tree parsed = read_array_expression(item.value(), item.title());
        for (const RunningKey& each : require_keys(symbols, item.key(), table.title(), noun, model.scope, hint)) {
            const ResolvedKey& key = each.key;
            const std::string what = item.title_of(key.name);
            const ArrayValue closed =
                close(replace_names(parsed, each.indices), item.row().roles, what, item.row().nonsmooth);
            const std::vector<Tree> values = fit_values(closed, key.shape, what, item.value().where);
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::size_t place = key.indices[k];
                if (const auto [first, fresh] = given.try_emplace(place, item.name()); !fresh)
                    throw complain::twice(item.title_of(symbols[place].name), first->second, item.name(), item.where());
                take(place, values[k], item);
            }
        }
    }
}

void ModelReader::declare_keys(const Item& block, Role role)
{
    for (const Item& item : block.items()) declare_symbols(*this, read_declaration(*this, item.key()).symbols, role);
}

void ModelReader::read_declared(const Item& block, const std::function<void(std::size_t, const Tree&)>& take) const
{
    std::size_t next = 0;
    for (const Item& item : block.items()) {
        const DeclaredKey key = read_declaration(*this, item.key());
        const std::string what = item.title_of(key.name);
        const ArrayValue closed =
            close(read_array_expression(item.value(), what), item.row().roles, what, item.row().nonsmooth);
        const std::string hint = key.shape.rank == Rank::scalar ? family_hint(key.name, closed.shape) : "";
        for (const Tree& value : fit_values(closed, key.shape, what, item.value().where, hint)) take(next++, value);
    }
}

std::vector<ComponentEntry> read_components(const ModelReader& reader, const Item& table)
{
    std::vector<ComponentEntry> out;
    const char* noun = is_nonholonomic(reader.model) ? "ambient fibre coordinate" : "fibre coordinate";
    reader.read_values(table, ambient_fibre(reader.model), noun,
                       [&](std::size_t a, const Tree& value, const Item& item) {
                           if (!is_plain_zero(value)) out.push_back(ComponentEntry{a, value, item.where()});
                       });
    return out;
}

void append_entries(std::vector<NamedTree>& list, const Excerpt& key, const ArrayValue& value)
{
    const SourceRange where = key.range(0, key.text.size());
    for (std::size_t k = 0; k < value.entries.size(); ++k)
        list.push_back(NamedTree{entry_name(key.text, value.shape, k), value.entries[k], where});
}

} // namespace lagen
