// SPDX-License-Identifier: GPL-2.0-or-later
/// Splittings of more than two parts with exact flows: the heavy top, a kick and three rotations.
#include "convergence/order_of_ends.hpp"
#include "lagen/integrate.hpp"
#include "support/tolerances.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <catch2/catch.hpp>

#include <algorithm>

namespace splitting = lagen::splitting;

namespace {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Quad = boost::multiprecision::cpp_bin_float_quad;

/// H = V(g, t) + p_i^2/(2 I_i), V = (1 + clocked sin(3 t)) e.g, on so(3) acting on the plumb line g.
template <class S>
struct Top {
    using Scalar = S;
    using State = Eigen::Matrix<S, 6, 1>;
    static constexpr int dimension = 6, base_dimension = 3, fibre_dimension = 3, flows = 4;
    S clocked = S(0);
    std::array<S, 3> inertia{S(1.25), S(2), S(3)}, e{S(0.75), S(1), S(1.25)};

    [[nodiscard]] State torque(const S& t, const State& s) const
    {
        using std::sin;
        const S mgl = S(1) + clocked * sin(S(3) * t);
        State rate = State::Zero();
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            rate[3 + i] = mgl * (s[j] * e[std::size_t(k)] - s[k] * e[std::size_t(j)]);
        }
        return rate;
    }

    lagen::Status rhs(S t, const State& s, State& ds) const noexcept
    {
        State rate = torque(t, s);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            const S wj = s[3 + j] / inertia[std::size_t(j)], wk = s[3 + k] / inertia[std::size_t(k)];
            rate[i] = s[j] * wk - s[k] * wj;
            rate[3 + i] += s[3 + j] * wk - s[3 + k] * wj;
        }
        ds = rate;
        return lagen::Status::ok;
    }

    template <int part>
    lagen::Status flow(S t, const State& s, S h, State& ds) const noexcept
    {
        using std::cos, std::sin;
        if constexpr (part == 0) {
            ds = h * torque(t, s);
        } else {
            constexpr int i = part - 1, j = (i + 1) % 3, k = (i + 2) % 3;
            const S half = h * s[3 + i] / inertia[std::size_t(i)] / S(2);
            const S across = S(2) * sin(half) * cos(half), along = S(-2) * sin(half) * sin(half);
            ds.setZero();
            for (const int o : {0, 3}) {
                ds[o + j] = across * s[o + k] + along * s[o + j];
                ds[o + k] = along * s[o + k] - across * s[o + j];
            }
        }
        return lagen::Status::ok;
    }

    [[nodiscard]] static State start() { return {S(0.5), S(0), S(0.75), S(1), S(-0.75), S(1.5)}; }
    [[nodiscard]] S energy(const State& s) const
    {
        S sum = S(0);
        for (int i = 0; i < 3; ++i)
            sum += s[i] * e[std::size_t(i)] + s[3 + i] * s[3 + i] / inertia[std::size_t(i)] / S(2);
        return sum;
    }
};

/// Of the end at t = 4, against that of a quarter of the shortest step; inside a step where `at` is given.
template <class Method>
double order_of(int coarsest, Quad clocked)
{
    const Top<Quad> top{.clocked = clocked};
    const auto end = [&](int steps) {
        const auto run = lagen::integrate(top, Top<Quad>::start(), {Quad(0), Quad(4)}, Method{.step = 4.0 / steps});
        REQUIRE(run.status() == lagen::Status::ok);
        return run.state;
    };
    return lagen::testing::order_of_ends(end, coarsest, 3);
}

using lagen::testing::near;

/// The step as exponentials of its parts, in their order: part and time.
template <class Splitting>
std::vector<std::pair<unsigned, Wide>> exponentials(unsigned parts)
{
    constexpr auto sweeps = splitting::times_of_sweeps<Splitting>();
    std::vector<std::pair<unsigned, Wide>> list;
    for (std::size_t k = 0; k < Splitting::weights.size(); ++k) {
        const bool first = k % 2 == 0;
        list.emplace_back(first ? 0 : parts - 1, Splitting::weights[k].template as<Wide>());
        if (k == sweeps.size()) break;
        for (unsigned inner = 1; inner + 1 < parts; ++inner)
            list.emplace_back(first ? inner : parts - 1 - inner, sweeps[k].template as<Wide>());
    }
    return list;
}

/// The largest difference to exp(A + B + C + ..) over all words of this length in `parts` letters.
template <class Splitting>
Wide worst_word(unsigned parts, unsigned length)
{
    const auto step = exponentials<Splitting>(parts);
    Wide exact = 1, worst = 0;
    std::size_t words = 1;
    for (unsigned k = 1; k <= length; ++k) exact /= Wide(k), words *= parts;
    for (std::size_t number = 0; number < words; ++number) {
        std::vector<unsigned> word;
        for (std::size_t k = 0, rest = number; k < length; ++k, rest /= parts)
            word.push_back(static_cast<unsigned>(rest % parts));
        std::vector<Wide> sums(length + 1, Wide(0));
        sums[0] = 1;
        for (const auto& [part, time] : step)
            for (unsigned end = length; end > 0; --end) {
                Wide term = 1;
                for (unsigned start = end; start-- > 0 && word[start] == part;) {
                    term *= time / Wide(end - start);
                    sums[end] += sums[start] * term;
                }
            }
        worst = std::max<Wide>(worst, abs(sums[length] - exact));
    }
    return worst;
}

