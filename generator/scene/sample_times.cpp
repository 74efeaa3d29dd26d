// SPDX-License-Identifier: GPL-2.0-or-later
/// The interval first, then the rows in it.
#include "scene/sample_times.hpp"

#include "diagnostic.hpp"

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

} // namespace

SampleTimes sample_times(const Scene& scene, const SceneValues& values, std::size_t columns, bool stretch)
{
    SampleTimes times;
    times.kind = scene.sampling.kind;
    times.interval = values.interval;
    find_end(scene, values, stretch, times);
    long double rows = 201;
    switch (times.kind) {
    case Sampling::Kind::standard: break;
    case Sampling::Kind::count: rows = static_cast<long double>(times.count = scene.sampling.count); break;
    case Sampling::Kind::interval: rows = std::floor(std::abs(times.end - times.start) / *times.interval) + 1; break;
    case Sampling::Kind::at:
        sort_rows(scene, values, times);
        rows = static_cast<long double>(times.at.size());
        break;
    }
    if (times.start == times.end && times.kind != Sampling::Kind::at) {
        times.kind = Sampling::Kind::count;
        times.count = 1;
        rows = 1;
    }
    if (rows * static_cast<long double>(columns) > most_numbers) {
        const Tree& interval = scene.sampling.interval;
        throw ModelError(fmt::format("scene '{}' asks for {:.6g} rows of {} numbers, where at most {:.6g} numbers "
                                     "are possible",
                                     scene.name, rows, columns, most_numbers),
                         interval ? interval->where : scene.where, "take fewer rows");
    }
    return times;
}

} // namespace lagen
