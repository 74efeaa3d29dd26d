// SPDX-License-Identifier: GPL-2.0-or-later
/// z = A^-1 b in the ring beyond the orders of Cramer's rule: unknowns are eliminated by pivots that are numbers, the
/// block that is left is solved by its minors. Where that block is large, or the minors swell, the unknowns are free
/// generators, and what is a combination of the rows of A z - b vanishes.
#include "expression/linear_algebra.hpp"
#include "proof/normal_form.hpp"

#include <algorithm>

namespace lagen::proof {
namespace {

constexpr std::size_t largest_block = 8;       ///< unknowns left to minors: 2^9 of them
constexpr std::size_t most_minor_terms = 2000; ///< of one minor
constexpr int most_row_steps = 2000;           ///< rows subtracted from one numerator

/// Rows of [A | b] with n + 1 entries each, and what elimination did to them.
struct Elimination {
    std::vector<std::vector<Fraction>> rows;
    std::vector<std::pair<std::size_t, std::size_t>> pivots; ///< (row, unknown) in order of elimination
    std::vector<std::size_t> rows_left, unknowns_left;

    [[nodiscard]] std::size_t entries(std::size_t row) const
    {
        const auto filled = [&](std::size_t j) { return !rows[row][j].is_zero(); };
        return static_cast<std::size_t>(std::count_if(unknowns_left.begin(), unknowns_left.end(), filled));
    }
};

/// The row with the fewest entries that has a number among them, and that unknown; false where there is none.
bool find_pivot(const Elimination& system, std::size_t& row, std::size_t& unknown)
{
    std::size_t fewest = SIZE_MAX;
    for (const std::size_t i : system.rows_left)
        for (const std::size_t j : system.unknowns_left) {
            const Fraction& entry = system.rows[i][j];
            if (entry.is_zero() || !entry.constant() || system.entries(i) >= fewest) continue;
            fewest = system.entries(i);
            row = i;
            unknown = j;
        }
    return fewest != SIZE_MAX;
}

void eliminate_by_numbers(Ring& ring, Elimination& system)
{
    std::size_t row = 0, unknown = 0;
    while (find_pivot(system, row, unknown)) {
        std::erase(system.rows_left, row);
        std::erase(system.unknowns_left, unknown);
        system.pivots.emplace_back(row, unknown);
        const std::vector<Fraction>& pivot = system.rows[row];
        const Fraction reciprocal = ring.inverse(pivot[unknown]);
        for (const std::size_t i : system.rows_left) {
            if (system.rows[i][unknown].is_zero()) continue;
            const Fraction factor = ring.times(system.rows[i][unknown], reciprocal);
            for (std::size_t j = 0; j < pivot.size(); ++j)
                system.rows[i][j] = ring.add(system.rows[i][j], ring.times(factor, pivot[j]), -1);
        }
    }
}

/// The m x m minors of an m x (m + 1) matrix: minors[j] leaves column j out. Rows are added one by one to the minors of
/// the first rows, a set of columns each (Laplace).
std::vector<Fraction> maximal_minors(Ring& ring, const std::vector<std::vector<Fraction>>& matrix)
{
    const std::size_t m = matrix.size();
    std::vector<Fraction> minors(std::size_t{1} << (m + 1));
    minors[0] = ring.constant(1);
    for (std::size_t set = 1; set + 1 < minors.size(); ++set) {
        const auto row = static_cast<std::size_t>(__builtin_popcountll(set)) - 1;
        int sign = row % 2 == 0 ? 1 : -1; // of the first column of the set, in its last row
        for (std::size_t j = 0; j <= m; ++j) {
            if ((set >> j & 1U) == 0) continue;
            const Fraction& rest = minors[set ^ (std::size_t{1} << j)];
            if (!matrix[row][j].is_zero() && !rest.is_zero())
                minors[set] = ring.add(minors[set], ring.times(matrix[row][j], rest), sign);
            sign = -sign;
        }
    }
    std::vector<Fraction> result;
    for (std::size_t j = 0; j <= m; ++j) result.push_back(minors[(minors.size() - 1) ^ (std::size_t{1} << j)]);
    return result;
}

/// All unknowns of A z = b; throws BudgetExhausted where the block that is left is too large.
std::vector<Fraction> solve_rows(Ring& ring, std::vector<std::vector<Fraction>> rows)
{
    const std::size_t n = rows.size();
    Elimination system{std::move(rows), {}, {}, {}};
    for (std::size_t k = 0; k < n; ++k) system.rows_left.push_back(k);
    system.unknowns_left = system.rows_left;
    eliminate_by_numbers(ring, system);
    const std::size_t m = system.rows_left.size();
    if (m > largest_block) throw BudgetExhausted("a linear system of more than 8 coupled unknowns");
    std::vector<std::vector<Fraction>> block;
    for (const std::size_t i : system.rows_left) {
        block.emplace_back();
        for (const std::size_t j : system.unknowns_left) block.back().push_back(system.rows[i][j]);
        block.back().push_back(system.rows[i][n]);
    }
    std::vector<Fraction> z(n);
    if (m > 0) {
        const std::vector<Fraction> minors = maximal_minors(ring, block);
        for (std::size_t j = 0; j < m; ++j) {
            const Fraction value = ring.divide(minors[j], minors[m]);
            z[system.unknowns_left[j]] = (m - 1 - j) % 2 == 0 ? value : ring.negate(value);
        }
    }
    for (std::size_t k = system.pivots.size(); k-- > 0;) {
        const auto [row, unknown] = system.pivots[k];
        Fraction rest = system.rows[row][n];
        for (std::size_t j = 0; j < n; ++j)
            if (j != unknown && !z[j].is_zero()) rest = ring.add(rest, ring.times(system.rows[row][j], z[j]), -1);
        z[unknown] = ring.divide(rest, system.rows[row][unknown]);
    }
    return z;
}

} // namespace

const std::vector<Fraction>& NormalForm::solution(NodeId solve)
{
    const auto operands = graph_.operands(solve);
    const auto entries = graph_.operands(operands[0]);
    const std::size_t n = operands.size() - 1;
    std::vector<std::vector<Fraction>> rows(n);
    std::string key = "solve";
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) rows[i].push_back(done_.at(entries[i * n + j]));
        rows[i].push_back(done_.at(operands[i + 1]));
        for (const Fraction& entry : rows[i]) key += ':' + key_of(entry);
        if (key.size() > 1'000'000) throw BudgetExhausted("a linear system is longer than 1000000 characters");
    }
    if (const auto known = solutions_.find(key); known != solutions_.end()) return known->second;
    // A quarter of what is left: the rest must do where the unknowns stay free.
    Work& work = ring_.work();
    const Work before = work;
    const std::size_t share = before.products / 4;
    work = {std::min(before.terms, most_minor_terms), share};
    std::vector<Fraction> z;
    try {
        z = solve_rows(ring_, rows);
        work = {before.terms, before.products - share + work.products};
    } catch (const BudgetExhausted&) {
        work = {before.terms, before.products - share};
        z = free_unknowns(key, rows);
    }
    return solutions_.emplace(key, std::move(z)).first->second;
}

