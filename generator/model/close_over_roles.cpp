// SPDX-License-Identifier: GPL-2.0-or-later
/// Closing an expression that may use only some of the model's names.
#include "expression/name_hints.hpp"
#include "model/model_reader.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace lagen {

namespace {

Role role_of(const Names& names, const std::string& name)
{
    const Names::Entry* entry = names.find(name);
    return entry != nullptr ? entry->role : name == "t" ? Role::time : Role::built_in;
}

/// The first name in `trees` that plays none of `roles`; walks shared trees once.
const TreeNode* first_forbidden(const std::vector<Tree>& trees, const Names& names, std::initializer_list<Role> roles)
{
    std::set<const TreeNode*> seen;
    std::vector<const TreeNode*> stack;
    for (auto tree = trees.rbegin(); tree != trees.rend(); ++tree) stack.push_back(tree->get());
    while (!stack.empty()) {
        const TreeNode* node = stack.back();
        stack.pop_back();
        if (!seen.insert(node).second) continue;
        if (node->kind == TreeKind::name &&
            std::find(roles.begin(), roles.end(), role_of(names, node->name)) == roles.end())
            return node;
        for (auto argument = node->arguments.rbegin(); argument != node->arguments.rend(); ++argument) {
            stack.push_back(argument->get());
        }
    }
    return nullptr;
}

void require_roles(const std::vector<Tree>& closed, const Names& names, std::initializer_list<Role> roles,
                   const SourceRange& where, const std::string& what)
{
    const TreeNode* bad = first_forbidden(closed, names, roles);
    if (bad == nullptr) return;
    std::string allowed;
    for (const Role each : roles) allowed += (allowed.empty() ? "" : ", ") + role_plural(each);
    throw ModelError(fmt::format("{} may not depend on {} ('{}')", what,
                                 std::string_view(role_text(role_of(names, bad->name))), bad->name),
                     bad->where.file ? bad->where : where, "allowed here: " + allowed);
}

/// An expression over parameters, or over the base too, hints at those alone.
[[noreturn]] void refuse_unknown(const UnknownSymbol& error, const Names& names, std::initializer_list<Role> roles)
{
    std::vector<std::string> known;
    for (const Role role : roles) {
        if (role == Role::fibre) throw error;
        const std::vector<std::string> of_role = names.of(role);
        known.insert(known.end(), of_role.begin(), of_role.end());
    }
    if (known.empty()) throw error;
    throw ModelError(error.diagnostic().message, error.diagnostic().where, hint_for_symbol(error.name(), known));
}

template <class Close>
auto closed_over(const Names& names, std::initializer_list<Role> roles, Close close)
{
    try {
        return close();
    } catch (const UnknownSymbol& error) {
        refuse_unknown(error, names, roles);
    }
}

} // namespace

Tree ModelReader::close_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                           const std::string& what) const
{
    return closed_over(names, roles, [&] {
        Tree closed = scope.close(tree);
        require_roles({closed}, names, roles, tree->where, what);
        return closed;
    });
}

ArrayValue ModelReader::close_array_in(const Scope& scope, const Tree& tree, std::initializer_list<Role> roles,
                                       const std::string& what, bool nonsmooth) const
{
    return closed_over(names, roles, [&] {
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
