// SPDX-License-Identifier: GPL-2.0-or-later
/// A chain whose Jacobian is computed by columns, in built-in scalars and packs (scalars.hpp prints a line), and with
/// derivatives carried along: of the right-hand side, which are the Jacobian times them; of the Jacobian's product with
/// a vector u in the direction v, which is that for v in the direction u; and the kernel `variational`.
#include "scalars.hpp"

#include "chain_relative.hpp"

#include <unsupported/Eigen/AutoDiff>

namespace {

using Vector = Eigen::Matrix<double, 1, 1>;
using Carrying = Eigen::AutoDiffScalar<Vector>;
using Chain = lagen::models::chain_relative<double>;
using State = Chain::State;
using Carried = lagen::models::chain_relative<Carrying>;

/// The state with derivatives along v.
Carried::State along(const State& s, const State& v)
{
    Carried::State result;
    for (Eigen::Index k = 0; k < s.size(); ++k) result[k] = Carrying(s[k], Vector(v[k]));
    return result;
}

/// d/de of J(s + e v) u.
State second(const State& s, const State& u, const State& v)
{
    const auto J = Carried().jacobian(Carrying(0), along(s, v));
    State result = State::Zero();
    for (Eigen::Index i = 0; i < s.size(); ++i)
        for (Eigen::Index j = 0; j < s.size(); ++j)
            if (J(i, j).derivatives().size() > 0) result[i] += J(i, j).derivatives()[0] * u[j];
    return result;
}

double relative(const State& a, const State& b)
{
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

} // namespace

int main()
{
    compare_built_in<lagen::models::chain_relative>("chain_relative");
    State s, u, v;
    for (Eigen::Index k = 0; k < s.size(); ++k) {
        s[k] = start(k, 0);
        u[k] = std::cos(static_cast<double>(2 + 5 * k));
        v[k] = std::sin(static_cast<double>(1 + 3 * k));
    }
    const Chain chain;
    const State product = chain.jacobian(0, s) * v;
    Carried::State rates;
    if (Carried().rhs(Carrying(0), along(s, v), rates) != lagen::Status::ok) return 1;
    State derivative, dv;
    for (Eigen::Index k = 0; k < s.size(); ++k) derivative[k] = rates[k].derivatives()[0];
    if (chain.variational(0, s, v, dv) != lagen::Status::ok) return 1;
    std::printf("carried through %.3g\n", relative(derivative, product));
    std::printf("carried twice %.3g\n", relative(second(s, u, v), second(s, v, u)));
    std::printf("carried directional %.3g\n", relative(dv, product));
}
