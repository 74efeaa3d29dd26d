// SPDX-License-Identifier: GPL-2.0-or-later
/// From when to when a run goes and where its rows are, bounded and in the direction of time.
#pragma once

#include "scene/evaluate_scene.hpp"

namespace lagen {

/// More numbers than this in one table (about 0.5 GB of text) are a mistake, not a wish.
inline constexpr long double most_numbers = 2e7L;

struct SampleTimes {
    long double start = 0, end = 0;
    Sampling::Kind kind = Sampling::Kind::standard;
    std::size_t count = 201;             ///< of `standard` and `count`
    std::optional<long double> interval; ///< of `interval`
    std::vector<long double> at;         ///< of `at`, sorted in the direction of time
    std::string event;                   ///< of `event`: at each of its crossings
    std::size_t every = 0;               ///< of a discrete motion: the steps between two rows
};

/// `columns` counts t too. A run goes backwards where its end lies before its start; one of no length has one row.
/// Where `stretch` and the times of `at` go beyond the end, the end moves there (without a duration too). Throws
/// ModelError: no duration, a number that no double holds, a row outside of the run, a table above `most_numbers`.
/// Of a discrete motion the end is that of its last step, and rows are at steps: every one where the scene says
/// nothing; a duration or a time of rows that is no whole number of steps is a ModelError.
[[nodiscard]] SampleTimes sample_times(const Scene& scene, const SceneValues& values, std::size_t columns,
                                       bool stretch);

} // namespace lagen
