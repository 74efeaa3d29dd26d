// SPDX-License-Identifier: GPL-2.0-or-later
/// Trajectories a second on one core: `integrate`, and 4, 8 and, of float, 16 of them on the lanes of packs
/// (lagen/lanes/abreast.hpp), in float and double, by adaptive methods and with a fixed step. Compiled by
/// scripts/lanes-table with -D MODEL=heavy_top; the header has the kernel `taylor`. Prints a line a method and scalar:
/// thousands of trajectories a second at 1, 4, 8 and 16 lanes, the least time of interleaved rounds, the ratios, and
/// how many lanes' runs differ in a bit from those of `integrate`. An argument "double taylor" measures this alone.
#include "model_header.hpp"

#include MODEL_HEADER(MODEL)

#include "lagen/integrate.hpp"
#include "lagen/lanes/abreast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <string_view>
#include <vector>

namespace {

template <class S>
using Model = lagen::models::MODEL<S>;

struct Nobody {};

constexpr std::size_t count = 256;

/// Starts near each other, from which steps differ, and the end.
template <class S>
double make_starts(std::vector<typename Model<S>::State>& starts)
{
    const std::string_view name = TEXT_OF(MODEL);
    for (std::size_t k = 0; k < count; ++k) {
        const S x = S(1e-3) * S(k);
        typename Model<S>::State s = Model<S>::State::Zero();
        if (name == "heavy_top") {
            s[0] = std::sin(S(0.3) + x);
            s[2] = std::cos(S(0.3) + x);
            s[3] = S(0.1);
            s[4] = S(0.2);
            s[5] = S(3) + x;
        } else if (name == "double_pendulum") {
            s[0] = S(1) + x;
            s[1] = S(0.5);
            s[3] = S(1);
        } else {
            s[0] = S(1);
            s[3] = S(1) + S(0.5) * x;
        }
        starts.push_back(s);
    }
    return name == "heavy_top" ? 20 : (name == "double_pendulum" ? 10 : 62.83185307179586);
}

/// Of the processor: other programs do not count.
template <class Work>
double seconds_of(const Work& work)
{
    const std::clock_t begin = std::clock();
    work();
    return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

template <int N, class M, class Method>
void abreast(const std::vector<typename M::State>& starts, double end, const Method& method,
             std::vector<lagen::Run<M>>& runs)
{
    using Given = lagen::detail::Trajectory<M, Method, Nobody>;
    using Real = typename M::Scalar;
    const M model;
    const lagen::Options<M> options;
    Nobody nobody;
    Given given;
    std::array<std::size_t, std::size_t(N)> places{};
    std::size_t next = 0;
    lagen::detail::Abreast<M, Method, N, Nobody>().run(
        [&](int lane) -> const Given* {
            if (next == starts.size()) return nullptr;
            places[std::size_t(lane)] = next;
            given = {&model, &starts[next++], {Real(0), Real(end)}, &method, &options, &nobody};
            return &given;
        },
        [&](int lane, lagen::Run<M>&& run) { runs[places[std::size_t(lane)]] = std::move(run); });
}

std::string_view only; ///< "double taylor": this alone is measured

template <class S, class Method>
void measure(const char* scalar, const char* name, const Method& method)
{
    if (!only.empty() && only != std::string(scalar) + ' ' + name) return;
    using M = Model<S>;
    std::vector<typename M::State> starts;
    const double end = make_starts<S>(starts);
    std::vector<lagen::Run<M>> alone(count), together(count);
    std::array<double, 4> least{1e30, 1e30, 1e30, 1e30};
    std::size_t different = 0, steps = 0;
    const auto compare = [&] {
        for (std::size_t k = 0; k < count; ++k)
            if (std::memcmp(alone[k].state.data(), together[k].state.data(), sizeof(typename M::State)) != 0 ||
                alone[k].steps != together[k].steps)
                ++different;
    };
    for (int round = 0; round < 7; ++round) {
        const M model;
        least[0] = std::min(least[0], seconds_of([&] {
                                for (std::size_t k = 0; k < count; ++k)
                                    alone[k] = lagen::integrate(model, starts[k], {S(0), S(end)}, method);
                            }));
        least[1] = std::min(least[1], seconds_of([&] { abreast<4>(starts, end, method, together); }));
        compare();
        least[2] = std::min(least[2], seconds_of([&] { abreast<8>(starts, end, method, together); }));
        compare();
        if constexpr (std::is_same_v<S, float>) {
            least[3] = std::min(least[3], seconds_of([&] { abreast<16>(starts, end, method, together); }));
            compare();
        }
    }
    for (const auto& run : alone) steps += run.steps + run.rejected;
    std::printf("%-16s %-7s %-9s", TEXT_OF(MODEL), scalar, name);
    for (const double seconds : least)
        seconds < 1e30 ? std::printf(" %8.2f", double(count) / seconds / 1e3) : std::printf("%9s", "-");
    for (const double seconds : {least[1], least[2], least[3]})
        seconds < 1e30 ? std::printf(" %5.2f", least[0] / seconds) : std::printf("%6s", "-");
    std::printf(" %9.2f %8.1f %9zu\n", 1e6 * least[2] / double(count), double(steps) / double(count), different);
    std::fflush(stdout);
}

template <class S>
void measure_all(const char* scalar)
{
    const double tolerance = std::is_same_v<S, float> ? 1e-5 : 1e-10;
    measure<S>(scalar, "rk4", lagen::Rk4{.step = 0.01});
    measure<S>(scalar, "dopri5", lagen::Dopri5{.tolerance = tolerance});
    measure<S>(scalar, "dop853", lagen::Dop853{.tolerance = tolerance});
    const double finest = std::is_same_v<S, float> ? 1e-6 : 2.2e-16;
    measure<S>(scalar, "taylor", lagen::Taylor{.tolerance = finest});
    if (std::is_same_v<S, double>) measure<S>(scalar, "taylor 20", lagen::Taylor{.tolerance = finest, .order = 20});
}

} // namespace

int main(int argc, char** argv)
{
    if (argc > 1) only = argv[1];
    measure_all<double>("double");
    measure_all<float>("float");
}
