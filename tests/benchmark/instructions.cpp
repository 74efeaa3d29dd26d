// SPDX-License-Identifier: GPL-2.0-or-later
/// A run by the program of one model, whose sizes are known when it is compiled, as `lagen run` makes it: compiled by
/// scripts/instructions-table with -D MODEL=heavy_top. Its arguments are a method, its step or tolerance, the end, and
/// the lanes of the start at 0; it prints how many steps were tried.
#include "model_header.hpp"

#include MODEL_HEADER(MODEL)

#include "lagen_run/driver.hpp"

#include <cstdlib>
#include <string_view>

namespace {

using Model = lagen::models::MODEL<double>;

template <class Method>
int run(const lagen::detail::RunJob& job)
{
    lagen::detail::RunPlan<Model> plan;
    Method method{};
    if (!lagen::detail::make_plan(job, plan, method)) return 1;
    const auto no_rows = [](std::span<const double>) {};
    const auto report = lagen::detail::run_plan(plan, method, job, no_rows, &lagen::detail::drive_interrupted);
    std::printf("%zu\n", report.steps + report.rejected);
    return report.status == "ok" ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 4) return 1;
    lagen::detail::RunJob job;
    job.step = job.relative = job.absolute = std::atof(argv[2]);
    job.end = std::atof(argv[3]);
    job.rows = {.kind = lagen::detail::RowsAsked::Kind::at, .at = {job.end}};
    for (int k = 4; k < argc; ++k) job.initial.push_back(std::atof(argv[k]));
    const std::string_view method = argv[1];
    if (method == "dop853") return run<lagen::Dop853>(job);
    if (method == "taylor") return run<lagen::Taylor>(job);
    if (method == "rk4") return run<lagen::Rk4>(job);
    if (method == "gauss4") return run<lagen::Gauss4>(job);
    if (method == "radau5") return run<lagen::Radau5>(job);
    return 1;
}
