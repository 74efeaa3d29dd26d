// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/morphism/covector.hpp"

#include "text/diagnostic.hpp"

#include <cmath>
#include <utility>

namespace lagen {

namespace {

constexpr long double rank_tolerance = 1e-14L, image_tolerance = 1e-10L;
constexpr const char* hint = "start the scene from fibre coordinates, with --form lagrange";

/// Equations for mu', one a component of mu, with the right-hand side behind.
using Rows = std::vector<std::vector<long double>>;

/// Moves the largest entry of the rest to the place (k, k); false where the rest is zero.
bool pivot(Rows& rows, std::size_t k, std::size_t unknowns, long double least, std::vector<std::size_t>& order)
{
    std::size_t row = k, column = k;
    for (std::size_t b = k; b < rows.size(); ++b)
        for (std::size_t a = k; a < unknowns; ++a)
            if (std::fabs(rows[b][a]) > std::fabs(rows[row][column])) row = b, column = a;
    if (!(std::fabs(rows[row][column]) > least)) return false;
    std::swap(rows[k], rows[row]);
    for (std::vector<long double>& each : rows) std::swap(each[k], each[column]);
    std::swap(order[k], order[column]);
    return true;
}

long double largest(const std::vector<long double>& values)
{
    long double found = 0;
    for (const long double value : values) found = std::fmax(found, std::fabs(value));
    return found;
}

} // namespace

std::vector<long double> pushed_covector(const std::vector<long double>& matrix, const std::vector<long double>& mu)
{
    const std::size_t r = mu.size(), unknowns = r == 0 ? 0 : matrix.size() / r;
    Rows rows(r, std::vector<long double>(unknowns + 1));
    std::vector<std::size_t> order(unknowns);
    for (std::size_t a = 0; a < unknowns; ++a) order[a] = a;
    for (std::size_t b = 0; b < r; ++b) {
        for (std::size_t a = 0; a < unknowns; ++a) rows[b][a] = matrix[a * r + b];
        rows[b][unknowns] = mu[b];
    }
    const long double least = rank_tolerance * largest(matrix);
    for (std::size_t k = 0; k < unknowns; ++k) {
        if (k >= r || !pivot(rows, k, unknowns, least, order))
            throw MathematicsError("the momenta of the start are those of more than one start of the target: Phi is "
                                   "not surjective on the fibre there",
                                   hint);
        for (std::size_t b = 0; b < r; ++b) {
            if (b == k) continue;
            const long double factor = rows[b][k] / rows[k][k];
            for (std::size_t a = k; a <= unknowns; ++a) rows[b][a] -= factor * rows[k][a];
        }
    }
    for (std::size_t b = unknowns; b < r; ++b)
        if (!(std::fabs(rows[b][unknowns]) <= image_tolerance * largest(mu)))
            throw MathematicsError("the momenta of the start are not of the form Phi^* mu': no start of the target "
                                   "has them",
                                   hint);
    std::vector<long double> solution(unknowns);
    for (std::size_t k = 0; k < unknowns; ++k) solution[order[k]] = rows[k][unknowns] / rows[k][k];
    return solution;
}

} // namespace lagen
