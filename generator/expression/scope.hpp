// SPDX-License-Identifier: GPL-2.0-or-later
/// Names and definitions: from a parsed tree to a closed one, in which only declared symbols, numbers, pi, operators
/// and built-in functions are left.
#pragma once

#include "expression/tree.hpp"

#include <map>
#include <optional>

namespace lagen {

/// `name = body` or `name(parameters) = body`.
struct Definition {
    std::string name;
    std::vector<std::string> parameters; ///< empty: a named sub-expression
    Tree body;                           ///< as parsed
    SourceRange where;                   ///< of its key
};

/// The symbols and definitions that an expression may use. Definitions may stand in any order.
class Scope {
  public:
    /// Declares a symbol. A name declared twice (as symbol or definition) is a ModelError that names both places.
    void declare(const std::string& symbol, const SourceRange& where);
    void define(Definition definition);

    [[nodiscard]] bool has_symbol(const std::string& name) const;

    /// The closed form of `tree`. A definition is expanded once and shared (the same Tree wherever it is used; a
    /// function once for each distinct list of argument trees). Without `nonsmooth`, min max sign if are refused.
    /// Throws ModelError: unknown symbol (with the nearest known name as hint), wrong number of arguments, a cycle
    /// among definitions (the cycle is listed), an expansion of more than 10^6 distinct nodes or deeper than 2000.
    [[nodiscard]] Tree close(const Tree& tree, bool nonsmooth = false) const;

    /// A scope with these extra symbols (as for events and observables, which may also use momenta).
    [[nodiscard]] Scope with(const std::vector<std::string>& symbols) const;

  private:
    struct Symbol {
        std::string name;
        SourceRange where;
    };
    std::vector<Symbol> symbols_;
    std::vector<Definition> definitions_;
    mutable std::map<std::string, Tree> closed_; ///< expansions of the definitions without parameters
};

} // namespace lagen
