// SPDX-License-Identifier: GPL-2.0-or-later
/// Kernels of a long chain. Prints the largest difference, relative to the
/// largest entry, of the Jacobian from central differences of the right-hand side, and of Jacobian times v from the
/// directional derivative.
#include "chain.hpp"

#include <cmath>
#include <cstdio>

int main()
{
    using Real = long double;
    using Chain = lagen::models::chain<Real>;
    using State = Chain::State;
    const Chain chain;
    State s, v;
    for (int k = 0; k < Chain::dimension; ++k) {
        s[k] = std::sin(Real(1 + 3 * k));
        v[k] = std::cos(Real(2 + 5 * k));
    }
    const auto check = [](lagen::Status status) {
        if (status != lagen::Status::ok) std::printf("failed\n");
    };
    const auto J = chain.jacobian(Real(0), s);
    const Real h = 1e-6L;
    Eigen::Matrix<Real, Chain::dimension, Chain::dimension> differences;
    for (int k = 0; k < Chain::dimension; ++k) {
        State above = s, below = s, right, left;
        above[k] += h;
        below[k] -= h;
        check(chain.rhs(Real(0), above, right));
        check(chain.rhs(Real(0), below, left));
        differences.col(k) = (right - left) / (2 * h);
    }
    State ds, dv;
    check(chain.rhs(Real(0), s, ds));
    check(chain.variational(Real(0), s, v, dv));
    const auto relative = [](const auto& a, const auto& b) {
        return static_cast<double>((a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff());
    };
    std::printf("jacobian differences %.3g\n", relative(differences, J));
    std::printf("jacobian directional %.3g\n", relative(dv, (J * v).eval()));
    return 0;
}
