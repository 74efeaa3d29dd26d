// SPDX-License-Identifier: GPL-2.0-or-later
#include "geometry/group_relations.hpp"

#include "expression/linear_algebra.hpp"
#include "geometry/orthonormal_span.hpp"

#include <algorithm>

namespace lagen {

namespace {

constexpr long double negligible = 1e-12L;   ///< of numbers that are 0 but for rounding, relative to the others
constexpr std::size_t largest_with_all = 12; ///< n of matrices whose forms and envelope are looked for

RealMatrix transposed(const RealMatrix& a, std::size_t n)
{
    RealMatrix out(n * n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) out[j * n + i] = a[i * n + j];
    return out;
}

long double largest(const std::vector<long double>& a)
{
    long double size = 0;
    for (const long double each : a) size = std::max(size, std::abs(each));
    return size;
}

/// The associative algebra of the generators, without 1.
OrthonormalSpan envelope(const std::vector<RealMatrix>& generators, std::size_t n)
{
    OrthonormalSpan span(negligible);
    for (const RealMatrix& each : generators) (void)span.add(each);
    for (std::size_t k = 0; k < span.size(); ++k)
        for (const RealMatrix& each : generators)
            if (span.size() < n * n) (void)span.add(times(span[k], each, n));
    return span;
}

/// Vectors v with M v = 0, M of m x m numbers by rows; by elimination with complete pivoting.
std::vector<std::vector<long double>> kernel(std::vector<long double> M, std::size_t m)
{
    const long double least = negligible * largest(M);
    std::vector<std::size_t> columns(m);
    for (std::size_t j = 0; j < m; ++j) columns[j] = j;
    std::size_t rank = 0;
    for (; rank < m; ++rank) {
        std::size_t row = rank, column = rank;
        for (std::size_t i = rank; i < m; ++i)
            for (std::size_t j = rank; j < m; ++j)
                if (std::abs(M[i * m + columns[j]]) > std::abs(M[row * m + columns[column]])) row = i, column = j;
        if (std::abs(M[row * m + columns[column]]) <= least) break;
        std::swap(columns[rank], columns[column]);
        for (std::size_t j = 0; j < m; ++j) std::swap(M[rank * m + j], M[row * m + j]);
        const long double pivot = M[rank * m + columns[rank]];
        for (std::size_t j = 0; j < m; ++j) M[rank * m + j] /= pivot;
        for (std::size_t i = 0; i < m; ++i) {
            const long double factor = M[i * m + columns[rank]];
            for (std::size_t j = 0; i != rank && factor != 0 && j < m; ++j) M[i * m + j] -= factor * M[rank * m + j];
        }
    }
    std::vector<std::vector<long double>> vectors;
    for (std::size_t k = rank; k < m; ++k) {
        std::vector<long double>& v = vectors.emplace_back(m, 0.0L);
        v[columns[k]] = 1;
        for (std::size_t i = 0; i < rank; ++i) v[columns[i]] = -M[i * m + columns[k]];
    }
    return vectors;
}

/// 1, where all generators are skew.
std::vector<RealMatrix> euclidean_form(const std::vector<RealMatrix>& generators, std::size_t n)
{
    const auto is_skew = [n](const RealMatrix& E) {
        RealMatrix sum = transposed(E, n);
        for (std::size_t k = 0; k < n * n; ++k) sum[k] += E[k];
        return largest(sum) <= negligible * largest(E);
    };
    if (!std::ranges::all_of(generators, is_skew)) return {};
    RealMatrix one(n * n, 0);
    for (std::size_t k = 0; k < n; ++k) one[k * (n + 1)] = 1;
    return {one};
}

/// All J with E_a^T J + J E_a = 0, by the sum over a of L^T L, where L(J) is the left side; of large matrices 1 alone.
std::vector<RealMatrix> invariant_forms(const std::vector<RealMatrix>& generators, std::size_t n)
{
    if (n > largest_with_all) return euclidean_form(generators, n);
    const std::size_t m = n * n;
    std::vector<long double> normal(m * m, 0);
    for (const RealMatrix& E : generators)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                std::vector<std::pair<std::size_t, long double>> row; // L(J)_ij = sum_k E_ki J_kj + J_ik E_kj
                for (std::size_t k = 0; k < n; ++k) {
                    if (E[k * n + i] != 0) row.emplace_back(k * n + j, E[k * n + i]);
                    if (E[k * n + j] != 0) row.emplace_back(i * n + k, E[k * n + j]);
                }
                for (const auto& [p, left] : row)
                    for (const auto& [q, right] : row) normal[p * m + q] += left * right;
            }
    return kernel(std::move(normal), m);
}

bool is_multiple_of_one(const RealMatrix& J, std::size_t n)
{
    for (std::size_t k = 0; k < n * n; ++k)
        if (std::abs(J[k] - (k % (n + 1) == 0 ? J[0] : 0)) > negligible) return false;
    return true;
}

/// Keeps the larger of two defects.
void note(GroupDefect& worst, long double size, const char* relation)
{
    if (size > worst.size || !(size == size)) worst = {relation, size};
}

/// W^T J W = J for all invariant J; `columns`: of W itself, else of its transpose.
void note_forms(GroupDefect& worst, const std::vector<RealMatrix>& generators, const RealMatrix& W, std::size_t n,
                bool columns)
{
    const RealMatrix transpose = transposed(W, n);
    const long double scale = std::max(1.0L, largest(W) * largest(W));
    for (const RealMatrix& J : invariant_forms(generators, n)) {
        RealMatrix moved = times(times(transpose, J, n), W, n);
        for (std::size_t k = 0; k < n * n; ++k) moved[k] -= J[k];
        const bool one = is_multiple_of_one(J, n);
        note(worst, largest(moved) / (scale * largest(J)),
             columns ? one ? "transpose(W)*W = 1" : "transpose(W)*J*W = J for a form J that the group keeps"
             : one   ? "W*transpose(W) = 1"
                     : "W*K*transpose(W) = K for a form K that the group keeps");
    }
}

long double determinant_of(const RealMatrix& W, std::size_t n)
{
    const Factorisation<long double> f = factorise(W, n);
    if (!f.regular) return 0;
    long double value = 1;
    std::vector<std::size_t> order = f.order;
    for (std::size_t k = 0; k < n; ++k) {
        value *= f.lu[k * n + k];
        while (order[k] != k) {
            std::swap(order[k], order[order[k]]);
            value = -value;
        }
    }
    return value;
}

} // namespace

