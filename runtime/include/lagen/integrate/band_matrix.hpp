// SPDX-License-Identifier: MIT
/// Matrices whose entries lie near the diagonal once their unknowns are put in order, as those of chains and lattices
/// with few neighbours: the order, found from the pattern by the compiler, and the LU decomposition inside the band.
/// With w the width, it takes about 2 n w^2 products instead of n^3 / 3, and 4 n w instead of n^2 to solve.
#pragma once

#include "lagen/integrate/newton_matrix.hpp"

#include <algorithm>

namespace lagen::detail {

/// `place[i]`: where unknown i stands; `width`: the largest |place[i] - place[j]| of an entry (i, j).
template <std::size_t n>
struct BandOrder {
    std::array<std::size_t, n> place{};
    std::size_t width = 0;
};

/// Neighbours in the graph of a pattern: entry (i, j) joins i and j.
template <std::size_t n, std::size_t entries>
struct Neighbours {
    std::array<std::size_t, n + 1> first{};
    std::array<std::size_t, 2 * entries> list{};

    template <class Index>
    constexpr Neighbours(const std::array<Index, entries>& rows, const std::array<Index, entries>& columns) noexcept
    {
        for (const auto* ends : {&rows, &columns})
            for (const Index end : *ends) ++first[static_cast<std::size_t>(end) + 1];
        for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
        std::array<std::size_t, n> filled{};
        for (std::size_t k = 0; k < entries; ++k) {
            const auto i = static_cast<std::size_t>(rows[k]), j = static_cast<std::size_t>(columns[k]);
            list[first[i] + filled[i]++] = j;
            list[first[j] + filled[j]++] = i;
        }
    }

    [[nodiscard]] constexpr std::size_t degree(std::size_t i) const noexcept { return first[i + 1] - first[i]; }
};

/// Each unknown before its neighbours, those of few neighbours first [E. Cuthill, J. McKee, Reducing the bandwidth of
/// sparse symmetric matrices, Proc. 24th ACM National Conference (1969) 157], from an end of the graph:
/// what comes last in the order from what comes last in an order. A pattern with more than eight entries a row, more
/// than a compiler goes through with its usual limits, or an unknown with more than 32 neighbours, of which no order
/// makes a narrow band, keeps its order and has no band.
template <std::size_t n, class Index, std::size_t entries>
constexpr BandOrder<n> band_order(const std::array<Index, entries>& rows, const std::array<Index, entries>& columns)
{
    BandOrder<n> band{{}, n};
    if (entries > std::min<std::size_t>(8 * n, 2048)) return band;
    const Neighbours<n, entries> near(rows, columns);
    for (std::size_t i = 0; i < n; ++i)
        if (near.degree(i) > 2 * 32) return band; // an entry above the diagonal and one below it
    std::array<std::size_t, n> order{};
    std::array<std::size_t, n> seen{}; // the number of the search that met it last
    std::size_t count = 0, search = 0;
    const auto spread_from = [&](std::size_t root) {
        const std::size_t begin = count;
        ++search;
        order[count++] = root;
        seen[root] = search;
        for (std::size_t k = begin; k < count; ++k) {
            const std::size_t added = count;
            for (std::size_t m = near.first[order[k]]; m < near.first[order[k] + 1]; ++m) {
                const std::size_t next = near.list[m];
                if (seen[next] == search) continue;
                seen[next] = search;
                std::size_t place = count++;
                for (; place > added && near.degree(order[place - 1]) > near.degree(next); --place)
                    order[place] = order[place - 1];
                order[place] = next;
            }
        }
        return begin;
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (seen[i] != 0) continue;
        std::size_t root = i;
        for (int again = 0; again < 2; ++again) {
            const std::size_t begin = spread_from(root);
            root = order[count - 1];
            count = begin;
        }
        (void)spread_from(root);
    }
    band.width = 0;
    for (std::size_t k = 0; k < n; ++k) band.place[order[k]] = k;
    for (std::size_t k = 0; k < entries; ++k) {
        const std::size_t i = band.place[static_cast<std::size_t>(rows[k])];
        const std::size_t j = band.place[static_cast<std::size_t>(columns[k])];
        band.width = std::max(band.width, i < j ? j - i : i - j);
    }
    return band;
}

/// Is a decomposition inside the band cheaper? (scripts/lattice-table: of 8 unknowns and w = 3 it is not yet.)
template <std::size_t n>
constexpr bool is_narrow(const BandOrder<n>& band) noexcept
{
    return n > 8 && 4 * band.width < n;
}

/// As MatrixLu, of a matrix whose entries (i, j) the order has inside its band. Exchanges of rows make the upper
/// triangle twice as wide.
template <class Entry, std::size_t n, const BandOrder<n>& band>
class BandLu {
  public:
    using Real = typename RealPart<Entry>::type;

