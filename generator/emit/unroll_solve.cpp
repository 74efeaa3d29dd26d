// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/unroll_solve.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t largest_written_out = 16;

using Terms = std::vector<std::vector<Term>>;
using Products = std::vector<std::pair<Expression, Expression>>;

std::size_t order_of(const Graph& graph, NodeId factor)
{
    std::size_t n = 0;
    while (n * n < graph.operands(factor).size()) ++n;
    return n;
}

Term entry_of(const SolveContext& context, NodeId id)
{
    return context.graph.is_zero(id) ? Term() : context.expressions(id);
}

Expression or_zero(const Term& term)
{
    return term ? *term : literal(0);
}

Term product(const Term& a, const Term& b)
{
    return a && b ? Term(operation(Op::multiply, *a, *b)) : Term();
}

Term difference(const Term& a, const Term& b)
{
    if (!b) return a;
    return a ? operation(Op::subtract, *a, *b) : operation(Op::negate, *b);
}

/// first - a1 * b1 - a2 * b2 ...
Term minus_products(Term first, const Products& products)
{
    for (const auto& [a, b] : products) first = difference(first, product(a, b));
    return first;
}

Expression define(const SolveContext& context, const std::string& wish, Expression value)
{
    std::string name = context.fresh(wish);
    context.add({.kind = Statement::Kind::define, .names = {name}, .expressions = {std::move(value)}});
    return variable(std::move(name));
}

/// The divisor is no more than the rounding error of elimination in a matrix of order n, relative to `size`.
void check_divisor(const SolveContext& context, std::size_t n, Expression divisor, Expression size)
{
    context.add({.kind = Statement::Kind::check, .expressions = {std::move(divisor), std::move(size)}, .index = n});
}

bool is_definite(const SolveContext& context, NodeId id)
{
    return context.graph.payload(id) == static_cast<std::uint32_t>(MatrixStructure::positive_definite);
}

/// 1 / (a00 a11 - a01 a10). Singular where the determinant is a rounding error of its two products, which no scaling
/// of rows or columns changes. Products that overflow (entries of 1e155 in double) or vanish (1e-162) are reported as
/// singular too, as inf <= inf and 0 <= 0; below 1e-292 a product loses digits without a report.
UnrolledFactor unroll_closed_form(const SolveContext& context, NodeId id, std::size_t number, bool check, bool solved)
{
    UnrolledFactor factor;
    factor.kind = UnrolledFactor::Kind::closed_form;
    factor.order = 2;
    for (const NodeId entry : context.graph.operands(id)) factor.entries.push_back(entry_of(context, entry));
    const Term diagonal = product(factor.entries[0], factor.entries[3]);
    const Term other = product(factor.entries[1], factor.entries[2]);
    const Expression determinant = define(context, fmt::format("det{}", number), or_zero(difference(diagonal, other)));
    if (check && is_definite(context, id)) { // the diagonal product is positive and the larger one
        check_divisor(context, 2, determinant, or_zero(diagonal));
    } else if (check) {
        const auto size_of = [](const Expression& x) { return operation(Op::abs, x); };
        check_divisor(context, 2, size_of(determinant),
                      diagonal && other ? operation(Op::add, size_of(*diagonal), size_of(*other))
                                        : size_of(determinant));
    }
    if (solved)
        factor.whole =
            define(context, fmt::format("inv_det{}", number), operation(Op::divide, literal(1), determinant));
    return factor;
}

