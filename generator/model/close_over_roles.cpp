// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing an expression that may use only some of the model's names.
#include "expression/find_part.hpp"
#include "expression/name_hints.hpp"
#include "model/model_reader.hpp"
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
Tree first_forbidden(const std::vector<Tree>& trees, const Names& names, std::initializer_list<Role> roles)
{
    return find_name(trees, [&](const std::string& name) {
        return std::find(roles.begin(), roles.end(), role_of(names, name)) == roles.end();
    });
}

/// Each once, in order.
std::vector<Role> distinct(std::initializer_list<Role> roles)
{
    std::vector<Role> out;
    for (const Role role : roles)
        if (std::find(out.begin(), out.end(), role) == out.end()) out.push_back(role);
    return out;
}

void require_roles(const std::vector<Tree>& closed, const Names& names, std::initializer_list<Role> roles,
                   const SourceRange& where, const std::string& what)
{
    const Tree bad = first_forbidden(closed, names, roles);
    if (bad == nullptr) return;
    const std::string allowed = comma_list(distinct(roles), role_plural);
    throw ModelError(fmt::format("{} may not depend on {} ('{}')", what,
                                 std::string_view(role_text(role_of(names, bad->name))), bad->name),
                     bad->where.file ? bad->where : where, "allowed here: " + allowed);
}

bool admits(std::initializer_list<Role> roles, Role role)
{
    return std::find(roles.begin(), roles.end(), role) != roles.end();
}

/// The names that an expression over `roles` may use: coordinates, controls and momenta, definitions over those, then
/// parameters and sizes.
std::vector<std::string> names_over(const ModelReader& reader, const Scope& scope, std::initializer_list<Role> roles)
{
    std::vector<std::string> known;
    const auto append = [&](Role role) {
        const std::vector<std::string> of_role = reader.names.of(role);
        known.insert(known.end(), of_role.begin(), of_role.end());
    };
    for (const Role role : distinct(roles))
        if (role != Role::parameter && role != Role::time) append(role);
    for (const Definition& definition : reader.model.definitions) {
        if (!definition.parameters.empty()) continue;
        try {
            const ArrayValue value = scope.close_array(name(definition.name));
            if (first_forbidden(value.entries, reader.names, roles) == nullptr) known.push_back(definition.name);
        } catch (const ModelError&) { // over names that are not legal here, or itself wrong
        }
    }
    if (admits(roles, Role::time)) known.emplace_back("t");
    if (admits(roles, Role::parameter)) append(Role::parameter);
    append(Role::size);
    return known;
}

/// The hint names what was meant, among the names that are legal here.
[[noreturn]] void refuse_unknown(const UnknownSymbol& error, const ModelReader& reader, const Scope& scope,
                                 std::initializer_list<Role> roles)
{
    if (error.is_explained()) throw error;
    const auto refuse = [&error](const std::string& hint) {
        throw ModelError(error.diagnostic().message, error.diagnostic().where, hint);
    };
    const bool velocities = admits(roles, Role::fibre) || admits(roles, Role::ambient);
    const std::string meant = velocities                      ? hint_for_rate(error.name(), reader.rates)
                              : admits(roles, Role::momentum) ? hint_for_momentum(error.name(), reader.rates)
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

template <class Close>
auto closed_over(const ModelReader& reader, const Scope& scope, std::initializer_list<Role> roles, Close close)
{
    try {
        return close();
    } catch (const UnknownSymbol& error) {
        refuse_unknown(error, reader, scope, roles);
    }
}

} // namespace

Tree ModelReader::close_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                           const std::string& what) const
{
    return closed_over(*this, scope, roles, [&] {
        Tree closed = scope.close(tree);
        require_roles({closed}, names, roles, tree->where, what);
        return closed;
    });
}

ArrayValue ModelReader::close_array_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                                       const std::string& what, bool nonsmooth) const
{
    return closed_over(*this, scope, roles, [&] {
        ArrayValue closed = scope.close_array(tree, nonsmooth);
        require_roles(closed.entries, names, roles, tree->where, what);
        return closed;
    });
}

void append_entries(std::vector<NamedTree>& list, const Excerpt& key, const ArrayValue& value)
{
    const SourceRange where = key.range(0, key.text.size());
    for (std::size_t k = 0; k < value.entries.size(); ++k)
        list.push_back(NamedTree{entry_name(key.text, value.shape, k), value.entries[k], where});
}

} // namespace lagen
