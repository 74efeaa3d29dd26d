// SPDX-License-Identifier: GPL-2.0-or-later
/// Rooted trees and the order conditions of Runge-Kutta methods [Hairer, Norsett, Wanner II.2]: sum_i b_i Phi_i(t) = 1
/// / gamma(t).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lagen::support {

/// A tree by the numbers of the trees on its root, in a list where smaller trees come first.
struct RootedTree {
    std::vector<std::size_t> children;
    std::size_t order = 1;
    long gamma = 1;
};

namespace detail {

inline void grow(std::vector<RootedTree>& list, RootedTree tree, std::size_t most, std::size_t rest, std::size_t known)
{
    if (rest == 0) {
        tree.gamma = static_cast<long>(tree.order);
        for (std::size_t child : tree.children) tree.gamma *= list[child].gamma;
        list.push_back(tree);
        return;
    }
    for (std::size_t child = 0; child < known && child <= most; ++child) {
        if (list[child].order > rest) break;
        RootedTree next = tree;
        next.children.push_back(child);
        grow(list, next, child, rest - list[child].order, known);
    }
}

} // namespace detail

/// Every rooted tree of at most `order` vertices: 1, 1, 2, 4, 9, 20, 48, 115, ... of each order.
inline std::vector<RootedTree> rooted_trees(std::size_t order)
{
    std::vector<RootedTree> list;
    for (std::size_t n = 1; n <= order; ++n) {
        RootedTree root;
        root.order = n;
        const std::size_t known = list.size();
        detail::grow(list, root, known, n - 1, known);
    }
    return list;
}

/// Largest |sum_i weights_i Phi_i(t) - theta^order / gamma(t)| over the trees of order `from` to `to`; the rows of the
/// method's matrix may end before the zeros at their end.
template <class Number>
Number worst_residual(const std::vector<std::vector<Number>>& rows, const std::vector<Number>& weights,
                      std::size_t from, std::size_t to, const Number& theta = Number(1))
{
    const std::vector<RootedTree> trees = rooted_trees(to);
    const std::size_t stages = weights.size();
    std::vector<std::vector<Number>> phi(trees.size(), std::vector<Number>(stages, Number(1)));
    Number worst = Number(0);
    for (std::size_t t = 0; t < trees.size(); ++t) {
        Number sum = Number(0), power = Number(1);
        for (std::size_t i = 0; i < stages; ++i) {
            for (std::size_t child : trees[t].children) {
                Number inner = Number(0);
                for (std::size_t j = 0; j < rows[i].size(); ++j) inner += rows[i][j] * phi[child][j];
                phi[t][i] *= inner;
            }
            sum += weights[i] * phi[t][i];
        }
        for (std::size_t k = 0; k < trees[t].order; ++k) power *= theta;
        Number residual = sum - power / Number(trees[t].gamma);
        if (residual < 0) residual = -residual;
        if (trees[t].order >= from && residual > worst) worst = residual;
    }
    return worst;
}

/// The same for an explicit method: a(i, j) by rows of the strict lower triangle.
template <class Number>
Number worst_residual(const std::vector<Number>& a, const std::vector<Number>& weights, std::size_t from,
                      std::size_t to, const Number& theta = Number(1))
{
    std::vector<std::vector<Number>> rows(weights.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) rows[i].push_back(a[i * (i - 1) / 2 + j]);
    return worst_residual(rows, weights, from, to, theta);
}

} // namespace lagen::support
