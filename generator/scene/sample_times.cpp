// SPDX-License-Identifier: GPL-2.0-or-later
/// The interval first, then the rows in it.
#include "scene/sample_times.hpp"

#include "model/scene_form.hpp"
#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

/// The same number as the compiled scene will have it.
double held(long double value, const std::string& what, const SourceRange& where)
{
    const auto number = static_cast<double>(value);
    if (std::isfinite(number)) return number;
    throw ModelError(fmt::format("{} is {:.6g}, where at most 1.79769e+308 is possible", what, value), where);
}

void find_end(const Scene& scene, const SceneValues& values, bool stretch, SampleTimes& times)
{
    const SourceRange& where = scene.duration ? scene.duration->where : scene.where;
    const bool at = scene.sampling.kind == Sampling::Kind::at && !values.at.empty();
    if (!values.duration && !(at && stretch))
        throw ModelError(fmt::format("scene '{}' has no duration", scene.name), scene.where,
                         "give `duration`, or --t-end");
    times.start = held(values.start, fmt::format("the start of scene '{}'", scene.name), scene.where);
    times.end = times.start + values.duration.value_or(0);
    if (at && stretch) {
        const auto [first, last] = std::minmax_element(values.at.begin(), values.at.end());
        const bool backwards = times.end < times.start || (times.end == times.start && *last <= times.start);
        times.end = backwards ? std::min(times.end, *first) : std::max(times.end, *last);
    }
    times.end = held(times.end, fmt::format("the end of scene '{}'", scene.name), where);
}

void sort_rows(const Scene& scene, const SceneValues& values, SampleTimes& times)
{
    times.at = values.at;
    const bool backwards = times.end < times.start;
    std::sort(times.at.begin(), times.at.end());
    if (backwards) std::reverse(times.at.begin(), times.at.end());
    const auto [low, high] = std::minmax(times.start, times.end);
    for (std::size_t k = 0; k < values.at.size(); ++k) {
        const auto time = static_cast<double>(values.at[k]); // as the compiled scene compares it
        if (time >= static_cast<double>(low) && time <= static_cast<double>(high)) continue;
        const Tree& tree = scene.sampling.at[k];
        throw ModelError(fmt::format("a row is wanted at t = {:.17g}, outside of the run from {:.17g} to {:.17g}", time,
                                     static_cast<double>(times.start), static_cast<double>(times.end)),
                         tree->where.file ? tree->where : scene.where);
    }
}

/// A table of this size, or ModelError.
void require_possible(const Scene& scene, long double rows, std::size_t columns, const char* hint)
{
    if (rows * static_cast<long double>(columns) <= most_numbers) return;
    const Tree& interval = scene.sampling.interval;
    throw ModelError(fmt::format("scene '{}' asks for {:.6g} rows of {} numbers, where at most {:.6g} numbers are "
                                 "possible",
                                 scene.name, rows, columns, most_numbers),
                     interval ? interval->where : scene.where, hint);
}

/// `length` in steps.
std::size_t steps_in(long double length, const Scene& scene, const SceneValues& values, const char* what,
                     const Tree& tree)
{
    constexpr long double slack = 1e-9L, most = 1e15L;
    const long double count = length / *values.step, whole = std::round(count);
    if (whole >= 1 && whole <= most && std::abs(count - whole) <= slack * whole) return static_cast<std::size_t>(whole);
    throw ModelError(fmt::format("{} of scene '{}' is {:.6g}, which is no whole number of steps of length {:.6g}", what,
                                 scene.name, length, *values.step),
                     tree && tree->where.file ? tree->where : scene.where,
                     "a discrete motion has points at its steps alone");
}

std::size_t step_count(const Scene& scene, const SceneValues& values)
{
    if (values.duration) return steps_in(*values.duration, scene, values, "the duration", scene.duration);
    if (values.steps) return static_cast<std::size_t>(*values.steps);
    throw ModelError(fmt::format("scene '{}' gives neither 'steps' nor a duration", scene.name), scene.where,
                     "give `steps`, or --t-end");
}

/// Steps between two rows.
std::size_t steps_between(const Scene& scene, const SceneValues& values, std::size_t steps)
{
    switch (scene.sampling.kind) {
    case Sampling::Kind::standard: return 1;
    case Sampling::Kind::interval:
        return steps_in(*values.interval, scene, values, "'sample'", scene.sampling.interval);
    case Sampling::Kind::count:
        if (scene.sampling.count > 1 && steps % (scene.sampling.count - 1) == 0)
            return steps / (scene.sampling.count - 1);
        throw ModelError(
            fmt::format("scene '{}' asks for {} even rows of {} steps", scene.name, scene.sampling.count, steps),
            scene.where, "a discrete motion has points at its steps alone");
    case Sampling::Kind::event:
    case Sampling::Kind::at: break;
    }
    const std::vector<Tree>& at = scene.sampling.at;
    throw ModelError(fmt::format("{}: its rows are at its steps", discreteness(scene)),
                     at.empty() || !at.front()->where.file ? scene.where : at.front()->where,
                     "`sample` = a multiple of the step takes fewer of them");
}

SampleTimes step_times(const Scene& scene, const SceneValues& values, std::size_t columns)
{
    if (!values.step)
        throw ModelError(fmt::format("scene '{}' gives no value of the step", scene.name), scene.where,
                         "give `step`, or --step");
    SampleTimes times;
    const std::size_t steps = step_count(scene, values);
    times.start = held(values.start, fmt::format("the start of scene '{}'", scene.name), scene.where);
    times.end = held(times.start + static_cast<long double>(steps) * *values.step,
                     fmt::format("the end of scene '{}'", scene.name), scene.where);
    times.every = steps_between(scene, values, steps);
    require_possible(scene, static_cast<long double>(steps / times.every + 1), columns,
                     "`sample` = a multiple of the step takes fewer rows");
    return times;
}

} // namespace

SampleTimes sample_times(const Scene& scene, const SceneValues& values, std::size_t columns, bool stretch)
{
    if (values.discrete) return step_times(scene, values, columns);
    SampleTimes times;
    times.kind = scene.sampling.kind;
    times.interval = values.interval;
    times.event = scene.sampling.event;
    find_end(scene, values, stretch, times);
    long double rows = 201;
    switch (times.kind) {
    case Sampling::Kind::standard:
    case Sampling::Kind::event: break;
    case Sampling::Kind::count: rows = static_cast<long double>(times.count = scene.sampling.count); break;
    case Sampling::Kind::interval: rows = std::floor(std::abs(times.end - times.start) / *times.interval) + 1; break;
    case Sampling::Kind::at:
        sort_rows(scene, values, times);
        rows = static_cast<long double>(times.at.size());
        break;
    }
    const bool given = times.kind == Sampling::Kind::at || times.kind == Sampling::Kind::event;
    if (times.start == times.end && !given) {
        times.kind = Sampling::Kind::count;
        times.count = 1;
        rows = 1;
    }
    require_possible(scene, rows, columns, "take fewer rows");
    return times;
}

} // namespace lagen