std::vector<Fraction> NormalForm::free_unknowns(const std::string& key, const std::vector<std::vector<Fraction>>& rows)
{
    const std::size_t n = rows.size();
    std::vector<Fraction> z;
    for (std::size_t j = 0; j < n; ++j)
        z.push_back(ring_.of(ring_.keyed(key + '#' + std::to_string(j), [&] {
            return ring_.add_generator({"(unknown " + std::to_string(j + 1) + "...)", {}, 0, {}, -1, false});
        })));
    for (const std::vector<Fraction>& row : rows) {
        Fraction sum = ring_.negate(row[n]);
        for (std::size_t j = 0; j < n; ++j) sum = ring_.add(sum, ring_.times(row[j], z[j]));
        if (!sum.is_zero()) relations_.push_back(sum.num);
    }
    return z;
}

/// Is p a combination of relations? Its leading term is cancelled again and again, where one of theirs divides it.
bool NormalForm::vanishes_by_rows(Polynomial p)
{
    for (int step = 0; step < most_row_steps && !p.empty(); ++step) {
        Monomial quotient;
        const auto divides = [&](const Polynomial& row) {
            return Monomial::divide(p[0].monomial, row[0].monomial, quotient);
        };
        const auto found = std::find_if(relations_.begin(), relations_.end(), divides);
        if (found == relations_.end()) return false;
        const Polynomial& row = *found;
        mpz_class common;
        mpz_gcd(common.get_mpz_t(), p[0].coefficient.get_mpz_t(), row[0].coefficient.get_mpz_t());
        const mpz_class up = row[0].coefficient / common, down = -p[0].coefficient / common;
        p = ring_.reduce(add_scaled(scale(p, up), multiply_term(row, quotient, down, ring_.work()), 1, ring_.work()));
    }
    return p.empty();
}

// Components of z = A^-1 b in the ring: Cramer's rule where A is small.

namespace {

constexpr std::size_t largest_determinant = 4; ///< rows; beyond, see linear_systems.cpp

/// A matrix of fractions.
struct FractionRing {
    using Number = Fraction;
    Ring& ring;
    const std::vector<Fraction>& matrix;
    std::size_t n;

    [[nodiscard]] Fraction zero() const { return {}; }
    [[nodiscard]] Fraction one() const { return ring.constant(1); }
    [[nodiscard]] const Fraction& entry(std::size_t i, std::size_t j) const { return matrix[i * n + j]; }
    [[nodiscard]] bool is_zero(const Fraction& a) const { return a.is_zero(); }
    [[nodiscard]] Fraction times(const Fraction& a, const Fraction& b) const { return ring.times(a, b); }
    void add(Fraction& sum, const Fraction& term, int sign) const { sum = ring.add(sum, term, sign); }
};

} // namespace

Fraction NormalForm::component(NodeId node)
{
    const NodeId solve = graph_.operands(node)[0];
    const auto operands = graph_.operands(solve);
    const std::size_t n = operands.size() - 1, row = graph_.payload(node);
    if (n > largest_determinant) return solution(solve)[row];
    std::vector<Fraction> matrix, right;
    for (const NodeId entry : graph_.operands(operands[0])) matrix.push_back(done_.at(entry));
    for (std::size_t k = 0; k < n; ++k) right.push_back(done_.at(operands[k + 1]));
    const Fraction whole = determinant(FractionRing{ring_, matrix, n}, n);
    return ring_.divide(numerator(FractionRing{ring_, matrix, n}, row, right), whole);
}

} // namespace lagen::proof
