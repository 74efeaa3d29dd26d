// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/written/vector_terms.hpp"

#include <algorithm>

namespace lagen {
namespace {

constexpr std::size_t most_attempts = 200; ///< of terms that are subtracted in the search of one sum

void add_to(Polynomial& sum, const Polynomial& term, const Rational& factor)
{
    for (const auto& [monomial, coefficient] : term) {
        Rational& entry = sum[monomial];
        entry += factor * coefficient;
        if (sgn(entry) == 0) sum.erase(monomial);
    }
}

Polynomial product(const Polynomial& a, const Polynomial& b)
{
    Polynomial result;
    for (const auto& [left, p] : a)
        for (const auto& [right, q] : b) {
            Monomial monomial = left;
            monomial.insert(monomial.end(), right.begin(), right.end());
            std::ranges::sort(monomial);
            add_to(result, {{monomial, Rational(p * q)}}, 1);
        }
    return result;
}

VectorTerm vector_of(const VectorName& vector)
{
    VectorTerm term{name(vector.name), nullptr, {}};
    term.vectors.insert(vector.name);
    for (const std::string& entry : vector.entries)
        term.value.push_back(entry.empty() ? Polynomial() : Polynomial{{{entry}, 1}});
    return term;
}

VectorTerm times(const MatrixName& matrix, const VectorName& vector)
{
    VectorTerm term{multiply({name(matrix.name), name(vector.name)}), nullptr, Polynomials(3)};
    term.vectors.insert(vector.name);
    (matrix.diagonal ? term.diagonals : term.vectors).insert(matrix.name);
    for (std::size_t k = 0; k < 9; ++k) {
        if (matrix.entries[k].empty() || vector.entries[k % 3].empty()) continue;
        Monomial monomial{matrix.entries[k], vector.entries[k % 3]};
        std::ranges::sort(monomial);
        add_to(term.value[k / 3], {{monomial, 1}}, 1);
    }
    return term;
}

VectorTerm with_names(VectorTerm term, const VectorTerm& a, const VectorTerm& b)
{
    for (const VectorTerm* each : {&a, &b}) {
        term.vectors.insert(each->vectors.begin(), each->vectors.end());
        term.diagonals.insert(each->diagonals.begin(), each->diagonals.end());
        term.basis = std::max(term.basis, each->basis);
    }
    return term;
}

VectorTerm cross(const VectorTerm& a, const VectorTerm& b)
{
    VectorTerm term{application("cross", {a.tree, b.tree}), application("cross", {b.tree, a.tree}), {}};
    for (std::size_t i = 0; i < 3; ++i) {
        Polynomial entry = product(a.value[(i + 1) % 3], b.value[(i + 2) % 3]);
        add_to(entry, product(a.value[(i + 2) % 3], b.value[(i + 1) % 3]), -1);
        term.value.push_back(std::move(entry));
    }
    return with_names(std::move(term), a, b);
}

VectorTerm dot(const VectorTerm& a, const VectorTerm& b)
{
    VectorTerm term{application("dot", {a.tree, b.tree}), nullptr, Polynomials(1)};
    for (std::size_t i = 0; i < 3; ++i) add_to(term.value[0], product(a.value[i], b.value[i]), 1);
    return with_names(std::move(term), a, b);
}

VectorTerm scaled(const VectorTerm& factor, const VectorTerm& vector)
{
    VectorTerm term{multiply({factor.tree, vector.tree}), nullptr, {}};
    for (const Polynomial& entry : vector.value) term.value.push_back(product(factor.value[0], entry));
    return with_names(std::move(term), factor, vector);
}

template <class Entries>
bool occurs(const Entries& entries, const std::set<std::string>& used)
{
    return std::ranges::any_of(entries, [&](const std::string& entry) { return used.contains(entry); });
}

/// True where all monomials of the term occur in what it is to be part of.
bool fits(const VectorTerm& term, const Polynomials& whole)
{
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const auto& [monomial, coefficient] : term.value[i])
            if (!whole[i].contains(monomial)) return false;
    return true;
}

} // namespace

std::set<std::string> entry_names(const VectorNames& names)
{
    std::set<std::string> entries;
    for (const VectorName& vector : names.vectors) entries.insert(vector.entries.begin(), vector.entries.end());
    for (const MatrixName& matrix : names.matrices) entries.insert(matrix.entries.begin(), matrix.entries.end());
    entries.erase("");
    return entries;
}

