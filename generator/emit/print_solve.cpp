// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_solve.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t largest_written_out = 16;

using Names = std::vector<std::vector<std::string>>;

std::size_t order_of(const Graph& graph, NodeId factor)
{
    std::size_t n = 0;
    while (n * n < graph.operands(factor).size()) ++n;
    return n;
}

std::string entry_text(const SolveContext& context, NodeId id)
{
    return context.graph.is_zero(id) ? std::string() : context.spell.at_least(5, id);
}

/// first - a1 * b1 - a2 * b2 ...; an empty `first` is 0.
std::string minus_products(const std::string& first, const std::vector<std::pair<std::string, std::string>>& products)
{
    std::string text = first;
    for (const auto& [a, b] : products) text += (text.empty() ? "-" : " - ") + a + " * " + b;
    return text;
}

void report_singular(const SolveContext& context, const std::string& condition)
{
    context.add_statement(fmt::format("StatusOf<S>::fail(status, {}, Status::singular_mass_matrix);", condition));
}

std::string define(const SolveContext& context, const std::string& wish, const std::string& value)
{
    std::string name = context.fresh(wish);
    context.add_statement(fmt::format("const S {} = {};", name, value));
    return name;
}

/// 1 / (a00 a11 - a01 a10). Singular where the determinant is a rounding error of its two products, which no scaling
/// of rows or columns changes. Products that overflow (entries of 1e155 in double) or vanish (1e-162) are reported as
/// singular too, as inf <= inf and 0 <= 0; below 1e-292 a product loses digits without a report.
PrintedFactor print_closed_form(const SolveContext& context, NodeId id, std::size_t number, bool check, bool solved)
{
    PrintedFactor factor;
    factor.kind = PrintedFactor::Kind::closed_form;
    factor.order = 2;
    for (const NodeId entry : context.graph.operands(id)) factor.entries.push_back(entry_text(context, entry));
    const auto product = [&](std::size_t i, std::size_t j) {
        const std::string& a = factor.entries[i];
        const std::string& b = factor.entries[j];
        return a.empty() || b.empty() ? std::string() : a + " * " + b;
    };
    const std::string diagonal = product(0, 3);
    const std::string other = product(1, 2);
    std::string value = diagonal;
    if (!other.empty()) value += (value.empty() ? "-" : " - ") + other;
    const std::string determinant = define(context, fmt::format("det{}", number), value.empty() ? "S(0)" : value);
    const bool definite = context.graph.payload(id) == static_cast<std::uint32_t>(MatrixStructure::positive_definite);
    if (check && definite) { // the diagonal product is positive and the larger one
        report_singular(context, fmt::format("{} <= singular_tolerance<S>(2) * ({})", determinant, diagonal));
    } else if (check) {
        const std::string abs = context.spell.call("abs");
        const std::string size = diagonal.empty() || other.empty()
                                     ? fmt::format("{}({})", abs, determinant)
                                     : fmt::format("({0}({1}) + {0}({2}))", abs, diagonal, other);
        report_singular(context, fmt::format("{}({}) <= singular_tolerance<S>(2) * {}", abs, determinant, size));
    }
    if (solved) factor.name = define(context, fmt::format("inv_det{}", number), "S(1) / " + determinant);
    return factor;
}

/// A = L D L^T, column by column: v_ij = a_ij - sum_k l_ik v_jk, d_j = v_jj, l_ij = v_ij / d_j. A pivot that is a
/// rounding error of its diagonal entry means that the matrix is singular.
PrintedFactor print_ldlt(const SolveContext& context, NodeId id, std::size_t n, std::size_t number, bool check,
                         bool solved)
{
    const std::vector<NodeId> entries(context.graph.operands(id).begin(), context.graph.operands(id).end());
    std::vector<std::vector<bool>> pattern(n, std::vector<bool>(n));
    for (std::size_t k = 0; k < n * n; ++k) pattern[k / n][k % n] = !context.graph.is_zero(entries[k]);
    PrintedFactor factor;
    factor.kind = PrintedFactor::Kind::ldlt;
    factor.order = n;
    factor.elimination = least_degree_order(pattern);
    factor.l.assign(n, std::vector<std::string>(n));
    factor.reciprocals.resize(n);
    Names v = factor.l;
    const auto entry = [&](std::size_t i, std::size_t j) { // lower triangle of the permuted matrix
        return entry_text(context, entries[factor.elimination[i] * n + factor.elimination[j]]);
    };
    const auto named = [&](const char* prefix, std::size_t i, std::size_t j) {
        return fmt::format("{}{}_{}_{}", prefix, number, i, j);
    };
    for (std::size_t j = 0; j < n; ++j) {
        bool below = false;
        for (std::size_t i = j; i < n; ++i) {
            std::vector<std::pair<std::string, std::string>> products;
            for (std::size_t k = 0; k < j; ++k)
                if (!factor.l[i][k].empty() && !factor.l[j][k].empty()) products.emplace_back(factor.l[i][k], v[j][k]);
            const std::string value = entry(i, j);
            v[i][j] = products.empty() ? value : define(context, named("v", i, j), minus_products(value, products));
            below = below || (i > j && !v[i][j].empty());
        }
        if (v[j][j].empty()) v[j][j] = "S(0)";
        const std::string diagonal = entry(j, j).empty() ? "S(0)" : entry(j, j);
        if (check) report_singular(context, fmt::format("{} <= singular_tolerance<S>({}) * {}", v[j][j], n, diagonal));
        if (!solved && !below) continue;
        factor.reciprocals[j] = define(context, fmt::format("r{}_{}", number, j), "S(1) / " + v[j][j]);
        for (std::size_t i = j + 1; i < n; ++i)
            if (!v[i][j].empty())
                factor.l[i][j] = define(context, named("l", i, j), v[i][j] + " * " + factor.reciprocals[j]);
    }
    return factor;
}

