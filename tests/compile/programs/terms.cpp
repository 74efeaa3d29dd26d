// SPDX-License-Identifier: GPL-2.0-or-later
/// Recurrences whose alike terms are lanes of vectors, at random states. Prints, a line a model, relative to the
/// largest entry: the right-hand side in double and in float against Newton's law written out, coefficients of orders
/// up to 20 in double against long double, whose terms are taken one by one, and the defect of the long double's
/// polynomial in that law; then whether packs get the bits of their lanes.
#include "outer_solar_system.hpp"
#include "pleiades.hpp"

#include "lagen/integrate.hpp"
#include "lagen/lanes/pack.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace {

/// Accelerations of `bodies` bodies in space of `axes` dimensions; entry (i, k) of positions stands at at(i, k).
template <int bodies, int axes, class S, class At, class Masses>
void attract(const S* x, const At& at, const Masses& masses, S* a)
{
    for (int i = 0; i < bodies; ++i)
        for (int k = 0; k < axes; ++k) {
            S sum = 0;
            for (int j = 0; j < bodies; ++j) {
                if (j == i) continue;
                S square = 0;
                for (int l = 0; l < axes; ++l) square += (x[at(j, l)] - x[at(i, l)]) * (x[at(j, l)] - x[at(i, l)]);
                sum += masses[static_cast<std::size_t>(j)] * (x[at(j, k)] - x[at(i, k)]) / (square * std::sqrt(square));
            }
            a[at(i, k)] = sum;
        }
}

template <template <class> class Model, class S, class Law>
void law(const typename Model<S>::State& s, const Law& attraction, typename Model<S>::State& ds)
{
    constexpr int n = Model<S>::base_dimension;
    for (int i = 0; i < n; ++i) ds[i] = s[n + i];
    attraction(s.data(), ds.data() + n);
}

template <class To, class From>
To rounded(const From& s)
{
    return s.template cast<typename To::Scalar>();
}

template <class A, class B>
double distance(const A& a, const B& b)
{
    const auto exact = b.template cast<long double>();
    return static_cast<double>((a.template cast<long double>() - exact).cwiseAbs().maxCoeff() /
                               exact.cwiseAbs().maxCoeff());
}

template <template <class> class Model, class Law>
void check(const char* name, const Law& attraction)
{
    using Long = typename Model<long double>::State;
    using Double = typename Model<double>::State;
    using Float = typename Model<float>::State;
    using Pack = lagen::Pack<double, 4>;
    constexpr int n = Model<double>::dimension, order = 20;
    std::mt19937 dice(7);
    double errors[4] = {0, 0, 0, 0};
    bool same = true, good = true;
    for (int round = 0; round < 20; ++round) {
        Double s, ds;
        for (int i = 0; i < n; ++i) s[i] = std::uniform_real_distribution<double>(-4, 4)(dice);
        Long expected;
        law<Model, long double>(rounded<Long>(s), attraction, expected);
        good = good && Model<double>{}.rhs(0, s, ds) == lagen::Status::ok;
        errors[0] = std::max(errors[0], distance(ds.tail(n / 2), expected.tail(n / 2)));

        const Float few = rounded<Float>(s);
        Float rate;
        law<Model, long double>(rounded<Long>(few), attraction, expected);
        good = good && Model<float>{}.rhs(0, few, rate) == lagen::Status::ok;
        errors[1] = std::max(errors[1], distance(rate.tail(n / 2), expected.tail(n / 2)));

        lagen::TaylorSeries<double, n, order> x;
        lagen::TaylorSeries<long double, n, order> y;
        good = good && Model<double>{}.taylor(0, s, order, x) == lagen::Status::ok &&
               Model<long double>{}.taylor(0, rounded<Long>(s), order, y) == lagen::Status::ok;
        for (int k = 0; k <= order; ++k) {
            const Eigen::Map<const Eigen::Matrix<double, n, 1>> a(x[k].data());
            const Eigen::Map<const Eigen::Matrix<long double, n, 1>> b(y[k].data());
            errors[2] = std::max(errors[2], distance(a, b));
        }
        // A short step: the polynomial's rate against the law.
        long double longest = 1;
        for (const long double each : y[order])
            longest = std::min(longest, std::pow(1e-18L / std::abs(each), 1.0L / order));
        Long moved = Long::Zero(), slope = Long::Zero();
        for (int k = order; k >= 0; --k)
            for (int i = 0; i < n; ++i) {
                moved[i] = y[k][static_cast<std::size_t>(i)] + longest / 2 * moved[i];
                if (k > 0) slope[i] = k * y[k][static_cast<std::size_t>(i)] + longest / 2 * slope[i];
            }
        law<Model, long double>(moved, attraction, expected);
        errors[3] = std::max(errors[3], distance(slope, expected));

        typename Model<Pack>::State together, rates;
        for (int i = 0; i < n; ++i) together[i] = Pack(s[i]);
        good = good && Model<Pack>{}.rhs(Pack(0), together, rates) == lagen::StatusOf<Pack>::good();
        for (int i = 0; i < n; ++i) same = same && rates[i].lanes[3] == ds[i];
    }
    std::printf("%s terms %.3g %.3g %.3g %.3g %d %d\n", name, errors[0], errors[1], errors[2], errors[3], same ? 1 : 0,
                good ? 1 : 0);
}

} // namespace

int main()
{
    using namespace lagen::models;
    check<pleiades>("pleiades", []<class S>(const S* x, S* a) {
        const std::array<S, 7> masses{1, 2, 3, 4, 5, 6, 7};
        attract<7, 2>(
            x, [](int i, int k) { return 7 * k + i; }, masses, a);
    });
    check<outer_solar_system>("outer_solar_system", []<class S>(const S* x, S* a) {
        const outer_solar_system<S> model;
        const auto& p = model.parameters;
        const std::array<S, 6> masses{p.G * p.m_1, p.G * p.m_2, p.G * p.m_3, p.G * p.m_4, p.G * p.m_5, p.G * p.m_6};
        attract<6, 3>(
            x, [](int i, int k) { return 3 * i + k; }, masses, a);
    });
    return 0;
}
