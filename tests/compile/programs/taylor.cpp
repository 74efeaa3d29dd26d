// SPDX-License-Identifier: GPL-2.0-or-later
/// Taylor's method on generated recurrences. Prints, a line a model: its error against a reference of 31 digits in
/// double and in 50 digits, that of DOP853 in double at a tolerance of 1e-15, and the steps of both. Then how far the
/// energy walks in a million units of time.
#include "chain.hpp"
#include "double_pendulum.hpp"
#include "half_plane_control.hpp"
#include "heavy_top.hpp"
#include "kepler.hpp"
#include "relativistic_oscillator.hpp"
#include "rigid_body.hpp"
#include "walk.hpp"

#include "lagen/integrate.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <cstdio>

using Digits50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off>;

namespace {

/// The largest difference of a state from the reference, relative to the largest entry of that.
template <class State>
double distance(const State& s, const std::vector<Digits50>& reference)
{
    Digits50 difference = 0, size = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        difference = std::max(difference, Digits50(abs(Digits50(s[static_cast<int>(i)]) - reference[i])));
        size = std::max(size, Digits50(abs(reference[i])));
    }
    return static_cast<double>(difference / size);
}

std::vector<Digits50> numbers(const std::vector<const char*>& texts)
{
    std::vector<Digits50> result;
    for (const char* text : texts) result.emplace_back(text);
    return result;
}

template <template <class> class Model, class S>
auto start(const std::vector<Digits50>& initial)
{
    typename Model<S>::State s = Model<S>::State::Zero(); // at rest but for these
    for (std::size_t i = 0; i < initial.size(); ++i) s[static_cast<int>(i)] = static_cast<S>(initial[i]);
    return s;
}

/// Without a reference, the run in 50 digits is one.
template <template <class> class Model>
void compare(const char* name, const std::vector<const char*>& initial_texts, double end,
             const std::vector<const char*>& final_texts)
{
    const std::vector<Digits50> initial = numbers(initial_texts);
    const auto lazy = lagen::integrate(Model<Digits50>{}, start<Model, Digits50>(initial), {Digits50(0), Digits50(end)},
                                       lagen::Taylor{.tolerance = 1e-34});
    std::vector<Digits50> reference = numbers(final_texts);
    if (reference.empty()) reference.assign(lazy.state.data(), lazy.state.data() + lazy.state.size());
    const auto run =
        lagen::integrate(Model<double>{}, start<Model, double>(initial), {0.0, end}, lagen::Taylor{.tolerance = 1e-16});
    const auto other =
        lagen::integrate(Model<double>{}, start<Model, double>(initial), {0.0, end}, lagen::Dop853{.tolerance = 1e-15});
    std::printf("%s error %.3g %.3g %.3g %zu %zu %d\n", name, distance(run.state, reference),
                distance(lazy.state, reference), distance(other.state, reference), run.steps, other.steps,
                run && lazy ? 1 : 0);
}

/// Every lane's coefficients of orders 1 and 2 against the right-hand side and its difference along the motion.
template <class Model>
void check_slopes(const char* name, const typename Model::State& s)
{
    const Model model;
    lagen::TaylorSeries<double, Model::dimension, 6> x;
    typename Model::State ds, ahead, behind;
    bool good = model.taylor(0.25, s, 6, x) == lagen::Status::ok && model.rhs(0.25, s, ds) == lagen::Status::ok;
    double first = 0, second = 0;
    const auto at = [&](double h, typename Model::State& rate) {
        typename Model::State moved;
        for (int i = 0; i < Model::dimension; ++i) {
            double value = 0;
            for (int k = 6; k >= 0; --k) value = x[k][static_cast<std::size_t>(i)] + h * value;
            moved[i] = value;
        }
        return model.rhs(0.25 + h, moved, rate) == lagen::Status::ok;
    };
    constexpr double h = 1e-3;
    good = good && at(h, ahead) && at(-h, behind);
    for (int i = 0; i < Model::dimension; ++i) {
        const auto lane = static_cast<std::size_t>(i);
        first = std::max(first, std::abs(x[1][lane] - ds[i]));
        // s'' and the next term of the difference: (P'(h) - P'(-h)) / 2h = 2 x_2 + 4 x_4 h^2 + ..
        second = std::max(second, std::abs((ahead[i] - behind[i]) / (2 * h) - 2 * x[2][lane] - 4 * h * h * x[4][lane]));
    }
    std::printf("%s slopes %.3g %.3g %d\n", name, first, second, good ? 1 : 0);
}

} // namespace

int main()
{
    using namespace lagen::models;
    compare<double_pendulum>("double_pendulum", {"1.2", "-0.7", "0.5", "1.1"}, 5,
                             {"-0.84578640662543601246754669329645", "0.49711347473961357681112388160837",
                              "0.87109337264784027323018941365688", "4.8622194247167854790887514822155"});
    compare<kepler>("kepler", {"0.5", "0", "0", "1.5"}, 20, {});
    compare<relativistic_oscillator>("relativistic_oscillator", {"1", "0.25"}, 10, {});
    compare<half_plane_control_pontryagin>("half_plane_control", {"0.5", "1", "0.3", "0.4"}, 2, {});
    compare<heavy_top>("heavy_top", {"0", "0.6", "0.8", "0.1", "0", "5"}, 5, {});
    chain<double>::State s;
    for (int k = 0; k < chain<double>::dimension; ++k) s[k] = std::sin(1.0 + 3 * k) / 2;
    check_slopes<chain<double>>("chain", s);
    walks(1e5);
    return 0;
}