PrintedFactor print_pivoted(const SolveContext& context, NodeId id, std::size_t n, std::size_t number, bool check)
{
    PrintedFactor factor;
    factor.order = n;
    factor.name = context.fresh(fmt::format("lu{}", number));
    std::string entries;
    for (const NodeId entry : context.graph.operands(id))
        entries += (entries.empty() ? "" : ", ") + context.spell(entry).text;
    context.add_statement(fmt::format("PivotedLu<S, {}> {};", n, factor.name));
    const std::string call = fmt::format("{}.factor({{{}}})", factor.name, entries);
    if (check)
        report_singular(context, call);
    else
        context.add_statement(fmt::format("static_cast<void>({});", call));
    return factor;
}

std::vector<std::string> solve_closed_form(const SolveContext& context, const PrintedFactor& factor,
                                           const std::vector<std::string>& b, std::size_t number,
                                           const std::vector<bool>& wanted)
{
    std::vector<std::string> z(2);
    const std::vector<std::string>& a = factor.entries;
    const auto product = [](const std::string& x, const std::string& y) {
        return x.empty() || y.empty() ? std::string() : x + " * " + y;
    };
    for (std::size_t k = 0; k < 2; ++k) {
        if (!wanted[k]) continue;
        std::string value = k == 0 ? product(a[3], b[0]) : product(a[0], b[1]);
        const std::string minus = k == 0 ? product(a[1], b[1]) : product(a[2], b[0]);
        if (!minus.empty()) value += (value.empty() ? "-" : " - ") + minus;
        z[k] = value.empty()
                   ? "S(0)"
                   : define(context, fmt::format("z{}_{}", number, k), fmt::format("({}) * {}", value, factor.name));
    }
    return z;
}

/// L f = b, z = L^-T (f / d).
std::vector<std::string> solve_ldlt(const SolveContext& context, const PrintedFactor& factor,
                                    const std::vector<std::string>& b, std::size_t number,
                                    const std::vector<bool>& wanted)
{
    const std::size_t n = factor.order;
    std::vector<std::string> f(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<std::pair<std::string, std::string>> products;
        for (std::size_t k = 0; k < i; ++k)
            if (!factor.l[i][k].empty() && !f[k].empty()) products.emplace_back(factor.l[i][k], f[k]);
        const std::string& right = b[factor.elimination[i]];
        f[i] = products.empty() ? right
                                : define(context, fmt::format("f{}_{}", number, i), minus_products(right, products));
    }
    std::vector<bool> needed(n);
    for (std::size_t i = 0; i < n; ++i) {
        needed[i] = wanted[factor.elimination[i]];
        for (std::size_t k = 0; k < i; ++k) needed[i] = needed[i] || (needed[k] && !factor.l[i][k].empty());
    }
    std::vector<std::string> z(n);
    std::vector<std::string> result(n);
    for (std::size_t i = n; i-- > 0;) {
        if (!needed[i]) continue;
        std::vector<std::pair<std::string, std::string>> products;
        for (std::size_t k = i + 1; k < n; ++k)
            if (!factor.l[k][i].empty() && !z[k].empty()) products.emplace_back(factor.l[k][i], z[k]);
        const std::string first = f[i].empty() ? std::string() : f[i] + " * " + factor.reciprocals[i];
        if (first.empty() && products.empty()) continue;
        z[i] = define(context, fmt::format("z{}_{}", number, factor.elimination[i]), minus_products(first, products));
        result[factor.elimination[i]] = z[i];
    }
    for (std::size_t i = 0; i < n; ++i)
        if (wanted[i] && result[i].empty()) result[i] = "S(0)";
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

PrintedFactor print_factor(const SolveContext& context, NodeId id, std::size_t number, bool check, bool solved)
{
    const std::size_t n = order_of(context.graph, id);
    const bool definite = context.graph.payload(id) == static_cast<std::uint32_t>(MatrixStructure::positive_definite);
    if (n == 2) return print_closed_form(context, id, number, check, solved);
    if (definite && n <= largest_written_out) return print_ldlt(context, id, n, number, check, solved);
    return print_pivoted(context, id, n, number, check);
}

std::vector<std::string> print_solution(const SolveContext& context, const PrintedFactor& factor, NodeId id,
                                        std::size_t number, const std::vector<bool>& wanted)
{
    const std::span<const NodeId> right = context.graph.operands(id).subspan(1);
    if (factor.kind == PrintedFactor::Kind::pivoted) {
        std::string entries;
        for (const NodeId entry : right) entries += (entries.empty() ? "" : ", ") + context.spell(entry).text;
        const std::string name = context.fresh(fmt::format("z{}", number));
        context.add_statement(
            fmt::format("const std::array<S, {}> {} = {}.solve({{{}}});", factor.order, name, factor.name, entries));
        std::vector<std::string> result;
        for (std::size_t k = 0; k < factor.order; ++k) result.push_back(fmt::format("{}[{}]", name, k));
        return result;
    }
    std::vector<std::string> b;
    for (const NodeId entry : right) b.push_back(entry_text(context, entry));
    if (factor.kind == PrintedFactor::Kind::closed_form) return solve_closed_form(context, factor, b, number, wanted);
    return solve_ldlt(context, factor, b, number, wanted);
}

} // namespace lagen
