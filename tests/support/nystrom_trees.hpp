// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees and order conditions of Nystrom methods for x'' = f(t, x, x') [Hairer, Norsett, Wanner II.14]. A tree is a
/// value of f differentiated: along x' as it stands (a leaf, which is time, too), along x at an f integrated twice,
/// along x' at an f integrated once. At the exact solution Phi(tree)(c) = kappa c^(order - 1), and
///   sum_i b_i Phi_i = kappa / order,   sum_i bbar_i Phi_i = kappa / (order (order + 1)).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lagen::support {

enum class Branch { leaf, position, rate };

template <class Number>
struct NystromTree {
    std::vector<std::pair<Branch, std::size_t>> branches; ///< and the tree that stands there, in a list of trees
    std::size_t order = 1;
    Number kappa = Number(1);
};

/// Every tree of at most `order`, smaller ones first; with `rates`: f depends on x' too.
template <class Number>
class NystromTrees {
  public:
    NystromTrees(std::size_t order, bool rates) : rates_(rates)
    {
        for (std::size_t n = 1; n <= order; ++n) {
            known_ = trees_.size();
            grow({}, n - 1, {Branch::rate, known_});
        }
    }

    [[nodiscard]] const std::vector<NystromTree<Number>>& list() const { return trees_; }

  private:
    using Item = std::pair<Branch, std::size_t>;

    [[nodiscard]] std::size_t cost(const Item& item) const
    {
        if (item.first == Branch::leaf) return 1;
        return trees_[item.second].order + (item.first == Branch::position ? 1 : 0);
    }

    void grow(std::vector<Item> branches, std::size_t rest, Item most)
    {
        if (rest == 0) return keep(std::move(branches));
        for (const Branch kind : {Branch::leaf, Branch::position, Branch::rate}) {
            if (kind == Branch::rate && !rates_) continue;
            const std::size_t count = kind == Branch::leaf ? 1 : known_;
            for (std::size_t k = 0; k < count; ++k) {
                const Item item{kind, k};
                if (item > most || cost(item) > rest) continue;
                auto longer = branches;
                longer.push_back(item);
                grow(std::move(longer), rest - cost(item), item);
            }
        }
    }

    void keep(std::vector<Item> branches)
    {
        NystromTree<Number> tree;
        for (const Item& item : branches) {
            tree.order += cost(item);
            if (item.first == Branch::leaf) continue;
            const auto& child = trees_[item.second];
            const Number n = Number(child.order);
            tree.kappa *= child.kappa / (item.first == Branch::position ? Number(n * (n + 1)) : n);
        }
        tree.branches = std::move(branches);
        trees_.push_back(std::move(tree));
    }

    std::vector<NystromTree<Number>> trees_;
    std::size_t known_ = 0;
    bool rates_;
};

/// A Nystrom method: rows of abar, and of a, which may be empty; its nodes.
template <class Number>
struct NystromRows {
    std::vector<std::vector<Number>> abar, a;
    std::vector<Number> c;
};

/// Phi_i of every tree at every stage.
template <class Number>
std::vector<std::vector<Number>> elementary_weights(const NystromRows<Number>& rows,
                                                    const std::vector<NystromTree<Number>>& trees)
{
    const auto sums = [](const std::vector<std::vector<Number>>& matrix, const std::vector<Number>& phi) {
        std::vector<Number> result(phi.size(), Number(0));
        for (std::size_t i = 0; i < matrix.size(); ++i)
            for (std::size_t j = 0; j < matrix[i].size(); ++j) result[i] += matrix[i][j] * phi[j];
        return result;
    };
    std::vector<std::vector<Number>> phi, positions, rates;
    for (const auto& tree : trees) {
        std::vector<Number> here(rows.c.size(), Number(1));
        for (const auto& [branch, child] : tree.branches) {
            const auto& factor = branch == Branch::leaf       ? rows.c
                                 : branch == Branch::position ? positions[child]
                                                              : rates[child];
            for (std::size_t i = 0; i < here.size(); ++i) here[i] *= factor[i];
        }
        positions.push_back(sums(rows.abar, here));
        rates.push_back(sums(rows.a, here));
        phi.push_back(std::move(here));
    }
    return phi;
}

/// The largest error of the weights at theta over the trees of order `from` to `to`; of weights of x, whose order is
/// one more than that of the tree, where `twice`.
template <class Number>
Number worst_nystrom_residual(const std::vector<std::vector<Number>>& phi,
                              const std::vector<NystromTree<Number>>& trees, const std::vector<Number>& weights,
                              std::size_t from, std::size_t to, bool twice, const Number& theta = Number(1))
{
    Number worst = Number(0);
    for (std::size_t k = 0; k < trees.size(); ++k) {
        const std::size_t n = trees[k].order, powers = n + (twice ? 1 : 0);
        if (powers < from || powers > to) continue;
        Number residual = -trees[k].kappa / Number(n);
        if (twice) residual /= Number(n + 1);
        for (std::size_t p = 0; p < powers; ++p) residual *= theta;
        for (std::size_t i = 0; i < weights.size(); ++i) residual += weights[i] * phi[k][i];
        if (residual < 0) residual = -residual;
        if (residual > worst) worst = residual;
    }
    return worst;
}

} // namespace lagen::support