VectorTerms::VectorTerms(const VectorNames& names, const Polynomials& value)
{
    std::set<std::string> used;
    std::size_t degree = 0;
    for (const Polynomial& entry : value)
        for (const auto& [monomial, coefficient] : entry) {
            used.insert(monomial.begin(), monomial.end());
            degree = std::max(degree, monomial.size());
        }
    std::vector<VectorTerm> plain; // v
    for (const VectorName& vector : names.vectors)
        if (occurs(vector.entries, used)) plain.push_back(vector_of(vector));
    std::vector<VectorTerm> factors = plain; // M v behind them
    for (const MatrixName& matrix : names.matrices)
        for (const VectorName& vector : names.vectors)
            if (occurs(matrix.entries, used) && occurs(vector.entries, used) && matrix.name != vector.name)
                factors.push_back(times(matrix, vector));
    if (value.size() == 1) {
        append_scalars(factors);
        return;
    }
    append_vectors(plain, factors, names);
    if (degree >= 3) append_triple_products(plain);
}

void VectorTerms::append_scalars(const std::vector<VectorTerm>& factors)
{
    for (std::size_t a = 0; a < factors.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b) terms_.push_back(dot(factors[b], factors[a]));
}

void VectorTerms::append_vectors(const std::vector<VectorTerm>& plain, const std::vector<VectorTerm>& factors,
                                 const VectorNames& names)
{
    terms_ = factors;
    for (std::size_t a = 0; a < factors.size(); ++a)
        for (std::size_t b = a + 1; b < factors.size(); ++b) terms_.push_back(cross(factors[a], factors[b]));
    for (std::size_t k = 0; k < 3 && !names.basis[0].empty(); ++k) {
        VectorTerm basis{name(names.basis[k]), nullptr, Polynomials(3), k + 1};
        basis.vectors.insert(names.basis[k]);
        basis.value[k] = {{{}, 1}};
        terms_.push_back(basis);
        for (const VectorTerm& a : plain) terms_.push_back(cross(a, basis));
    }
}

/// a x (b x c) and (a . b) c of vectors without matrices.
void VectorTerms::append_triple_products(const std::vector<VectorTerm>& plain)
{
    for (const VectorTerm& a : plain)
        for (std::size_t b = 0; b < plain.size(); ++b)
            for (std::size_t c = b + 1; c < plain.size(); ++c) terms_.push_back(cross(a, cross(plain[b], plain[c])));
    for (std::size_t a = 0; a < plain.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b)
            for (const VectorTerm& c : plain) terms_.push_back(scaled(dot(plain[a], plain[b]), c));
}

VectorTerms VectorTerms::of_rate(const VectorNames& names, const VectorName& vector)
{
    VectorTerms terms;
    terms.terms_.push_back(vector_of(vector));
    for (const MatrixName& matrix : names.matrices) terms.terms_.push_back(times(matrix, vector));
    return terms;
}

std::optional<std::map<std::size_t, Rational>> VectorTerms::sum_of(const Polynomials& value) const
{
    std::map<std::size_t, Rational> sum;
    std::size_t budget = most_attempts;
    if (!peel(value, sum, budget)) return std::nullopt;
    return sum;
}

/// Subtracts a term that has the monomial which the fewest terms have, and goes on with what is left.
bool VectorTerms::peel(const Polynomials& rest, std::map<std::size_t, Rational>& sum, std::size_t& budget) const
{
    if (std::ranges::all_of(rest, [](const Polynomial& entry) { return entry.empty(); })) return true;
    std::vector<std::size_t> fitting;
    for (std::size_t k = 0; k < terms_.size(); ++k)
        if (!sum.contains(k) && fits(terms_[k], rest)) fitting.push_back(k);
    std::vector<std::size_t> fewest;
    std::size_t component = 0;
    Monomial monomial;
    for (std::size_t i = 0; i < rest.size(); ++i)
        for (const auto& [each, coefficient] : rest[i]) {
            std::vector<std::size_t> having;
            for (const std::size_t k : fitting)
                if (terms_[k].value[i].contains(each)) having.push_back(k);
            if (having.empty()) return false;
            if (!fewest.empty() && having.size() >= fewest.size()) continue;
            fewest = having;
            component = i;
            monomial = each;
        }
    for (const std::size_t k : fewest) {
        if (budget == 0) return false;
        --budget;
        const Rational factor = rest[component].at(monomial) / terms_[k].value[component].at(monomial);
        Polynomials left = rest;
        for (std::size_t i = 0; i < left.size(); ++i) add_to(left[i], terms_[k].value[i], -factor);
        sum[k] = factor;
        if (peel(left, sum, budget)) return true;
        sum.erase(k);
    }
    return false;
}

} // namespace lagen
