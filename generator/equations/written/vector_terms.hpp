// SPDX-License-Identifier: GPL-2.0-or-later
/// Polynomials in the entries of vectors and matrices as sums of vector expressions: v, M v, a x b, a x (b x c),
/// (a . b) c, the basis e_k and a x e_k; of scalars a . b. A sum is found by exact arithmetic on the coefficients, so
/// what is found is equal.
#pragma once

#include "equations/written/vector_names.hpp"

#include <map>
#include <optional>
#include <set>

namespace lagen {

using Monomial = std::vector<std::string>;       ///< entries, sorted, each as often as its power
using Polynomial = std::map<Monomial, Rational>; ///< none of the coefficients is 0
using Polynomials = std::vector<Polynomial>;     ///< three components, or one

/// The names of the entries that polynomials are in.
[[nodiscard]] std::set<std::string> entry_names(const VectorNames& names);

/// A vector expression: functions cross(a, b) and dot(a, b), products of matrices and vectors.
struct VectorTerm {
    Tree tree;
    Tree opposite; ///< what is -1 times the same, b x a; null where there is none
    Polynomials value;
    std::size_t basis = 0;                              ///< k of a term with e_k; 0: none
    std::set<std::string> vectors = {}, diagonals = {}; ///< names that it has, those of diagonal matrices by themselves

    [[nodiscard]] bool is_product() const { return opposite != nullptr; }
};

class VectorTerms {
  public:
    /// What a sum of `value` may be made of: of the vectors and matrices whose entries occur in it.
    VectorTerms(const VectorNames& names, const Polynomials& value);

    /// The vectors v and the products M v of this one alone: what the left side of an equation may be made of.
    static VectorTerms of_rate(const VectorNames& names, const VectorName& vector);

    [[nodiscard]] const VectorTerm& operator[](std::size_t k) const { return terms_[k]; }

    /// (k, factor) of terms that add up to `value`; nothing where none were found.
    [[nodiscard]] std::optional<std::map<std::size_t, Rational>> sum_of(const Polynomials& value) const;

  private:
    VectorTerms() = default;
    void append_scalars(const std::vector<VectorTerm>& factors);
    void append_vectors(const std::vector<VectorTerm>& plain, const std::vector<VectorTerm>& factors,
                        const VectorNames& names);
    void append_triple_products(const std::vector<VectorTerm>& plain);
    [[nodiscard]] bool peel(const Polynomials& rest, std::map<std::size_t, Rational>& sum, std::size_t& budget) const;

    std::vector<VectorTerm> terms_; ///< the simplest first
};

} // namespace lagen