    /// The matrix to be factorised, by entries of the band.
    [[nodiscard]] Entry& operator()(std::size_t i, std::size_t j) noexcept { return at(band.place[i], band.place[j]); }

    void clear() { lu_.clear(); }

    /// Factorises in place. False where a pivot is zero or no number.
    [[nodiscard]] bool factor() noexcept
    {
        for (std::size_t k = 0; k < n; ++k) {
            if (!bring_up_pivot(k)) return false;
            const Entry inverse = reciprocal(at(k, k));
            inverses_[k] = inverse;
            for (std::size_t i = k + 1; i < below(k); ++i) {
                if (at(i, k) == zero<Entry>()) continue;
                const Entry multiplier = at(i, k) * inverse;
                at(i, k) = multiplier;
                for (std::size_t j = k + 1; j < beside(k); ++j) at(i, j) = at(i, j) - multiplier * at(k, j);
            }
        }
        return true;
    }

    /// Replaces b by A^-1 b.
    void solve(std::array<Entry, n>& b) const noexcept
    {
        std::array<Entry, n> c;
        for (std::size_t i = 0; i < n; ++i) c[band.place[i]] = b[i];
        for (std::size_t k = 0; k < n; ++k) {
            if (swaps_[k] != k) std::swap(c[k], c[swaps_[k]]);
            for (std::size_t i = k + 1; i < below(k); ++i) c[i] = c[i] - at(i, k) * c[k];
        }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t j = k + 1; j < beside(k); ++j) c[k] = c[k] - at(k, j) * c[j];
            c[k] = c[k] * inverses_[k];
        }
        for (std::size_t i = 0; i < n; ++i) b[i] = c[band.place[i]];
    }

  private:
    static constexpr std::size_t width = band.width;
    static std::size_t below(std::size_t k) noexcept { return std::min(n, k + width + 1); }
    static std::size_t beside(std::size_t k) noexcept { return std::min(n, k + 2 * width + 1); }

    [[nodiscard]] Entry& at(std::size_t i, std::size_t j) noexcept { return lu_(i, j + width - i); }
    [[nodiscard]] const Entry& at(std::size_t i, std::size_t j) const noexcept { return lu_(i, j + width - i); }

    bool bring_up_pivot(std::size_t k) noexcept
    {
        Real largest = magnitude(at(k, k));
        std::size_t row = k;
        for (std::size_t i = k + 1; i < below(k); ++i) {
            const Real size = magnitude(at(i, k));
            if (!(size > largest)) continue;
            largest = size;
            row = i;
        }
        if (k < row)
            for (std::size_t j = k; j < beside(k); ++j) std::swap(at(k, j), at(row, j));
        swaps_[k] = row;
        return largest > Real(0) && largest - largest == Real(0);
    }

    Grid<Entry, n, 3 * width + 1> lu_;
    std::array<Entry, n> inverses_{};
    std::array<std::size_t, n> swaps_{};
};

} // namespace lagen::detail
