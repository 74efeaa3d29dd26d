// SPDX-License-Identifier: GPL-2.0-or-later
/// One form of a set of outputs, as polynomials over atoms, and the passes of the portfolio on it.
#pragma once

#include "graph/simplify/polynomial.hpp"

namespace lagen {

/// What is multiplied out while a form is read off the graph.
enum class ExpansionMode {
    nested,    ///< sums stay closed, and a sum with several users stays one term of theirs: no work is repeated
    none,      ///< sums stay closed
    monomials, ///< x (a + b), but not (a + b)(c + d)
    all,       ///< everything, under a budget of terms for each sum
};

struct Form {
    Algebra algebra;
    std::vector<Polynomial> roots;
};

/// The outputs with like terms collected. Throws FormRefused where the budget does not suffice.
[[nodiscard]] Form collect(const Graph& graph, std::span<const NodeId> outputs, ExpansionMode expansion);

/// Multiplies closed sums out where terms cancel by it.
void cancel_terms(Form& form);

/// Divides the rows of linear systems by the factors that all their terms share. Every atom that it divided by, which
/// must not vanish, is appended as a root of its own; answers their number.
std::size_t divide_rows(Form& form);

/// Draws the factor that most terms of a sum share out of it, again and again, in all sums (multivariate Horner).
void draw_out_factors(Form& form);

/// Names pairs of factors, and pairs of terms, that occur at least twice.
void share_factor_pairs(Form& form);
void share_term_pairs(Form& form);

/// Names the reciprocal of a divisor that at least two terms share: one division, the others multiply.
void share_reciprocals(Form& form);

/// Puts the named products that one term alone uses back into that term, so that it has one fraction bar.
void inline_single_products(Form& form);

/// Flips the signs of named sums and products where that saves negations. The identity of the atoms is lost: this is
/// the last pass.
void absorb_signs(Form& form);

/// The form as nodes of `graph`, one an output.
[[nodiscard]] std::vector<NodeId> rebuild(const Form& form, Graph& graph);

/// The outputs with sines and cosines of sums a + b, a - b written in those of a and b, where these are there already
/// and the loss of relative accuracy does no harm.
[[nodiscard]] std::vector<NodeId> add_angles(Graph& graph, std::span<const NodeId> outputs);

/// A polynomial of a form: operand `operand` of an atom, or a root.
struct Place {
    bool root = false;
    AtomId atom = 0;
    std::size_t operand = 0; ///< index of the root where `root`
};

/// The polynomials that the roots need, operands before their users. Throws FormRefused on a cycle.
[[nodiscard]] std::vector<Place> live_places(const Form& form);
[[nodiscard]] Polynomial& at(Form& form, const Place& place);
[[nodiscard]] const Polynomial& at(const Form& form, const Place& place);

/// The atoms that the roots need, operands before their users. Throws FormRefused on a cycle.
[[nodiscard]] std::vector<AtomId> live_atoms(const Form& form);

} // namespace lagen
