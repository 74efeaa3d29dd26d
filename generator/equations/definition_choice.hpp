// SPDX-License-Identifier: GPL-2.0-or-later
/// Which definitions of a model stay symbols in its derived equations.
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

#include <exception>
#include <functional>
#include <set>

namespace lagen {

/// How a derivation treats the definitions of the model.
enum class Definitions {
    expanded, ///< all are written out in coordinates and parameters
    kept,     ///< those that pay for their names stay symbols, where the derivation can
};

/// Which definitions stay symbols.
struct DefinitionChoice {
    bool kept = false;                       ///< false: none, everything is written out in coordinates and parameters
    std::set<std::string> dropped = {};      ///< names that are written out all the same
    std::size_t longest = std::string::npos; ///< characters of equations, above which the derivation is given up
};

/// What a derivation throws that would need more names than anybody reads, or grows above its `longest`.
class TooMuchToRead : public std::exception {};

/// `derivation` with the definitions that pay for their names: those that stand twice in one block or three times in
/// all, or are long. Others are written out; so are those made of sines and cosines where that leaves less than two
/// thirds, and all where that is shorter than a long form with symbols or the derivation does not go through with them.
[[nodiscard]] EquationSet with_definitions(const Model& model, Definitions definitions,
                                           const std::function<EquationSet(const DefinitionChoice&)>& derivation);

/// Nodes of a tree when it is written out, counted to some thousand.
[[nodiscard]] std::size_t written_nodes(const Tree& tree);

/// Every tree of a block.
void for_each_tree(const EquationBlock& block, const std::function<void(const Tree&)>& visit);

} // namespace lagen
