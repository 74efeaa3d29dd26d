// SPDX-License-Identifier: GPL-2.0-or-later
/// Declarations of families, "x[1..n]" and "W[1..3,1..3]", and the names of their entries as keys, "x[ 3 ]".
#pragma once

#include "expression/parse.hpp"
#include "expression/scope.hpp"

namespace lagen {

/// name[1..upper[0]] or name[1..upper[0], 1..upper[1]].
struct FamilyDeclaration {
    std::string name;
    std::vector<Tree> upper; ///< one or two, as parsed
    SourceRange where;       ///< of the whole declaration
};

/// True where a text has a bracket: it declares a family or names an entry, well or badly.
[[nodiscard]] bool has_bracket(std::string_view text);

/// Throws ModelError: no name, no range, a range that does not start at 1, more than two ranges, text behind.
[[nodiscard]] FamilyDeclaration parse_family(const Excerpt& text);

/// The shape of a declaration by the sizes that `scope` knows. Throws ModelError: an end that is no integer constant or
/// below 1, more than 4096 entries.
[[nodiscard]] Shape close_shape(const FamilyDeclaration& family, const Scope& scope);

/// The indices of "x[j]" and "W[i,j]" that are names which `scope` does not know, each at its place; others are empty.
/// Throws ModelError as `entry_key` does.
[[nodiscard]] std::vector<std::string> running_indices(const Excerpt& text, const Scope& scope);

/// The name of an entry as closing spells it: "x[ 3 ]" is "x[3]", "W[1,n]" is "W[1,3]" where n is 3. A text without
/// brackets is returned as it is. Throws ModelError: no name, an index that is no positive integer constant, more than
/// two of them, text behind. `running` has values of indices that the scope does not know.
[[nodiscard]] std::string entry_key(const Excerpt& text, const Scope& scope,
                                    const std::map<std::string, std::size_t>& running = {});

} // namespace lagen
