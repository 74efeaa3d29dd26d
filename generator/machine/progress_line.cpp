// SPDX-License-Identifier: GPL-2.0-or-later
#include "machine/progress_line.hpp"

#include "machine/write_file.hpp"

#include <fmt/core.h>

#include <unistd.h>

namespace lagen {

namespace {

constexpr std::chrono::milliseconds first_pause{500}, next_pause{100};

} // namespace

ProgressLine::ProgressLine(std::optional<std::chrono::minutes> minutes)
    : terminal_(::isatty(STDERR_FILENO) != 0), minutes_(minutes), next_(std::chrono::steady_clock::now())
{
    if (terminal_)
        next_ += first_pause;
    else if (minutes_)
        next_ += *minutes_;
}

void ProgressLine::show(const std::function<std::string()>& text)
{
    const auto now = std::chrono::steady_clock::now();
    if ((!terminal_ && !minutes_) || now < next_) return;
    next_ = now;
    if (terminal_)
        next_ += next_pause;
    else
        next_ += *minutes_;
    write_standard_error(terminal_ ? fmt::format("\r{:<76}", text()) : text() + '\n');
    shown_ = terminal_;
}

void ProgressLine::clear()
{
    if (shown_) write_standard_error(fmt::format("\r{:76}\r", ""));
    shown_ = false;
}

} // namespace lagen
