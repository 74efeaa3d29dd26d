// SPDX-License-Identifier: GPL-2.0-or-later
/// Derived equations as plain named trees: all that printing ever sees of mechanics.
#pragma once

#include "expression/tree.hpp"

namespace lagen {

/// How a left-hand side reads.
enum class LeftSide {
    time_derivative, ///< d(symbol)/dt
    symbol,          ///< symbol itself
    zero,            ///< 0 = right
    bracket,         ///< {symbol, other}
    differential,    ///< d of the function symbol
    form,            ///< the basis form e^symbol under d
    component,       ///< symbol(arguments): a form on sections
    section,         ///< the section e_symbol; the basis of groups is one of sections then
    commutator,      ///< [e_symbol, e_other], likewise
};

/// How the left side stands to the right one.
enum class Relation { equal, at_least, at_most };

/// A group of terms of a right-hand side that belongs together in the formula it came from, for instance
/// rho_a(L) or -p_c C^c_ab y^b. `label` is a short UTF-8 name of the group; may be empty. With a `basis` the group is
/// value e^{basis[0]} ^ e^{basis[1]} ^ .., or value e_{basis[0]} where the left side is a section.
struct TermGroup {
    std::string label;
    Tree value;
    std::vector<std::string> basis = {};
};

/// A letter that stands for an index of families, from `from` to `to`.
struct IndexRange {
    std::string letter;
    std::size_t from, to;

    friend bool operator==(const IndexRange&, const IndexRange&) = default;
};

/// Stands before the name of a symbol in a written equation where its rate is meant.
inline constexpr char rate_mark = '\'';

/// left = sum of groups, or an inequality. With `mass` entries the left side is sum_b mass[b].value *
/// d(mass[b].label)/dt instead; without a label the value has the rate in it.
struct Equation {
    LeftSide left = LeftSide::time_derivative;
    std::string symbol;
    std::vector<TermGroup> mass;   ///< W_ab ydot^b: label = y^b, value = W_ab (zero entries left out)
    std::vector<TermGroup> groups; ///< empty: the right side is 0
    std::string other = {};        ///< of a bracket: its second function
    Relation relation = Relation::equal;
    std::vector<std::string> arguments = {}; ///< of a component: the sections by name
    std::vector<IndexRange> ranges = {};     ///< the indices that it is written with letters for
};

/// One titled block, e.g. "momenta" or "equations of motion (acceleration form)", with its formula in UTF-8.
struct EquationBlock {
    std::string title;
    std::string formula; ///< e.g. "W_ab ẏ^b = ρ_a(L) − (∂²L/∂y^a∂x^i) ρ^i_b y^b − p_c C^c_ab y^b"
    std::string latex_formula;
    std::vector<Equation> equations;
    /// The same as a paper has them, by vectors, indices and sums over these (TreeKind::sum_over: from, to, body and
    /// perhaps the value that is left out); empty: as they are.
    std::vector<Equation> written = {};
};

/// What is said of the equations, and whether it was proved.
struct DecidedStatement {
    std::string formula, latex_formula;
    std::string status; ///< "proved", "refuted", "undecided"
    /// Of the first component that is not proved: its sections, what should vanish, a point with the value there.
    std::vector<std::string> component = {};
    std::string residual = {};
    std::vector<std::pair<std::string, std::string>> witness = {};
    double value = 0;
    std::string evidence = {}; ///< what is known of it; may be empty
};

/// A symbol of the equations that stands for a longer expression: a definition of the model, a derivative of one.
struct WhereEntry {
    std::string symbol;     ///< of an entry of a vector: "r[1]"
    Tree value;             ///< over coordinates, parameters and other symbols of the list
    std::size_t family = 1; ///< the entries of the vector, which stand together; 1: no vector
};

/// A vector of three declared symbols, or a diagonal matrix of them, that written equations have under one name.
struct VectorText {
    std::string name;
    std::vector<Tree> entries;
    bool diagonal = false;
};

struct SymbolText {
    std::string name;
    std::string latex; ///< how LaTeX shows the symbol; empty: made from the name
};

/// Everything that `derive` shows, for one formulation.
struct EquationSet {
    std::string model;
    std::string title;
    std::string form; ///< its name: "lagrange", "exterior"
    std::vector<SymbolText> symbols;
    std::vector<EquationBlock> blocks;
    std::vector<EquationBlock> given = {}; ///< what the model gives, before them: L, brackets, constraints
    std::vector<DecidedStatement> statements = {};
    std::vector<WhereEntry> where = {};       ///< each over coordinates, parameters and others of the list
    std::vector<Equation> written_where = {}; ///< the same by indices; empty: as they are
    std::vector<VectorText> vectors = {};     ///< of the written equations, but for families, which bear their name
};

} // namespace lagen
