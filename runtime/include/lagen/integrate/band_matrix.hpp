// SPDX-License-Identifier: MIT
/// Matrices whose entries lie near the diagonal once their unknowns are put in order, as those of chains and lattices
/// with few neighbours: the order, found from the pattern (by the compiler, where that is a constant), and the LU
/// decomposition inside the band.
/// With w the width, it takes about 2 n w^2 products instead of n^3 / 3, and 4 n w instead of n^2 to solve.
#pragma once

#include "lagen/integrate/newton_matrix.hpp"

#include <algorithm>

namespace lagen::detail {

/// `place[i]`: where unknown i stands; `width`: the largest |place[i] - place[j]| of an entry (i, j).
template <std::size_t n>
struct BandOrder {
    Numbers<std::size_t, n> place{};
    std::size_t width = 0;

    static constexpr std::size_t known_size = sized_later, known_row = sized_later;
    [[nodiscard]] constexpr std::size_t size() const noexcept { return place.size(); }
};

/// The same, known to the compiler.
template <const auto& order>
struct KnownBand {
    static constexpr const auto& place = order.place;
    static constexpr std::size_t width = order.width;

    static constexpr std::size_t known_size = order.place.size(), known_row = 3 * width + 1;
    [[nodiscard]] static constexpr std::size_t size() noexcept { return known_size; }
};

/// Neighbours in the graph of a pattern: entry (i, j) joins i and j.
template <std::size_t size>
struct Neighbours {
    Numbers<std::size_t, size == sized_later ? size : size + 1> first{};
    Numbers<std::size_t, size == sized_later ? size : 2 * std::min<std::size_t>(8 * size, 2048)> list{};

    template <class Places>
    constexpr Neighbours(std::size_t n, const Places& rows, const Places& columns)
    {
        make_numbers(first, n + 1, 0);
        make_numbers(list, 2 * rows.size(), 0);
        for (const auto* ends : {&rows, &columns})
            for (const auto end : *ends) ++first[static_cast<std::size_t>(end) + 1];
        for (std::size_t i = 0; i < n; ++i) first[i + 1] += first[i];
        Numbers<std::size_t, size> filled{};
        make_numbers(filled, n, 0);
        for (std::size_t k = 0; k < rows.size(); ++k) {
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
template <std::size_t size, class Places>
constexpr BandOrder<size> band_order(Size<size> n, const Places& rows, const Places& columns)
{
    const std::size_t entries = rows.size();
    BandOrder<size> band{{}, n};
    make_numbers(band.place, n, 0);
    if (entries > std::min<std::size_t>(8 * n, 2048)) return band;
    const Neighbours<size> near(n, rows, columns);
    for (std::size_t i = 0; i < n; ++i)
        if (near.degree(i) > 2 * 32) return band; // an entry above the diagonal and one below it
    Numbers<std::size_t, size> order{};
    Numbers<std::size_t, size> seen{}; // the number of the search that met it last
    make_numbers(order, n, 0);
    make_numbers(seen, n, 0);
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

template <std::size_t n, class Index, std::size_t entries>
constexpr BandOrder<n> band_order(const std::array<Index, entries>& rows, const std::array<Index, entries>& columns)
{
    return band_order(Size<n>(), rows, columns);
}

/// Is a decomposition inside the band cheaper? (scripts/lattice-table: of 8 unknowns and w = 3 it is not yet.)
template <std::size_t n>
constexpr bool is_narrow(const BandOrder<n>& band) noexcept
{
    return band.size() > 8 && 4 * band.width < band.size();
}

/// As MatrixLu, of a matrix whose entries (i, j) the order has inside its band, a BandOrder or a KnownBand. Exchanges
/// of rows make the upper triangle twice as wide.
template <class Entry, class Band>
class BandLu {
    static constexpr std::size_t size = Band::known_size;

  public:
    using Real = typename RealPart<Entry>::type;

    BandLu()
    {
        if constexpr (size != sized_later) begin({});
    }

    /// A matrix of zeros; takes memory where it is not in place.
    void begin(const Band& band)
    {
        band_ = band;
        make_numbers(lu_, band_.size() * (3 * band_.width + 1), zero<Entry>());
        make_numbers(inverses_, band_.size(), zero<Entry>());
        make_numbers(ordered_, band_.size(), zero<Entry>());
        make_numbers(swaps_, band_.size(), 0);
    }

    /// The matrix to be factorised, by entries of the band.
    [[nodiscard]] Entry& operator()(std::size_t i, std::size_t j) noexcept
    {
        return at(band_.place[i], band_.place[j]);
    }

    void clear() noexcept { std::fill(lu_.begin(), lu_.end(), zero<Entry>()); }

    /// Factorises in place. False where a pivot is zero or no number.
    [[nodiscard]] bool factor() noexcept
    {
        const std::size_t n = band_.size();
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
    void solve(Numbers<Entry, size>& b) noexcept
    {
        Entry* const c = ordered_.data();
        const std::size_t n = band_.size();
        for (std::size_t i = 0; i < n; ++i) c[band_.place[i]] = b[i];
        for (std::size_t k = 0; k < n; ++k) {
            if (swaps_[k] != k) std::swap(c[k], c[swaps_[k]]);
            for (std::size_t i = k + 1; i < below(k); ++i) c[i] = c[i] - at(i, k) * c[k];
        }
        for (std::size_t k = n; k-- > 0;) {
            for (std::size_t j = k + 1; j < beside(k); ++j) c[k] = c[k] - at(k, j) * c[j];
            c[k] = c[k] * inverses_[k];
        }
        for (std::size_t i = 0; i < n; ++i) b[i] = c[band_.place[i]];
    }

  private:
    [[nodiscard]] std::size_t below(std::size_t k) const noexcept
    {
        return std::min<std::size_t>(band_.size(), k + band_.width + 1);
    }
    [[nodiscard]] std::size_t beside(std::size_t k) const noexcept
    {
        return std::min<std::size_t>(band_.size(), k + 2 * band_.width + 1);
    }

    [[nodiscard]] Entry& at(std::size_t i, std::size_t j) noexcept
    {
        return lu_[i * (3 * band_.width + 1) + (j + band_.width - i)];
    }

    bool bring_up_pivot(std::size_t k) noexcept
    {
        Real largest = magnitude(at(k, k));
        std::size_t row = k;
        for (std::size_t i = k + 1; i < below(k); ++i) {
            const Real size_here = magnitude(at(i, k));
            if (!(size_here > largest)) continue;
            largest = size_here;
            row = i;
        }
        if (k < row)
            for (std::size_t j = k; j < beside(k); ++j) std::swap(at(k, j), at(row, j));
        swaps_[k] = row;
        return largest > Real(0) && largest - largest == Real(0);
    }

    [[no_unique_address]] Band band_{};
    Numbers<Entry, held_in_place(size, Band::known_row)> lu_;
    Numbers<Entry, size> inverses_, ordered_;
    Numbers<std::size_t, size> swaps_;
};

} // namespace lagen::detail
