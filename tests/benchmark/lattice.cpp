// SPDX-License-Identifier: GPL-2.0-or-later
/// Implicit methods on a generated lattice: Newton's matrices decomposed inside the band of the Jacobian's pattern, and
/// the same as full matrices. Compiled by scripts/lattice-table. Prints, a line a method, the microseconds a step
/// (least of 9 interleaved rounds) and their ratio.
#include "lattice.hpp"

#include "lagen/integrate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace {

using Lattice = lagen::models::lattice<double>;
using State = Lattice::State;
constexpr auto dimension = static_cast<std::size_t>(Lattice::dimension);

/// Row or column of every entry of a full matrix.
constexpr auto every(bool row)
{
    std::array<int, dimension * dimension> list{};
    for (std::size_t k = 0; k < list.size(); ++k) list[k] = static_cast<int>(row ? k / dimension : k % dimension);
    return list;
}

/// The model with every entry in its pattern.
struct Full : Lattice {
    static constexpr auto jacobian_rows = every(true), jacobian_columns = every(false);
    void jacobian_values(double t, const State& s, std::array<double, dimension * dimension>& values) const noexcept
    {
        std::array<double, Lattice::jacobian_rows.size()> few;
        Lattice::jacobian_values(t, s, few);
        values.fill(0);
        for (std::size_t k = 0; k < few.size(); ++k)
            values[static_cast<std::size_t>(Lattice::jacobian_rows[k]) * dimension +
                   static_cast<std::size_t>(Lattice::jacobian_columns[k])] = few[k];
    }
};

State start()
{
    State s;
    constexpr int n = Lattice::dimension / 2;
    for (int i = 0; i < n; ++i) s[i] = std::sin(3.0 * (i + 1) / (n + 1)), s[n + i] = 0.3 * std::cos(5.0 * i);
    return s;
}

template <class M, class Method>
double microseconds(const Method& method)
{
    const auto begin = std::chrono::steady_clock::now();
    const auto run = lagen::integrate(M{}, start(), {0.0, 3.0}, method);
    const std::chrono::duration<double, std::micro> length = std::chrono::steady_clock::now() - begin;
    return run ? length.count() / static_cast<double>(run.steps) : -1;
}

template <class Method>
void compare(const char* name, const Method& method)
{
    double band = 1e300, full = 1e300;
    for (int round = 0; round < 9; ++round) {
        band = std::min(band, microseconds<Lattice>(method));
        full = std::min(full, microseconds<Full>(method));
    }
    std::printf("%6d  %-12s %10.2f %10.2f %7.3f\n", Lattice::dimension / 2, name, band, full, band / full);
}

} // namespace

int main()
{
    compare("Gauss4", lagen::Gauss4{.step = 0.1});
    compare("Gauss8", lagen::Gauss8{.step = 0.1});
    compare("Radau5Fixed", lagen::Radau5Fixed{.step = 0.1});
    compare("Radau5", lagen::Radau5{.tolerance = 1e-6});
}