/// A = L D L^T, column by column: v_ij = a_ij - sum_k l_ik v_jk, d_j = v_jj, l_ij = v_ij / d_j. A pivot that is a
/// rounding error of its diagonal entry means that the matrix is singular.
UnrolledFactor unroll_ldlt(const SolveContext& context, NodeId id, std::size_t n, std::size_t number, bool check,
                           bool solved)
{
    const std::vector<NodeId> entries(context.graph.operands(id).begin(), context.graph.operands(id).end());
    std::vector<std::vector<bool>> pattern(n, std::vector<bool>(n));
    for (std::size_t k = 0; k < n * n; ++k) pattern[k / n][k % n] = !context.graph.is_zero(entries[k]);
    UnrolledFactor factor;
    factor.kind = UnrolledFactor::Kind::ldlt;
    factor.order = n;
    factor.elimination = least_degree_order(pattern);
    factor.l.assign(n, std::vector<Term>(n));
    factor.reciprocals.resize(n);
    Terms v = factor.l;
    const auto entry = [&](std::size_t i, std::size_t j) { // lower triangle of the permuted matrix
        return entry_of(context, entries[factor.elimination[i] * n + factor.elimination[j]]);
    };
    const auto named = [&](const char* prefix, std::size_t i, std::size_t j) {
        return fmt::format("{}{}_{}_{}", prefix, number, i, j);
    };
    for (std::size_t j = 0; j < n; ++j) {
        bool below = false;
        for (std::size_t i = j; i < n; ++i) {
            Products products;
            for (std::size_t k = 0; k < j; ++k)
                if (factor.l[i][k] && factor.l[j][k]) products.emplace_back(*factor.l[i][k], *v[j][k]);
            v[i][j] = entry(i, j);
            if (!products.empty()) v[i][j] = define(context, named("v", i, j), *minus_products(v[i][j], products));
            below = below || (i > j && v[i][j]);
        }
        if (!v[j][j]) v[j][j] = literal(0);
        if (check) check_divisor(context, n, *v[j][j], or_zero(entry(j, j)));
        if (!solved && !below) continue;
        factor.reciprocals[j] =
            define(context, fmt::format("r{}_{}", number, j), operation(Op::divide, literal(1), *v[j][j]));
        for (std::size_t i = j + 1; i < n; ++i)
            if (v[i][j])
                factor.l[i][j] =
                    define(context, named("l", i, j), operation(Op::multiply, *v[i][j], factor.reciprocals[j]));
    }
    return factor;
}

std::vector<Expression> all_of(const SolveContext& context, std::span<const NodeId> nodes)
{
    std::vector<Expression> expressions;
    for (const NodeId id : nodes) expressions.push_back(context.expressions(id));
    return expressions;
}

UnrolledFactor unroll_pivoted(const SolveContext& context, NodeId id, std::size_t n, std::size_t number, bool check)
{
    UnrolledFactor factor;
    factor.order = n;
    const std::string name = context.fresh(fmt::format("lu{}", number));
    factor.whole = variable(name);
    context.add({.kind = Statement::Kind::factor,
                 .names = {name},
                 .expressions = all_of(context, context.graph.operands(id)),
                 .index = n,
                 .checked = check});
    return factor;
}

std::vector<Expression> solve_pivoted(const SolveContext& context, const UnrolledFactor& factor,
                                      std::span<const NodeId> right, std::size_t number)
{
    const std::string name = context.fresh(fmt::format("z{}", number));
    context.add(
        {.kind = Statement::Kind::solve, .names = {name, factor.whole.name}, .expressions = all_of(context, right)});
    std::vector<Expression> result;
    for (std::size_t k = 0; k < factor.order; ++k) result.push_back(variable(name, k));
    return result;
}

std::vector<Expression> solve_closed_form(const SolveContext& context, const UnrolledFactor& factor,
                                          const std::vector<Term>& b, std::size_t number,
                                          const std::vector<bool>& wanted)
{
    std::vector<Expression> z(2, literal(0));
    const std::vector<Term>& a = factor.entries;
    for (std::size_t k = 0; k < 2; ++k) {
        if (!wanted[k]) continue;
        const Term value = k == 0 ? difference(product(a[3], b[0]), product(a[1], b[1]))
                                  : difference(product(a[0], b[1]), product(a[2], b[0]));
        if (value)
            z[k] = define(context, fmt::format("z{}_{}", number, k), operation(Op::multiply, *value, factor.whole));
    }
    return z;
}

