// SPDX-License-Identifier: GPL-2.0-or-later
/// Numbers of five headers for scripts/cross, in double and float: rates, Jacobian, Taylor coefficients, and fifty
/// steps.
///   headers           prints them
///   headers A B       how many bits two such lists have in common, at the least, of each scalar
#include "cart_pole.hpp"
#include "double_pendulum.hpp"
#include "heavy_top.hpp"
#include "kepler.hpp"
#include "snakeboard.hpp"

#include <lagen/integrate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

template <class M>
void print(const char* scalar, const char* kernel, double value)
{
    std::printf("%s %s %s %.17g\n", scalar, M::model_name, kernel, value);
}

template <class M>
void print_kernels(const char* scalar)
{
    using S = typename M::Scalar;
    M model;
    typename M::State s, ds;
    for (int i = 0; i < M::dimension; ++i) s[i] = S(0.3) + S(0.1) * S(i);
    if (model.rhs(S(0), s, ds) != lagen::Status::ok) std::printf("%s %s fails\n", scalar, M::model_name);
    for (int i = 0; i < M::dimension; ++i) print<M>(scalar, "rhs", static_cast<double>(ds[i]));
    std::array<S, M::jacobian_rows.size()> values;
    model.jacobian_values(S(0), s, values);
    for (const S value : values) print<M>(scalar, "jacobian", static_cast<double>(value));
    lagen::TaylorSeries<S, M::dimension, 6> series;
    if (model.taylor(S(0), s, 6, series) != lagen::Status::ok) std::printf("%s %s fails\n", scalar, M::model_name);
    for (int i = 0; i < M::dimension; ++i) print<M>(scalar, "taylor", static_cast<double>(series[6][i]));
    const auto run = lagen::integrate(model, s, {S(0), S(0.5)}, lagen::Rk4{.step = 0.01});
    for (int i = 0; i < M::dimension; ++i) print<M>(scalar, "rk4", static_cast<double>(run.state[i]));
}

template <class S>
void print_all(const char* scalar)
{
    using namespace lagen::models;
    print_kernels<heavy_top<S>>(scalar);
    print_kernels<double_pendulum<S>>(scalar);
    print_kernels<kepler<S>>(scalar);
    print_kernels<snakeboard<S>>(scalar);
    print_kernels<cart_pole<S>>(scalar);
}

int compare(const char* one, const char* other)
{
    std::FILE* const files[2] = {std::fopen(one, "r"), std::fopen(other, "r")};
    if (files[0] == nullptr || files[1] == nullptr) return 1;
    double bits[2] = {24, 53};
    int count = 0;
    char scalar[2][16], names[2][2][64];
    for (double a = 0, b = 0; std::fscanf(files[0], "%15s %63s %63s %lf", scalar[0], names[0][0], names[0][1], &a) == 4;
         ++count) {
        if (std::fscanf(files[1], "%15s %63s %63s %lf", scalar[1], names[1][0], names[1][1], &b) != 4) return 1;
        if (std::strcmp(names[0][0], names[1][0]) != 0 || std::strcmp(names[0][1], names[1][1]) != 0) return 1;
        const double off = std::fabs(a - b) / std::max({std::fabs(a), std::fabs(b), 1.0});
        double& least = bits[std::strcmp(scalar[0], "double") == 0];
        if (!(off <= 0)) least = std::min(least, -std::log2(off));
    }
    std::printf("%d numbers: double to %.1f bits, float to %.1f\n", count, bits[1], bits[0]);
    return count > 100 && bits[1] > 45 && bits[0] > 17 ? 0 : 1;
}

} // namespace

int main(int count, char** words)
{
    if (count == 3) return compare(words[1], words[2]);
    print_all<double>("double");
    print_all<float>("float");
    return 0;
}
