// SPDX-License-Identifier: MIT
/// What a run is asked for. Nothing of it needs the model, and no name of the runtime is in here.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lagen::detail {

/// A column: state lane or entry of observables().
struct DriveColumn {
    bool observable = false;
    std::size_t index = 0;

    static void each(auto& self, auto& archive) { archive(self.observable, self.index); }
};

/// An event of the model; behind one with a jump the state jumps.
struct EventAsked {
    std::string name;
    int direction = 0; ///< 1 rising, -1 falling, 0 any
    bool stop = false;
    std::size_t count = 1; ///< which crossing ends the run

    static void each(auto& self, auto& archive) { archive(self.name, self.direction, self.stop, self.count); }
};

/// Rows are written while the run goes on, at exactly the times asked for.
struct RowsAsked {
    enum class Kind {
        count,    ///< at even times, the ends among them
        interval, ///< an interval apart from the start on, and at the end
        at,       ///< at these times, in the direction of the run
        every,    ///< at the start and behind every so many steps; the rows of a discrete motion
        event     ///< at each crossing of one of the events
    };
    Kind kind = Kind::count;
    std::size_t count = 201; ///< of `count`; of `every` the steps; of `event` its place among the events
    double interval = 0;
    std::vector<double> at;

    static void each(auto& self, auto& archive) { archive(self.kind, self.count, self.interval, self.at); }
};

struct RunJob {
    std::vector<double> parameters; ///< every one, in the order of the header; none: the defaults
    std::vector<double> initial;    ///< every state lane, base first
    double start = 0, end = 0;      ///< backwards where the end lies before the start
    double step = 0;                ///< of fixed steps: positive, whichever way the run goes
    double relative = 1e-9, absolute = 1e-9;
    std::size_t max_steps = 0; ///< 0: the runtime's
    bool from_arrow = false;   ///< of a discrete motion: the momenta are those of the arrow, whatever `initial` gives
    std::size_t branch = 0;    ///< of one that starts from momenta: its first arrow is this one of those found, or 0
    RowsAsked rows;
    std::vector<double> input_rows; ///< rows t u u ..: inputs that are held until the next row (held_inputs.hpp)
    std::vector<EventAsked> events;
    std::vector<DriveColumn> columns;

    static void each(auto& self, auto& archive)
    {
        archive(self.parameters, self.initial, self.start, self.end, self.step, self.relative, self.absolute,
                self.max_steps, self.from_arrow, self.branch, self.rows, self.input_rows, self.events, self.columns);
    }
};

/// What is the same for all trajectories of a sweep: events, columns and the kind of the rows.
struct SweepJob {
    RunJob run;
    std::size_t threads = 0; ///< 0: as many as the machine gives this process

    static void each(auto& self, auto& archive) { archive(self.run, self.threads); }
};

/// Takes the rows of a run, one after another: t, then the columns.
using RowTaker = std::function<void(std::span<const double>)>;

/// More rows than this are a mistake, not a wish.
inline constexpr double most_rows = 1e8;

/// The times of rows that are known before the run, none where they are not. Even ones are start + (end - start)
/// k/(count - 1); those an interval apart end with the end, where it is not met within 1e-9 of the interval. False
/// where there would be too many.
[[nodiscard]] inline bool plan_rows(const RowsAsked& rows, double start, double end, std::vector<double>& times)
{
    const double length = end - start;
    times.clear();
    if (rows.kind == RowsAsked::Kind::at) times = rows.at;
    if (rows.kind == RowsAsked::Kind::count) {
        if (!(static_cast<double>(rows.count) <= most_rows)) return false;
        for (std::size_t k = 0; k < rows.count; ++k)
            times.push_back(k + 1 == rows.count
                                ? end
                                : start + length * (static_cast<double>(k) / static_cast<double>(rows.count - 1)));
    }
    if (rows.kind != RowsAsked::Kind::interval) return true;
    const double pieces = std::abs(length) / rows.interval, towards = length < 0 ? -1.0 : 1.0;
    if (!(rows.interval > 0 && pieces <= most_rows)) return false;
    for (double k = 0; k <= pieces + 1e-9; ++k) times.push_back(start + towards * k * rows.interval);
    if (std::abs(times.back() - end) <= 1e-9 * rows.interval)
        times.back() = end;
    else
        times.push_back(end);
    return true;
}

} // namespace lagen::detail
