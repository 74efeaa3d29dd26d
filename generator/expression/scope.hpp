// SPDX-License-Identifier: GPL-2.0-or-later
/// Names and definitions: from a parsed tree to a closed one, in which only declared symbols, numbers, pi, operators
/// and built-in functions are left.
#pragma once

#include "expression/array.hpp"
#include "expression/tree.hpp"

#include <map>
#include <optional>
#include <set>

namespace lagen {

class Expansion;

/// `name = body` or `name(parameters) = body`.
struct Definition {
    std::string name;
    std::vector<std::string> parameters; ///< empty: a named sub-expression
    Tree body;                           ///< as parsed
    SourceRange where;                   ///< of its key
};

/// Closing throws this for a symbol that is not declared, so that a caller that accepts fewer names can hint at those.
class UnknownSymbol : public ModelError {
  public:
    UnknownSymbol(std::string name, const SourceRange& where, const std::string& hint, bool explained = false);
    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    /// The hint is of this very name, no list of others.
    [[nodiscard]] bool is_explained() const noexcept { return explained_; }

  private:
    std::string name_;
    bool explained_;
};

/// The symbols and definitions that an expression may use. Definitions may stand in any order.
class Scope {
  public:
    /// Declares a symbol. A name declared twice (as symbol or definition) is a ModelError that names both places.
    void declare(const std::string& symbol, const SourceRange& where);
    void define(Definition definition);
    /// Declares a family: `name` is the vector or matrix, its entries are the symbols entry_name(name, shape, k).
    void declare_family(const std::string& name, const Shape& shape, const SourceRange& where);
    /// Declares a size: an integer constant, usable in ranges and expressions alike.
    void declare_size(const std::string& name, long value, const SourceRange& where);
    /// The hint where `name`, which is not declared here, is used all the same: what it is elsewhere.
    void explain(const std::string& name, const std::string& hint);
    /// Hints list `name`, a symbol, family or size, behind all others.
    void list_last(const std::string& name);

    /// A declared symbol or entry of a family.
    [[nodiscard]] bool has_symbol(const std::string& name) const;
    [[nodiscard]] bool has_definition(const std::string& name) const { return find_definition(name) != nullptr; }
    /// The shape of a declared family, nullptr where there is none.
    [[nodiscard]] const Shape* find_family(const std::string& name) const;
    [[nodiscard]] std::optional<long> find_size(const std::string& name) const;

    /// The closed form of `tree`. A definition is expanded once and shared (the same Tree wherever it is used; a
    /// function once for each distinct list of argument trees). Without `nonsmooth`, min max sign if are refused.
    /// Throws ModelError: unknown symbol (with the nearest known name as hint), wrong number of arguments, a cycle
    /// among definitions (the cycle is listed), an expansion of more than 10^6 distinct nodes or deeper than 2000.
    /// Sums and products are written out, vectors and matrices taken apart, sizes replaced by numbers: the result is
    /// scalar (an error where it is a vector or matrix).
    [[nodiscard]] Tree close(const Tree& tree, bool nonsmooth = false) const;

    /// The same for an expression that may be a vector or a matrix.
    [[nodiscard]] ArrayValue close_array(const Tree& tree, bool nonsmooth = false) const;

    /// The value of an expression that is an integer constant over sizes, and nothing for any other.
    /// Throws ModelError as `close` does.
    [[nodiscard]] std::optional<long> integer(const Tree& tree) const;

    /// A scope with these extra symbols (as for events and observables, which may also use momenta). A name that this
    /// scope has already keeps its meaning: what a model declares wins.
    [[nodiscard]] Scope with(const std::vector<std::string>& symbols) const;

    /// Closes every definition, the bodies of functions with their parameters as symbols, so that a mistake in one that
    /// nobody uses is found. Functions that are not smooth are accepted here: where they are used decides.
    void check_definitions() const;

  private:
    friend class Expansion;
    struct Symbol {
        std::string name;
        SourceRange where;
    };
    struct FamilyOfSymbols {
        std::string name;
        Shape shape;
        SourceRange where;
    };
    struct DeclaredSize {
        std::string name;
        long value;
        SourceRange where;
    };
    /// A symbol, an entry, a family or a size.
    [[nodiscard]] bool has_name(const std::string& name) const;
    /// Symbols, families, sizes and definitions without parameters in order of declaration; those that are to be listed
    /// last behind the others.
    [[nodiscard]] std::vector<std::string> value_names() const;
    /// "w[1]" for w1 and w_1 where there is such an entry; empty where there is none.
    [[nodiscard]] std::string entry_meant(const std::string& name) const;
    [[nodiscard]] const SourceRange* find_declaration(const std::string& name) const;
    void require_new(const std::string& name, const SourceRange& where) const;
    [[nodiscard]] const Definition* find_definition(const std::string& name) const;

    std::vector<Symbol> symbols_;
    std::vector<FamilyOfSymbols> families_;
    std::vector<DeclaredSize> sizes_;
    std::vector<Definition> definitions_;
    std::map<std::string, std::size_t> symbol_index_;
    std::map<std::string, std::size_t> family_index_;
    std::map<std::string, std::size_t> size_index_;
    std::map<std::string, std::size_t> definition_index_;
    std::map<std::string, std::string> explanations_;
    std::vector<std::string> order_; ///< of declaration: symbols, families and sizes
    std::set<std::string> last_;     ///< those that hints list last
    /// The expansions made so far. They depend on the names above alone, so that copies may share it; a scope drops
    /// its hold on it when a name joins.
    mutable std::shared_ptr<Expansion> expansion_;
};

} // namespace lagen
