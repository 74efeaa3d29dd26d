// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/sweep/sweep_progress.hpp"

#include "commands/machine/write_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <unistd.h>

namespace lagen {

namespace {

using Milliseconds = std::chrono::milliseconds;

Milliseconds first_pause(bool terminal)
{
    return Milliseconds(terminal ? 500 : 60'000);
}

Milliseconds next_pause(bool terminal)
{
    return Milliseconds(terminal ? 200 : 60'000);
}

} // namespace

std::string duration_text(double seconds)
{
    constexpr double minute = 60, hour = 60 * minute, day = 24 * hour;
    const double whole = std::ceil(seconds);
    const auto two = [&](double unit, const char* name, double part, const char* part_name) {
        return fmt::format("{:.0f} {} {:.0f} {}", std::floor(whole / unit), name,
                           std::floor(std::fmod(whole, unit) / part), part_name);
    };
    if (!(whole >= minute)) return fmt::format("{:.0f} s", whole);
    if (whole < hour) return two(minute, "min", 1, "s");
    if (whole < day) return two(hour, "h", minute, "min");
    return two(day, "d", hour, "h");
}

SweepProgress::SweepProgress(std::uint64_t done, std::uint64_t rows)
    : first_(done), rows_(rows), terminal_(::isatty(STDERR_FILENO) != 0), next_(start_ + first_pause(terminal_))
{
}

void SweepProgress::show(std::uint64_t done, std::uint64_t failed)
{
    const Clock::time_point now = Clock::now();
    if (now < next_ || done == first_) return;
    next_ = now + next_pause(terminal_);
    const std::chrono::duration<double> passed = now - start_;
    const double left = passed.count() * static_cast<double>(rows_ - done) / static_cast<double>(done - first_);
    const std::string text =
        fmt::format("{:3.0f} %  {} of {} rows{}, {} left", 100 * static_cast<double>(done) / static_cast<double>(rows_),
                    done, rows_, failed == 0 ? "" : fmt::format(", {} failed", failed), duration_text(left));
    write_standard_error(terminal_ ? fmt::format("\r{:<76}", text) : text + '\n');
    shown_ = terminal_;
}

void SweepProgress::clear()
{
    if (shown_) write_standard_error(fmt::format("\r{:76}\r", ""));
    shown_ = false;
}

} // namespace lagen
