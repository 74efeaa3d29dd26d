// SPDX-License-Identifier: GPL-2.0-or-later
/// Points on the constraint set: each constraint h(v) = a v^k + b v + c is solved for its coordinate, from its values
/// at v = 0, 1 and -1; exactly where the root is rational, else in ball arithmetic.
#include "proof/sample.hpp"

namespace lagen::proof {

namespace {

bool rational_root(const Rational& radicand, unsigned degree, Rational& root)
{
    if (sgn(radicand) < 0 && degree % 2 == 0) return false;
    mpz_class above, below;
    const bool exact = mpz_root(above.get_mpz_t(), radicand.get_num_mpz_t(), degree) != 0 &&
                       mpz_root(below.get_mpz_t(), radicand.get_den_mpz_t(), degree) != 0;
    root = exact ? Rational(above, below) : Rational(0);
    return exact;
}

/// x^(1/degree), of either sign for odd degrees.
void real_root(arb_ptr z, arb_srcptr x, unsigned degree, slong precision)
{
    if (degree % 2 == 1 && arb_is_negative(x) != 0) {
        arb_neg(z, x);
        arb_root_ui(z, z, degree, precision);
        arb_neg(z, z);
    } else {
        arb_root_ui(z, x, degree, precision);
    }
}

} // namespace

std::optional<Rational> Sampler::solve_exactly(std::size_t k, const ExactInputs& inputs, bool upper) const
{
    const SolvedConstraint& solved = constraints_[k];
    ExactInputs all = inputs;
    Rational values[3]; // of h at 0, 1, -1
    const int places[3] = {0, 1, -1};
    for (int j = 0; j < 3; ++j) {
        all[solved.variable] = places[j];
        const auto value = equations_[k].exactly(all);
        if (!value) return std::nullopt;
        values[j] = (*value)[0];
    }
    Rational root;
    if (solved.pure) {
        const Rational leading = values[1] - values[0];
        if (sgn(leading) == 0 || !rational_root(-values[0] / leading, solved.degree, root)) return std::nullopt;
        return solved.degree % 2 == 0 && !upper ? Rational(-root) : root;
    }
    const Rational a = (values[1] + values[2]) / 2 - values[0], b = (values[1] - values[2]) / 2;
    if (sgn(a) == 0 || !rational_root(b * b - 4 * a * values[0], 2, root)) return std::nullopt;
    if (!upper) root = -root;
    return Rational((root - b) / (2 * a));
}

Ball Sampler::enclose_root(std::size_t k, BallInputs& inputs, bool upper, slong precision) const
{
    const SolvedConstraint& solved = constraints_[k];
    std::vector<Ball> values; // of h at 0, 1, -1
    for (const int place : {0, 1, -1}) {
        inputs[solved.variable] = Ball(Rational(place), precision);
        values.push_back(equations_[k].enclose(inputs, precision)[0]);
    }
    Ball a, b, root;
    if (solved.pure) {
        arb_sub(a.get(), values[1].get(), values[0].get(), precision);
        arb_div(a.get(), values[0].get(), a.get(), precision);
        arb_neg(a.get(), a.get());
        real_root(root.get(), a.get(), solved.degree, precision);
        if (solved.degree % 2 == 0 && !upper) arb_neg(root.get(), root.get());
        return root;
    }
    arb_add(a.get(), values[1].get(), values[2].get(), precision);
    arb_mul_2exp_si(a.get(), a.get(), -1);
    arb_sub(a.get(), a.get(), values[0].get(), precision);
    arb_sub(b.get(), values[1].get(), values[2].get(), precision);
    arb_mul_2exp_si(b.get(), b.get(), -1);
    Ball discriminant, product;
    arb_mul(discriminant.get(), b.get(), b.get(), precision);
    arb_mul(product.get(), a.get(), values[0].get(), precision);
    arb_mul_2exp_si(product.get(), product.get(), 2);
    arb_sub(discriminant.get(), discriminant.get(), product.get(), precision);
    arb_sqrt(root.get(), discriminant.get(), precision);
    if (!upper) arb_neg(root.get(), root.get());
    arb_sub(root.get(), root.get(), b.get(), precision);
    arb_mul_2exp_si(a.get(), a.get(), 1);
    arb_div(root.get(), root.get(), a.get(), precision);
    return root;
}

BallInputs Sampler::enclosures(const SamplePoint& point, const std::vector<NodeId>& more, slong precision) const
{
    BallInputs inputs;
    for (const auto& [input, value] : exact_values(point, more)) inputs[input] = Ball(value, precision);
    for (std::size_t k = 0; k < constraints_.size(); ++k) {
        const NodeId variable = constraints_[k].variable;
        if (point.exact.count(variable) > 0) continue;
        const Ball root = enclose_root(k, inputs, point.upper[k], precision);
        inputs[variable] = root;
    }
    return inputs;
}

} // namespace lagen::proof
