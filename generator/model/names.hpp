// SPDX-License-Identifier: GPL-2.0-or-later
/// Everything that a model names, with the part that it plays and the place where it was declared.
#pragma once

#include "expression/array.hpp"
#include "text/diagnostic.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lagen {

enum class Role {
    time,
    size,
    parameter,
    base,
    fibre,
    ambient,
    momentum,
    control,
    state,
    input,
    definition,
    velocity,
    casimir,
    observable,
    form,
    element,
    next,
    step,
    built_in
};

/// A set of roles: the names that an expression may use.
struct Roles {
    std::uint32_t bits = 0;

    constexpr Roles() = default;
    constexpr Roles(Role role) : bits(1U << static_cast<unsigned>(role)) {}
    [[nodiscard]] constexpr bool has(Role role) const { return (bits & Roles(role).bits) != 0; }
    friend constexpr Roles operator|(Roles a, Roles b)
    {
        a.bits |= b.bits;
        return a;
    }
    friend constexpr bool operator==(Roles, Roles) = default;
};
constexpr Roles operator|(Role a, Role b)
{
    return Roles(a) | Roles(b);
}

/// "a base coordinate", ...: how messages call a role.
[[nodiscard]] const char* role_text(Role role);

/// "base coordinates", ...: several of them.
[[nodiscard]] std::string role_plural(Role role);

class Names {
  public:
    struct Entry {
        Role role;
        SourceRange where;
    };

    /// Throws ModelError: a name declared twice (both places are named), the reserved name t, a name of a built-in
    /// function, no identifier, more than 4096 names.
    void declare(const std::string& name, Role role, const SourceRange& where);

    /// Declares a family and its entries ("x[1]", ..), which `find` knows from then on; `of` and `order` name the
    /// family alone. Throws ModelError also for more than 16384 entries in all families.
    void declare_family(const std::string& name, const Shape& shape, Role role, const SourceRange& where);

    /// A declared name, or an entry of a family.
    [[nodiscard]] const Entry* find(const std::string& name) const;
    [[nodiscard]] const std::vector<std::string>& order() const { return order_; }

    /// The names of one role, in order of declaration.
    [[nodiscard]] std::vector<std::string> of(Role role) const;

  private:
    std::map<std::string, Entry> entries_;
    std::vector<std::string> order_;
    std::size_t family_entries_ = 0;
};

/// Throws ModelError unless `name` is an identifier (ASCII or Unicode letters, digits, _).
void require_identifier(const std::string& name, const SourceRange& where, const char* what);

/// Throws ModelError unless `name` can be the name of a C++ class: ASCII letters, digits and _, no keyword, nothing
/// that C++ reserves for itself.
void require_class_name(const std::string& name, const SourceRange& where, bool from_file_name);

} // namespace lagen
