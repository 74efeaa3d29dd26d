// SPDX-License-Identifier: GPL-2.0-or-later
#include "proof/eigenvalues.hpp"

#include <acb_mat.h>
#include <acb_poly.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace lagen::proof {
namespace {

using Complex = std::complex<double>;
using Places = std::vector<std::size_t>;

constexpr int most_sweeps = 40;    ///< of balancing
constexpr slong most_steps = 1000; ///< of QR a row: at a Jordan block they converge slowly

/// A complex ball.
class ComplexBall {
  public:
    ComplexBall() { acb_init(ball_); }
    ComplexBall(const ComplexBall& other) : ComplexBall() { acb_set(ball_, other.ball_); }
    ComplexBall(ComplexBall&& other) noexcept : ComplexBall() { acb_swap(ball_, other.ball_); }
    ComplexBall& operator=(ComplexBall other) noexcept
    {
        acb_swap(ball_, other.ball_);
        return *this;
    }
    ~ComplexBall() { acb_clear(ball_); }

    [[nodiscard]] acb_ptr get() { return ball_; }
    [[nodiscard]] acb_srcptr get() const { return ball_; }
    [[nodiscard]] Complex middle() const
    {
        return {arf_get_d(arb_midref(acb_realref(ball_)), ARF_RND_NEAR),
                arf_get_d(arb_midref(acb_imagref(ball_)), ARF_RND_NEAR)};
    }

  private:
    acb_t ball_;
};

/// One of QR's: `enclosure` is certain to hold the eigenvalue where `certain`.
struct Approximation {
    ComplexBall value, enclosure;
    bool certain = false;
    double size = 0; ///< the norm of its block
};

/// Rows that entries lead to from each other, there and back.
std::vector<Places> irreducible_blocks(const BallMatrix& A)
{
    const std::size_t n = A.rows;
    std::vector<std::vector<bool>> leads(n, std::vector<bool>(n));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) leads[i][j] = i == j || arb_is_zero(A.at(i, j).get()) == 0;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; leads[i][k] && j < n; ++j) leads[i][j] = leads[i][j] || leads[k][j];
    std::vector<Places> blocks;
    std::vector<bool> taken(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (taken[i]) continue;
        Places& block = blocks.emplace_back();
        for (std::size_t j = i; j < n; ++j)
            if (leads[i][j] && leads[j][i]) block.push_back(j), taken[j] = true;
    }
    return blocks;
}

BallMatrix block_at(const BallMatrix& A, const Places& rows)
{
    BallMatrix out(rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < rows.size(); ++j) out.at(i, j) = A.at(rows[i], rows[j]);
    return out;
}

/// D^-1 A D with a diagonal D of powers of two, so that each row is about as long as its column.
void balance(BallMatrix& A)
{
    for (int sweep = 0, moved = 1; sweep < most_sweeps && moved != 0; ++sweep) {
        moved = 0;
        for (std::size_t k = 0; k < A.rows; ++k) {
            double row = 0, column = 0;
            for (std::size_t i = 0; i < A.rows; ++i) {
                if (i == k) continue;
                row += std::abs(A.at(k, i).middle()), column += std::abs(A.at(i, k).middle());
            }
            if (!(row > 0) || !(column > 0) || !std::isfinite(row) || !std::isfinite(column)) continue;
            const auto shift = static_cast<slong>(std::lround(std::log2(row / column) / 2));
            if (shift == 0) continue;
            moved = 1;
            for (std::size_t i = 0; i < A.rows; ++i) {
                if (i == k) continue;
                arb_mul_2exp_si(A.at(k, i).get(), A.at(k, i).get(), -shift);
                arb_mul_2exp_si(A.at(i, k).get(), A.at(i, k).get(), shift);
            }
        }
    }
}

double norm_of(const BallMatrix& A)
{
    double largest = 0;
    for (const Ball& entry : A.entries) largest = std::max(largest, std::abs(entry.middle()));
    return largest * static_cast<double>(A.rows);
}

