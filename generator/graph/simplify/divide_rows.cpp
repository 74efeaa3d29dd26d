// SPDX-License-Identifier: GPL-2.0-or-later
/// Rows of linear systems without the factors that all their terms share: l1 (M l1 u + m l2 c v) = l1 f is solved as
/// M l1 u + m l2 c v = f. The solution is the same; where such a factor is zero the matrix is singular, which whoever
/// checks for singular matrices must then ask of the factor.
#include "graph/simplify/form.hpp"

#include <algorithm>
#include <map>

namespace lagen {
namespace {

/// A factorisation with the solves that use it.
using Systems = std::map<AtomId, std::vector<AtomId>>;

Systems systems_of(const Form& form)
{
    Systems systems;
    for (const AtomId atom : live_atoms(form))
        if (form.algebra[atom].op == Op::solve)
            systems[form.algebra[atom].operands[0].at(0).monomial.at(0).atom].push_back(atom);
    return systems;
}

/// The order of the matrix of `factor`.
std::size_t order_of(const Form& form, AtomId factor)
{
    std::size_t n = 0;
    while (n * n < form.algebra[factor].operands.size()) ++n;
    return n;
}

/// The monomial that divides every term of row i, the right sides of all solves included.
Monomial row_content(const Form& form, AtomId factor, const std::vector<AtomId>& solves, std::size_t i, std::size_t n)
{
    Polynomial all;
    const auto append = [&](const Polynomial& part) { all.insert(all.end(), part.begin(), part.end()); };
    for (std::size_t j = 0; j < n; ++j) append(form.algebra[factor].operands[i * n + j]);
    for (const AtomId solve : solves) append(form.algebra[solve].operands[i + 1]);
    return all.empty() ? Monomial{} : form.algebra.extract_content(all).monomial;
}

void divide(Form& form, Polynomial& entry, const Monomial& content)
{
    Term inverse{1, content};
    for (Factor& factor : inverse.monomial) factor.exponent = -factor.exponent;
    entry = form.algebra.distribute(entry, {inverse});
}

/// Symmetric matrices of order 3 and more stay: L D L^T is worth more than the factors.
bool may_lose_symmetry(const Form& form, AtomId factor, std::size_t n)
{
    return n == 2 || form.algebra[factor].payload == static_cast<std::uint32_t>(MatrixStructure::general);
}

void divide_system(Form& form, AtomId factor, const std::vector<AtomId>& solves, std::vector<AtomId>& divisors)
{
    const std::size_t n = order_of(form, factor);
    if (!may_lose_symmetry(form, factor, n)) return;
    std::vector<Polynomial> matrix = form.algebra[factor].operands;
    bool changed = false;
    for (std::size_t i = 0; i < n; ++i) {
        const Monomial content = row_content(form, factor, solves, i, n);
        if (content.empty()) continue;
        changed = true;
        for (const Factor& divisor : content)
            if (divisor.exponent > 0) divisors.push_back(divisor.atom);
        for (std::size_t j = 0; j < n; ++j) divide(form, matrix[i * n + j], content);
        for (const AtomId solve : solves) divide(form, form.algebra.operands(solve)[i + 1], content);
    }
    if (!changed) return;
    const auto general = static_cast<std::uint32_t>(MatrixStructure::general);
    const AtomId next = form.algebra.atom(Op::factor, general, std::move(matrix));
    for (const AtomId solve : solves) form.algebra.operands(solve)[0] = {{1, {{next, 1}}}};
}

} // namespace

std::size_t divide_rows(Form& form)
{
    std::vector<AtomId> divisors;
    for (const auto& [factor, solves] : systems_of(form)) divide_system(form, factor, solves, divisors);
    std::ranges::sort(divisors);
    divisors.erase(std::unique(divisors.begin(), divisors.end()), divisors.end());
    for (const AtomId divisor : divisors) form.roots.push_back({{1, {{divisor, 1}}}});
    return divisors.size();
}

} // namespace lagen