/// L f = b, z = L^-T (f / d).
std::vector<Expression> solve_ldlt(const SolveContext& context, const UnrolledFactor& factor,
                                   const std::vector<Term>& b, std::size_t number, const std::vector<bool>& wanted)
{
    const std::size_t n = factor.order;
    std::vector<Term> f(n);
    for (std::size_t i = 0; i < n; ++i) {
        Products products;
        for (std::size_t k = 0; k < i; ++k)
            if (factor.l[i][k] && f[k]) products.emplace_back(*factor.l[i][k], *f[k]);
        f[i] = b[factor.elimination[i]];
        if (!products.empty())
            f[i] = define(context, fmt::format("f{}_{}", number, i), *minus_products(f[i], products));
    }
    std::vector<bool> needed(n);
    for (std::size_t i = 0; i < n; ++i) {
        needed[i] = wanted[factor.elimination[i]];
        for (std::size_t k = 0; k < i; ++k) needed[i] = needed[i] || (needed[k] && factor.l[i][k]);
    }
    std::vector<Term> z(n);
    std::vector<Expression> result(n, literal(0));
    for (std::size_t i = n; i-- > 0;) {
        if (!needed[i]) continue;
        Products products;
        for (std::size_t k = i + 1; k < n; ++k)
            if (factor.l[k][i] && z[k]) products.emplace_back(*factor.l[k][i], *z[k]);
        const Term value = minus_products(product(f[i], factor.reciprocals[i]), products);
        if (!value) continue;
        z[i] = define(context, fmt::format("z{}_{}", number, factor.elimination[i]), *value);
        result[factor.elimination[i]] = *z[i];
    }
    return result;
}

} // namespace

std::vector<std::size_t> least_degree_order(std::vector<std::vector<bool>> pattern)
{
    const std::size_t n = pattern.size();
    std::vector<std::size_t> order;
    std::vector<bool> gone(n, false);
    while (order.size() < n) {
        std::size_t best = n;
        std::size_t best_degree = n + 1;
        for (std::size_t i = 0; i < n; ++i) {
            if (gone[i]) continue;
            std::size_t degree = 0;
            for (std::size_t j = 0; j < n; ++j) degree += !gone[j] && j != i && pattern[i][j] ? 1U : 0U;
            if (degree < best_degree) {
                best = i;
                best_degree = degree;
            }
        }
        gone[best] = true;
        order.push_back(best);
        for (std::size_t i = 0; i < n; ++i) // the neighbours become neighbours of each other
            for (std::size_t j = 0; j < n; ++j)
                if (!gone[i] && !gone[j] && pattern[i][best] && pattern[best][j]) pattern[i][j] = true;
    }
    return order;
}

UnrolledFactor unroll_factor(const SolveContext& context, NodeId id, std::size_t number, bool check, bool solved)
{
    const std::size_t n = order_of(context.graph, id);
    if (n == 2) return unroll_closed_form(context, id, number, check, solved);
    if (is_definite(context, id) && n <= largest_written_out) return unroll_ldlt(context, id, n, number, check, solved);
    return unroll_pivoted(context, id, n, number, check);
}

std::vector<Expression> unroll_solution(const SolveContext& context, const UnrolledFactor& factor, NodeId id,
                                        std::size_t number, const std::vector<bool>& wanted)
{
    const std::span<const NodeId> right = context.graph.operands(id).subspan(1);
    if (factor.kind == UnrolledFactor::Kind::pivoted) return solve_pivoted(context, factor, right, number);
    std::vector<Term> b;
    for (const NodeId entry : right) b.push_back(entry_of(context, entry));
    if (factor.kind == UnrolledFactor::Kind::closed_form) return solve_closed_form(context, factor, b, number, wanted);
    return solve_ldlt(context, factor, b, number, wanted);
}

} // namespace lagen