/// The eigenvalues of an irreducible block.
std::vector<Approximation> approximations(BallMatrix A, slong precision)
{
    balance(A);
    const auto n = static_cast<slong>(A.rows);
    acb_mat_t matrix, middle, right;
    acb_mat_init(matrix, n, n);
    acb_mat_init(middle, n, n);
    acb_mat_init(right, n, n);
    for (slong i = 0; i < n; ++i)
        for (slong j = 0; j < n; ++j)
            acb_set_arb(acb_mat_entry(matrix, i, j),
                        A.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j)).get());
    acb_mat_get_mid(middle, matrix);
    acb_ptr near = _acb_vec_init(n), certain = _acb_vec_init(n);
    acb_mat_approx_eig_qr(near, nullptr, right, middle, nullptr, most_steps * n, precision);
    const bool enclosed = acb_mat_eig_multiple(certain, matrix, near, right, precision) != 0;
    std::vector<Approximation> out(A.rows);
    for (slong k = 0; k < n; ++k) {
        Approximation& each = out[static_cast<std::size_t>(k)];
        acb_get_mid(each.value.get(), near + k);
        acb_set(each.enclosure.get(), certain + k);
        each.certain = enclosed;
        each.size = norm_of(A);
    }
    _acb_vec_clear(near, n);
    _acb_vec_clear(certain, n);
    acb_mat_clear(right);
    acb_mat_clear(middle);
    acb_mat_clear(matrix);
    return out;
}

