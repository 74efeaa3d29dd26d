// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/machine/progress.hpp"

#include "commands/machine/write_file.hpp"

#include <fmt/core.h>

#include <cmath>
#include <unistd.h>

namespace lagen {

namespace {

constexpr std::chrono::milliseconds quiet{500};
constexpr std::chrono::milliseconds interval{100};

} // namespace

Progress::Progress(double start, double end)
    : start_(start), end_(end), terminal_(::isatty(STDERR_FILENO) != 0), next_(std::chrono::steady_clock::now() + quiet)
{
}

void Progress::show(double time)
{
    if (!terminal_ || !std::isfinite(time) || std::chrono::steady_clock::now() < next_) return;
    next_ = std::chrono::steady_clock::now() + interval;
    write_standard_error(fmt::format("\r{:3.0f} %  t = {:.6g}   ", 100 * (time - start_) / (end_ - start_), time));
    shown_ = true;
}

void Progress::clear()
{
    if (shown_) write_standard_error(fmt::format("\r{:40}\r", ""));
    shown_ = false;
}

} // namespace lagen
