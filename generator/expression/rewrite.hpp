// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees with some of their parts replaced. Shared parts stay shared, and a tree in which nothing changes stays itself.
#pragma once

#include "expression/tree.hpp"

#include <functional>
#include <map>

namespace lagen {

/// `tree` with every part for which `replacement` gives a tree (not null) replaced by that tree, outermost first; the
/// replacement itself is not looked into.
[[nodiscard]] Tree rewrite(const Tree& tree, const std::function<Tree(const Tree&)>& replacement);

using TreesByName = std::map<std::string, Tree>;

/// `tree` with the names of `replacements` replaced. Nothing that comes in is captured by an index of a sum: the index
/// is renamed.
[[nodiscard]] Tree replace_names(const Tree& tree, const TreesByName& replacements);

/// True where one of the replacements mentions `name`.
[[nodiscard]] bool introduces(const TreesByName& replacements, const std::string& name);

/// `name` with underscores behind it, so that neither `body` nor a replacement has it.
[[nodiscard]] std::string uncaptured_name(const std::string& name, const Tree& body, const TreesByName& replacements);

} // namespace lagen