class Clusters {
  public:
    Clusters(std::vector<Approximation> found, slong precision, double rounding)
        : found_(std::move(found)), precision_(precision), rounding_(rounding)
    {
        Places all(found_.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        if (!all.empty()) divide(all);
        pair();
    }

    std::vector<Eigenvalue> sorted()
    {
        std::ranges::sort(out_, [](const Eigenvalue& a, const Eigenvalue& b) {
            return a.real != b.real ? a.real < b.real : a.imaginary < b.imaginary;
        });
        return std::move(out_);
    }

  private:
    [[nodiscard]] double distance(std::size_t i, std::size_t j) const
    {
        ComplexBall difference;
        acb_sub(difference.get(), found_[i].value.get(), found_[j].value.get(), precision_);
        return std::abs(difference.middle());
    }

    [[nodiscard]] double size_of(const Places& members) const
    {
        double size = 0;
        for (const std::size_t k : members) size = std::max(size, found_[k].size);
        return size;
    }

    [[nodiscard]] ComplexBall mean_of(const Places& members) const
    {
        ComplexBall sum;
        for (const std::size_t k : members) acb_add(sum.get(), sum.get(), found_[k].value.get(), precision_);
        acb_div_ui(sum.get(), sum.get(), members.size(), precision_);
        return sum;
    }

    /// True where prod (x + m - lambda_i) is x^k but for rounding, in units of the largest norm of their blocks.
    [[nodiscard]] bool is_one(const Places& members, const ComplexBall& mean) const
    {
        const double size = size_of(members);
        if (size == 0 || members.size() == 1) return true;
        const auto k = static_cast<slong>(members.size());
        acb_ptr roots = _acb_vec_init(k), coefficients = _acb_vec_init(k + 1);
        const Ball unit(Rational(size), precision_);
        for (slong i = 0; i < k; ++i) {
            acb_sub(roots + i, found_[members[static_cast<std::size_t>(i)]].value.get(), mean.get(), precision_);
            acb_div_arb(roots + i, roots + i, unit.get(), precision_);
        }
        _acb_poly_product_roots(coefficients, roots, k, precision_);
        bool small = true;
        for (slong i = 0; i < k; ++i) {
            ComplexBall coefficient;
            acb_get_mid(coefficient.get(), coefficients + i);
            small = small && std::abs(coefficient.middle()) <= rounding_;
        }
        _acb_vec_clear(roots, k);
        _acb_vec_clear(coefficients, k + 1);
        return small;
    }

    /// One eigenvalue, or the parts that the largest gap of a shortest tree leaves.
    void divide(const Places& members)
    {
        const ComplexBall mean = mean_of(members);
        if (is_one(members, mean)) {
            keep(members, mean);
            return;
        }
        const std::size_t k = members.size();
        std::vector<double> nearest(k, HUGE_VAL);
        std::vector<bool> in_tree(k);
        double gap = 0;
        for (std::size_t next = 0, count = 0; count < k; ++count) {
            in_tree[next] = true;
            if (count > 0) gap = std::max(gap, nearest[next]);
            std::size_t best = k;
            for (std::size_t j = 0; j < k; ++j) {
                if (in_tree[j]) continue;
                nearest[j] = std::min(nearest[j], distance(members[next], members[j]));
                if (best == k || nearest[j] < nearest[best]) best = j;
            }
            next = best;
        }
        Places rest = members;
        while (!rest.empty()) { // gaps of the same length are taken together: conjugates are divided alike
            Places part{rest.back()};
            rest.pop_back();
            for (std::size_t at = 0; at < part.size(); ++at)
                std::erase_if(rest, [&](std::size_t other) {
                    const bool joins = distance(part[at], other) < (1 - 1e-9) * gap;
                    if (joins) part.push_back(other);
                    return joins;
                });
            divide(part);
        }
    }

    void keep(const Places& members, const ComplexBall& mean)
    {
        const double nothing = 16 * rounding_ * size_of(members);
        const auto clean = [&](double part) { return std::abs(part) <= nothing ? 0.0 : part; };
        const Complex middle = mean.middle();
        Eigenvalue each{clean(middle.real()), clean(middle.imag()), members.size(), 0, true, HUGE_VAL, -HUGE_VAL};
        for (const std::size_t k : members) {
            ComplexBall off;
            acb_sub(off.get(), found_[k].value.get(), mean.get(), precision_);
            each.spread = std::max(each.spread, std::abs(off.middle()));
            each.certain = each.certain && found_[k].certain;
            arf_t bound;
            arf_init(bound);
            arb_get_lbound_arf(bound, acb_realref(found_[k].enclosure.get()), 53);
            each.least = std::min(each.least, arf_get_d(bound, ARF_RND_FLOOR));
            arb_get_ubound_arf(bound, acb_realref(found_[k].enclosure.get()), 53);
            each.most = std::max(each.most, arf_get_d(bound, ARF_RND_CEIL));
            arf_clear(bound);
        }
        out_.push_back(each);
    }

    /// Each eigenvalue above the axis gets the one below it as its exact conjugate; one without is real.
    void pair()
    {
        std::vector<bool> done(out_.size());
        for (std::size_t i = 0; i < out_.size(); ++i) {
            if (!(out_[i].imaginary > 0)) continue;
            std::size_t best = out_.size();
            const auto miss = [&](std::size_t j) {
                return std::hypot(out_[i].real - out_[j].real, out_[i].imaginary + out_[j].imaginary);
            };
            for (std::size_t j = 0; j < out_.size(); ++j)
                if (!done[j] && out_[j].imaginary < 0 && out_[j].multiplicity == out_[i].multiplicity &&
                    (best == out_.size() || miss(j) < miss(best)))
                    best = j;
            done[i] = true;
            if (best == out_.size() || miss(best) > out_[i].imaginary) {
                out_[i].spread += out_[i].imaginary;
                out_[i].imaginary = 0;
                continue;
            }
            done[best] = true;
            out_[best].real = out_[i].real;
            out_[best].imaginary = -out_[i].imaginary;
        }
        for (std::size_t j = 0; j < out_.size(); ++j)
            if (!done[j] && out_[j].imaginary < 0) {
                out_[j].spread -= out_[j].imaginary;
                out_[j].imaginary = 0;
            }
    }

    std::vector<Approximation> found_;
    slong precision_;
    double rounding_;
    std::vector<Eigenvalue> out_;
};

} // namespace

std::vector<Eigenvalue> eigenvalues(const BallMatrix& A, slong precision, double rounding)
{
    std::vector<Approximation> found;
    for (const Places& block : irreducible_blocks(A))
        for (Approximation& each : approximations(block_at(A, block), precision)) found.push_back(std::move(each));
    return Clusters(std::move(found), precision, rounding).sorted();
}

} // namespace lagen::proof