GroupDefect group_defect(const std::vector<RealMatrix>& generators, const RealMatrix& W, std::size_t n)
{
    GroupDefect worst;
    std::vector<RealMatrix> turned;
    for (const RealMatrix& E : generators) turned.push_back(transposed(E, n));
    note_forms(worst, generators, W, n, true);
    note_forms(worst, turned, transposed(W, n), n, false);
    RealMatrix difference = W;
    for (std::size_t k = 0; k < n; ++k) difference[k * n + k] -= 1;
    if (n <= largest_with_all)
        note(worst, largest(envelope(generators, n).outside(difference)) / std::max(1.0L, largest(W)),
             "W - 1 is a sum of products of the generators");
    const auto has_no_trace = [n](const RealMatrix& E) {
        long double trace = 0;
        for (std::size_t k = 0; k < n; ++k) trace += E[k * (n + 1)];
        return std::abs(trace) <= negligible * largest(E);
    };
    const bool traceless = std::ranges::all_of(generators, has_no_trace);
    const long double det = determinant_of(W, n);
    if (traceless) note(worst, std::abs(det - 1) / std::max(1.0L, std::abs(det)), "det(W) = 1");
    if (!traceless && std::abs(det) <= negligible) note(worst, 1, "det(W) != 0");
    return worst;
}

GroupDefect logarithm_defect(const std::vector<RealMatrix>& generators, const RealMatrix& W, std::size_t n)
{
    const std::optional<RealMatrix> log = principal_logarithm(W, n);
    if (!log) return {};
    OrthonormalSpan span(negligible);
    for (const RealMatrix& each : generators) (void)span.add(each);
    const long double size = std::max(largest(*log), negligible);
    return {"log W in the span of the generators", largest(span.outside(*log)) / size};
}

} // namespace lagen
