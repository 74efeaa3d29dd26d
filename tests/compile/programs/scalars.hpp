// SPDX-License-Identifier: GPL-2.0-or-later
/// A generated header in every kind of scalar: the largest difference from 50 digits relative to 1 + size, for packs
/// the number of entries that are not those of their lane's scalar, bit for bit.
#pragma once

#include "lagen/lanes/pack.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include <cstdio>
#include <vector>

namespace mp = boost::multiprecision;
using Plain50 = mp::number<mp::cpp_bin_float<50>, mp::et_off>;
using Lazy50 = mp::number<mp::cpp_bin_float<50>, mp::et_on>;

namespace {

/// Every entry of every kernel at `s`; the caller has looked at the status.
template <class M>
std::vector<typename M::Scalar> values(const M& model, const typename M::State& s)
{
    using S = typename M::Scalar;
    std::vector<S> all;
    const S t(0.25);
    const auto append = [&](const auto& array) {
        for (Eigen::Index j = 0; j < array.cols(); ++j)
            for (Eigen::Index i = 0; i < array.rows(); ++i) all.push_back(array(i, j));
    };
    typename M::State ds = s;
    const auto status = model.rhs(t, s, ds);
    if (!lagen::StatusOf<S>::all_good(status)) std::printf("status\n");
    append(ds);
    if constexpr (requires { model.energy(t, s); }) all.push_back(model.energy(t, s));
    if constexpr (requires { model.lagrangian(t, s); }) all.push_back(model.lagrangian(t, s));
    if constexpr (requires { model.momentum(t, s); }) append(model.momentum(t, s));
    if constexpr (requires { model.mass_matrix(t, s); }) append(model.mass_matrix(t, s));
    if constexpr (requires { model.constraints(t, s); }) append(model.constraints(t, s));
    if constexpr (requires { model.domain(t, s); }) append(model.domain(t, s));
    if constexpr (requires { model.observables(t, s); }) append(model.observables(t, s));
    if constexpr (requires { model.invariants(t, s); }) append(model.invariants(t, s));
    if constexpr (requires { model.events(t, s); }) append(model.events(t, s));
    if constexpr (requires { model.jacobian(t, s); }) append(model.jacobian(t, s));
    return all;
}

/// A start that no symmetry makes special, exact in every scalar; another one for every lane.
double start(Eigen::Index k, int lane)
{
    return (5 + 3 * static_cast<double>(k)) / 16 + lane / 64.0;
}

template <template <class> class Model, class S>
std::vector<S> scalar_values(int lane = 0)
{
    Model<S> model;
    typename Model<S>::State s;
    for (Eigen::Index k = 0; k < s.size(); ++k) s[k] = S(start(k, lane));
    return values(model, s);
}

template <template <class> class Model, class S>
double difference(const std::vector<Plain50>& exact)
{
    const std::vector<S> found = scalar_values<Model, S>();
    double worst = 0;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const Plain50 error = abs(Plain50(found[k]) - exact[k]) / (1 + abs(exact[k]));
        if (!(error <= worst)) worst = static_cast<double>(error);
    }
    return found.size() == exact.size() ? worst : 1e300;
}

template <template <class> class Model, class T, int lanes>
int wrong_lanes()
{
    using P = lagen::Pack<T, lanes>;
    Model<P> model;
    typename Model<P>::State s;
    for (Eigen::Index k = 0; k < s.size(); ++k)
        for (int lane = 0; lane < lanes; ++lane) s[k].set(lane, static_cast<T>(start(k, lane)));
    const std::vector<P> found = values(model, s);
    int wrong = 0;
    for (int lane = 0; lane < lanes; ++lane) {
        const std::vector<T> alone = scalar_values<Model, T>(lane);
        for (std::size_t k = 0; k < alone.size(); ++k) wrong += found[k][lane] == alone[k] ? 0 : 1;
    }
    return wrong;
}

template <template <class> class Model>
void compare(const char* name)
{
    const std::vector<Plain50> exact = scalar_values<Model, Plain50>();
    std::printf("%s %.2g %.2g %.2g %.2g %d %d\n", name, difference<Model, float>(exact),
                difference<Model, double>(exact), difference<Model, long double>(exact),
                difference<Model, Lazy50>(exact), wrong_lanes<Model, float, 8>(), wrong_lanes<Model, double, 8>());
}

/// float and double against long double, packs against their lanes: without numbers of 50 digits, which take the
/// compiler longest.
template <template <class> class Model>
void compare_built_in(const char* name)
{
    const std::vector<long double> wide = scalar_values<Model, long double>();
    const std::vector<Plain50> exact(wide.begin(), wide.end());
    std::printf("%s %.2g %.2g %d %d\n", name, difference<Model, float>(exact), difference<Model, double>(exact),
                wrong_lanes<Model, float, 8>(), wrong_lanes<Model, double, 8>());
}

} // namespace