template <class Splitting>
void check_words()
{
    constexpr auto order = static_cast<unsigned>(Splitting::order);
    for (unsigned length = 1; length <= order; ++length) CHECK(worst_word<Splitting>(3, length) < 1e-31);
    CHECK(worst_word<Splitting>(3, order + 1) > 1e-8);
}

} // namespace

TEST_CASE("Splittings satisfy the conditions of every word of three parts up to their order")
{
    check_words<splitting::LeapfrogDkd>();
    check_words<splitting::LeapfrogKdk>();
    check_words<splitting::BlanesMoan4>();
    check_words<splitting::Srkn4>();
    check_words<splitting::Yoshida6>();
    check_words<splitting::BlanesMoan6>();
    CHECK(worst_word<splitting::KahanLi8>(3, 6) < 1e-31);
    CHECK(worst_word<splitting::Sofroniou10>(4, 4) < 1e-31);
}

TEST_CASE("Splittings of four parts have their order on the heavy top")
{
    CHECK_THAT((order_of<lagen::LeapfrogKdk>(128, 0)), near(2));
    CHECK_THAT((order_of<lagen::LeapfrogDkd>(128, 0)), near(2));
    CHECK_THAT((order_of<lagen::BlanesMoan4>(32, 0)), near(4));
    CHECK_THAT((order_of<lagen::Srkn4>(32, 0)), near(4));
    CHECK_THAT((order_of<lagen::Yoshida6>(64, 0)), near(6));
    CHECK_THAT((order_of<lagen::BlanesMoan6>(32, 0)), near(6));
    CHECK_THAT((order_of<lagen::KahanLi8>(32, 0)), near(8));
    CHECK_THAT((order_of<lagen::Sofroniou10>(16, 0)), near(10));
}

TEST_CASE("Splittings of four parts have their order where the potential depends on time")
{
    CHECK_THAT((order_of<lagen::LeapfrogKdk>(128, 0.5)), near(2));
    CHECK_THAT((order_of<lagen::BlanesMoan4>(64, 0.5)), near(4));
    CHECK_THAT((order_of<lagen::BlanesMoan6>(64, 0.5)), near(6));
    CHECK_THAT((order_of<lagen::KahanLi8>(64, 0.5)), near(8));
}

TEST_CASE("Splittings of Nystrom's kind refuse flows")
{
    for (const auto status :
         {lagen::integrate(Top<double>{}, Top<double>::start(), {0.0, 1.0}, lagen::McLachlan4{.step = 0.1}).status(),
          lagen::integrate(Top<double>{}, Top<double>::start(), {0.0, 1.0}, lagen::Srkn6{.step = 0.1}).status()})
        CHECK(status == lagen::Status::not_separable);
}

TEST_CASE("A step back undoes a step to rounding, and dense values are shorter steps")
{
    const Top<double> top{.clocked = 0.5};
    const auto there = lagen::integrate(top, Top<double>::start(), {0.0, 8.0}, lagen::BlanesMoan6{.step = 0.125});
    const auto back = lagen::integrate(top, there.state, {8.0, 0.0}, lagen::BlanesMoan6{.step = 0.125});
    CHECK((back.state - Top<double>::start()).norm() < 1e-13);
    CHECK((there.state - Top<double>::start()).norm() > 0.1);
    lagen::Integrator integrator(top, Top<double>::start(), 0.0, lagen::KahanLi8{.step = 0.25});
    REQUIRE(integrator.step() == lagen::Status::ok);
    const auto inside = lagen::integrate(top, Top<double>::start(), {0.0, 0.125}, lagen::KahanLi8{.step = 0.125});
    CHECK((integrator.at(0.125) - inside.state).norm() < 1e-14);
}

// In double, the Casimirs g.g and g.p are kept by each rotation and by the kick; no step projects anything.
TEST_CASE("A million steps keep the Casimirs of a heavy top to a walk of roundings, and its energy without drift")
{
    constexpr std::size_t most = 1'000'000;
    const Top<double> top;
    const auto begin = Top<double>::start();
    const auto casimirs = [](const Top<double>::State& s) {
        const Eigen::Matrix<long double, 3, 1> g = s.head<3>().cast<long double>(), p = s.tail<3>().cast<long double>();
        return std::pair(g.dot(g), g.dot(p));
    };
    const auto start = casimirs(begin);
    long double walk = 0;
    double early = 0, late = 0;
    std::size_t step = 0;
    const auto watch = [&](double, const Top<double>::State& s) {
        const double error = std::abs(top.energy(s) - top.energy(begin));
        (step < most / 10 ? early : late) = std::max(step < most / 10 ? early : late, error);
        if (++step % 1000 != 0) return;
        const auto [now, area_now] = casimirs(s);
        walk = std::max({walk, std::abs(now - start.first), std::abs(area_now - start.second)});
    };
    const auto run = lagen::integrate(top, begin, {0.0, 0.1 * most}, lagen::LeapfrogKdk{.step = 0.1}, {}, watch);
    CHECK(run.status() == lagen::Status::ok);
    CHECK(run.steps == most);
    CHECK(static_cast<double>(walk) < 1e-13); // 0.2 epsilon a root of steps would be 5e-14
    CHECK(early > 1e-4);
    CHECK(late < 1.05 * early);
}
