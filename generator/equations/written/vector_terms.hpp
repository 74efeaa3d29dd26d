// SPDX-License-Identifier: GPL-2.0-or-later
/// Polynomials in the entries of vectors and matrices as sums of vector expressions: v, M v, a x b, a x (b x c),
/// (a . b) c, the basis e_k and a x e_k; of scalars a . b. A sum is found by exact arithmetic on the coefficients, so
/// what is found is equal.
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

#include <array>
#include <map>
#include <optional>
#include <set>

namespace lagen {

// Vectors of three and matrices of three by three among the declared names: families, and names with the numbers 1
// to 3.

struct VectorName {
    std::string name;
    std::array<std::string, 3> entries; ///< empty where a definition's entry is 0
    std::string latex = {};             ///< made of that of the entries; empty: from the name
    bool family = false;                ///< its entries are name[1] to name[3], or those of a row
};

struct MatrixName {
    std::string name;                   ///< "Jᵀ" of the transposed family
    std::array<std::string, 9> entries; ///< by rows; empty where an entry is 0
    bool diagonal = false;              ///< of three numbered parameters
};

struct VectorNames {
    std::vector<VectorName> vectors;
    std::vector<MatrixName> matrices;
    std::array<std::string, 3> basis = {}; ///< free names of e_1 to e_3; empty where a vector of the model is called e
};

/// The vectors and matrices among the symbols of `equations` and of what these stand for. Names with numbers are a
/// vector where the name without them is free: g1, g2, g3 beside a parameter g are none. Three numbered parameters of
/// `model` may also be a diagonal matrix.
[[nodiscard]] VectorNames vector_names(const EquationSet& equations, const Model& model);

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
    /// A sum of `value` may be made of these: of the vectors and matrices whose entries occur in it.
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
