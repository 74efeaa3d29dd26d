// SPDX-License-Identifier: MIT
/// What becomes of a run of many steps, by a quantity f that is looked at behind each of them: the outcomes of
/// `lagen chart --stability` (lagen_chart/stability.hpp says what they mean).
#pragma once

#include "lagen/status.hpp"
#include "lagen_chart/stability_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace lagen::chart {

inline constexpr double blown_up_from = 100; ///< times the scale
inline constexpr double swing_window = 10;   ///< times the scale: what swings farther drifts
inline constexpr double least_drift = 1e-3;  ///< times the scale, from the first third to the last
inline constexpr double drift_over_width =
    0.5; ///< a drift moves f by more than this part of its width in the first third

/// Least and largest value of a part of a run.
struct Range {
    double least = std::numeric_limits<double>::infinity(), largest = -std::numeric_limits<double>::infinity();

    void see(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    [[nodiscard]] double width() const { return largest - least; }
};

inline const char* outcome_of(Status status)
{
    switch (status) {
    case Status::ok: return "bounded";
    case Status::no_solution:
    case Status::branch_lost:
    case Status::newton_diverged: return "newton_diverged";
    case Status::non_finite:
    case Status::step_too_small:
    case Status::invalid_input: return "blown_up";
    default: return "left_domain"; // the equations have no right-hand side there, whatever the reason
    }
}

/// Whether f, which began at `from`, drifts; `moved` is how far its least or its largest value went, over the scale.
inline bool goes_away(const std::array<Range, 3>& parts, double from, double scale, double& moved)
{
    const auto& [first, middle, last] = parts;
    const double low = last.least - first.least, high = last.largest - first.largest;
    const bool upper = std::abs(high) > std::abs(low);
    moved = std::abs(upper ? high : low) / scale;
    const double half_way = upper ? middle.largest - first.largest : middle.least - first.least;
    const double other_half = (upper ? high : low) - half_way;
    const bool steadily = half_way * other_half >= 0; // what swings slowly turns back
    const auto is_drift = [&](double distance, double width) {
        return distance > least_drift * scale && distance > drift_over_width * width;
    };
    const double away = std::max({0.0, last.least - from, from - last.largest}); // f never comes back to its start
    return (steadily && is_drift(moved * scale, std::min(first.width(), last.width()))) || is_drift(away, last.width());
}

/// A run as it goes on.
class FateWatch {
  public:
    /// f begins at `from`; `conserved`: it should stay there.
    FateWatch(double from, double scale, double length, bool conserved)
        : from_(from), scale_(scale), third_(std::abs(length) / 3), conserved_(conserved)
    {
        parts_[0].see(from);
    }

    /// f behind the time `passed`; false where the run has blown up.
    [[nodiscard]] bool see(double f, double passed)
    {
        const double error = std::abs(f - from_) / scale_;
        if (error > fate_.error) fate_.error = error;
        if (!(error <= blown_up_from)) {
            fate_.outcome = "blown_up";
            return false;
        }
        parts_[std::min<std::size_t>(2, static_cast<std::size_t>(passed / third_))].see(f);
        return true;
    }

    void stop(Status status)
    {
        fate_.status = to_text(status);
        fate_.outcome = outcome_of(status);
    }

    /// Of a run that ended at t; error and drift to six digits.
    [[nodiscard]] StabilityCell fate(double t)
    {
        fate_.t = t;
        if (fate_.outcome == "bounded" && conserved_) {
            if (fate_.error > swing_window || goes_away(parts_, from_, scale_, fate_.drift)) fate_.outcome = "drifting";
            fate_.drift /= 2 * third_;
        }
        fate_.error = six_digits(fate_.error);
        fate_.drift = six_digits(fate_.drift);
        return fate_;
    }

  private:
    static double six_digits(double x)
    {
        char text[32];
        std::snprintf(text, sizeof text, "%.6g", x);
        return std::strtod(text, nullptr);
    }

    double from_, scale_, third_;
    bool conserved_;
    StabilityCell fate_{.outcome = "bounded"};
    std::array<Range, 3> parts_;
};

} // namespace lagen::chart
