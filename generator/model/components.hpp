// SPDX-License-Identifier: GPL-2.0-or-later
/// Tables with a value a fibre coordinate: [forces] and `sigma` of [control].
#pragma once

#include "model/families.hpp"

#include <initializer_list>

namespace lagen {

/// How messages call such a table, and what its values may be.
struct ComponentRules {
    std::string title; ///< "[forces]"
    std::string what;  ///< "the force on": of a value, before the name of its key
    std::initializer_list<Role> roles;
    bool nonsmooth; ///< min max sign if are allowed
};

/// The entries that are not a plain 0, closed, in the order of the file; a family's name gives all its entries. Throws
/// ModelError: a key that is no fibre coordinate, a component given twice, a value over other roles or of another
/// shape.
[[nodiscard]] std::vector<ComponentEntry> read_components(const ModelReader& reader, const TomlEntry& block,
                                                          const ComponentRules& rules);

} // namespace lagen
