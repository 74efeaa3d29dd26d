// SPDX-License-Identifier: GPL-2.0-or-later
/// A directional derivative in parts, written over the vector and over the state that it reads: prints the largest
/// differences from the same written elsewhere, and that from differences of the right-hand side, relative to its size.
#include "chain_relative.hpp"

#include <cmath>
#include <cstdio>

int main()
{
    using Chain = lagen::models::chain_relative<double>;
    using State = Chain::State;
    const Chain chain;
    State s, v;
    for (int k = 0; k < Chain::dimension; ++k) {
        s[k] = std::sin(1.0 + 3 * k);
        v[k] = std::cos(2.0 + 5 * k);
    }
    State dv;
    State along = v;
    State at = s;
    for (const lagen::Status status :
         {chain.variational(0, s, v, dv), chain.variational(0, s, along, along), chain.variational(0, at, v, at)})
        if (status != lagen::Status::ok) return 1;
    std::printf("in place %.3g %.3g %.3g\n", dv.cwiseAbs().maxCoeff(), (along - dv).cwiseAbs().maxCoeff(),
                (at - dv).cwiseAbs().maxCoeff());
    const double h = 1e-5;
    State right, left;
    for (const lagen::Status status : {chain.rhs(0, s + h * v, right), chain.rhs(0, s - h * v, left)})
        if (status != lagen::Status::ok) return 1;
    std::printf("along differences %.3g\n",
                ((right - left) / (2 * h) - dv).cwiseAbs().maxCoeff() / dv.cwiseAbs().maxCoeff());
    return 0;
}
