// SPDX-License-Identifier: GPL-2.0-or-later
/// Laurent polynomials over atoms: the form in which `simplify` collects, factors and shares terms.
/// An atom is an input, a function of polynomials, a sum that is not multiplied out, or a product given a name.
#pragma once

#include "graph/core/graph.hpp"

#include <algorithm>
#include <map>

namespace lagen {

using AtomId = std::uint32_t;

struct Factor {
    AtomId atom = 0;
    int exponent = 1; ///< never 0; negative: in the denominator
    friend bool operator==(const Factor&, const Factor&) = default;
    friend auto operator<=>(const Factor&, const Factor&) = default;
};

using Monomial = std::vector<Factor>; ///< by ascending atom

struct Term {
    Rational coefficient; ///< never 0
    Monomial monomial;
};

using Polynomial = std::vector<Term>; ///< by ascending monomial, each once; empty: 0

[[nodiscard]] bool less(const Polynomial& a, const Polynomial& b);

/// op `add`: the sum operands[0]; op `multiply`: the single term operands[0]; op `input`, `pi`: the node `payload`;
/// every other op: that operation of the graph on the operands (a `solve` has its `factor` as first operand).
struct Atom {
    Op op = Op::input;
    std::uint32_t payload = 0;
    std::vector<Polynomial> operands;
};

/// Thrown where a form cannot be built: the budget is spent, or a divisor vanishes identically. The caller keeps what
/// it has.
struct FormRefused {};

/// The atoms and the arithmetic on them.
class Algebra {
  public:
    /// The atom of this operation on these operands, the same one for the same operands.
    AtomId atom(Op op, std::uint32_t payload, std::vector<Polynomial> operands);
    [[nodiscard]] std::size_t size() const { return atoms_.size(); }
    [[nodiscard]] const Atom& operator[](AtomId id) const { return atoms_[id]; }
    /// The operands of an atom, to be rewritten to equal values; its identity stays that of its creation.
    [[nodiscard]] std::vector<Polynomial>& operands(AtomId id) { return atoms_[id].operands; }

    [[nodiscard]] Polynomial add(const Polynomial& a, const Polynomial& b);
    [[nodiscard]] Polynomial scaled(Polynomial a, const Rational& factor);
    [[nodiscard]] Term multiply(const Term& a, const Term& b);
    /// Every term of a times every term of b.
    [[nodiscard]] Polynomial distribute(const Polynomial& a, const Polynomial& b);
    /// a as one term: its content times the atom of the primitive sum (leading coefficient positive). Refuses 0.
    [[nodiscard]] Term as_term(const Polynomial& a);
    /// term^n, n != 0.
    [[nodiscard]] Term power(const Term& term, int n);

    /// c m sin(a)^2 + c m cos(a)^2 = c m, wherever both terms stand.
    [[nodiscard]] Polynomial contract_circles(Polynomial a);

    /// How many terms may be made before FormRefused is thrown; for forms whose work is linear in the graph.
    void allow(std::size_t terms) { most_work_ = std::max(most_work_, terms); }

    /// Divides out the content: rational (sign of the first term, gcd of numerators over lcm of denominators) times the
    /// common monomial. `a` becomes primitive.
    [[nodiscard]] Term extract_content(Polynomial& a) const;

  private:
    /// w = sqrt(c * base) or |c * base| makes base^q w^s unique: |s| <= 1, q and s of one sign, but for base / |base|.
    struct Root {
        AtomId base = 0;
        AtomId root = 0;
        Rational coefficient;
        bool absolute = false;
    };

    struct KeyLess {
        bool operator()(const Atom& a, const Atom& b) const;
    };

    void spend(std::size_t terms);
    void learn_root(AtomId root);
    void normalise_roots(Term& term) const;
    void normalise_root(Term& term, const Root& root) const;

    std::vector<Atom> atoms_;
    std::map<Atom, AtomId, KeyLess> ids_;
    std::vector<Root> roots_;
    std::size_t work_ = 0; ///< terms made so far
    std::size_t most_work_ = 300'000;
};

} // namespace lagen
