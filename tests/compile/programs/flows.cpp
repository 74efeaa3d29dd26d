// SPDX-License-Identifier: GPL-2.0-or-later
/// Splittings on generated flows. Prints, a line a model: the distance of KahanLi8 from DOP853, of the lanes of a pack
/// from that, and of the flow for a time from two flows for halves of it.
#include "elroys_beanie.hpp"
#include "half_plane.hpp"
#include "heavy_top.hpp"

#include "lagen/lagen.hpp"

#include <cstdio>

namespace {

template <int part, class M>
double half_defect(const M& model, const typename M::State& s)
{
    typename M::State once, first, second;
    for (const auto status : {model.template flow<part>(0, s, 0.5, once), model.template flow<part>(0, s, 0.25, first),
                              model.template flow<part>(0, s + first, 0.25, second)})
        if (status != lagen::Status::ok) return 1;
    const double rest = (once - first - second).norm();
    if constexpr (part + 1 < M::flows)
        return std::max(rest, half_defect<part + 1>(model, s));
    else
        return rest;
}

template <template <class> class Model>
void compare(const char* name, const typename Model<double>::State& start)
{
    using Lanes = lagen::Pack<double, 4>;
    const auto exact = lagen::integrate(Model<double>{}, start, {0.0, 2.0}, lagen::Dop853{.tolerance = 1e-14});
    const auto split = lagen::integrate(Model<double>{}, start, {0.0, 2.0}, lagen::KahanLi8{.step = 0.0625});
    const auto lanes = lagen::integrate(Model<Lanes>{}, typename Model<Lanes>::State(start.template cast<Lanes>()),
                                        {0.0, 2.0}, lagen::KahanLi8{.step = 0.0625});
    double apart = 0;
    for (Eigen::Index k = 0; k < start.size(); ++k)
        for (int lane = 0; lane < 4; ++lane) apart = std::max(apart, std::abs(lanes.state[k][lane] - split.state[k]));
    const bool fine = exact.status() == lagen::Status::ok && split.status() == lagen::Status::ok &&
                      lanes.status() == lagen::Status::ok;
    std::printf("%s errors %.3e %.3e %.3e %d\n", name, (exact.state - split.state).norm(), apart,
                half_defect<0>(Model<double>{}, start), fine ? 1 : 0);
}

} // namespace

int main()
{
    using namespace lagen::models;
    compare<heavy_top_hamilton>("heavy_top", {0.5, 0, 0.75, 1, -0.75, 1.5});
    compare<half_plane_hamilton>("half_plane", {0.25, 1, 0.5, -0.75});
    compare<elroys_beanie_hamilton>("elroys_beanie", {0.5, 0.25, 1, 0.75, -0.5});
}
