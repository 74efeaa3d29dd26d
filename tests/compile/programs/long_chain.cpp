// SPDX-License-Identifier: GPL-2.0-or-later
/// A chain of 32 links. Prints the largest difference, relative to the largest entry, of its Jacobian from central
/// differences of the right-hand side; then for implicit methods how far the run goes and its distance from dop853.
#include "lagen/integrate.hpp"

#include "chain_relative.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

namespace {

using Chain = lagen::models::chain_relative<double>;
using State = Chain::State;
const lagen::Interval<double> span{0.0, 0.05};

State flow(const Chain& chain, const State& s, const auto& method)
{
    const auto run = lagen::integrate(chain, s, span, method);
    if (!run) std::printf("%s\n", to_text(run.status()));
    return run.state;
}

double differences(const Chain& chain, const State& s)
{
    const auto values = std::make_unique<std::array<double, Chain::jacobian_rows.size()>>();
    chain.jacobian_values(0, s, *values);
    const double h = 1e-5;
    double largest = 0, worst = 0;
    for (int c = 0; c < Chain::dimension; ++c) {
        State above = s, below = s, right, left;
        above[c] += h;
        below[c] -= h;
        if (chain.rhs(0, above, right) != lagen::Status::ok || chain.rhs(0, below, left) != lagen::Status::ok) return 1;
        State column = (right - left) / (2 * h);
        for (std::size_t k = 0; k < values->size(); ++k) {
            if (Chain::jacobian_columns[k] != c) continue;
            column[Chain::jacobian_rows[k]] -= (*values)[k];
            largest = std::max(largest, std::abs((*values)[k]));
        }
        worst = std::max(worst, column.cwiseAbs().maxCoeff());
    }
    return worst / largest;
}

} // namespace

int main()
{
    const Chain chain;
    State s;
    for (int k = 0; k < Chain::dimension; ++k) s[k] = std::sin(1.0 + 3 * k) / 4;
    std::printf("jacobian differences %.3g\n", differences(chain, s));
    const State exact = flow(chain, s, lagen::Dop853{.tolerance = 1e-13});
    const auto tell = [&](const char* name, const State& found) {
        std::printf("method %s %.3g %.3g\n", name, (exact - s).cwiseAbs().maxCoeff(),
                    (exact - found).cwiseAbs().maxCoeff());
    };
    tell("radau5", flow(chain, s, lagen::Radau5{.tolerance = 1e-10}));
    tell("gauss8", flow(chain, s, lagen::Gauss8{.step = 1.0 / 2048}));
}
