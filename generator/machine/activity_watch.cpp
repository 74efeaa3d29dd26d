// SPDX-License-Identifier: GPL-2.0-or-later
/// A thread that wakes now and then: a single decision may take minutes, in which nobody else could write.
#include "machine/activity_watch.hpp"

#include "text/activity.hpp"
#include "text/alphabet.hpp"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <thread>
#include <unistd.h>

namespace lagen {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds before_shown{2000}, between_looks{200};
constexpr std::size_t line_width = 78;

std::mutex line_mutex;
bool line_is_shown = false;
std::mutex watch_mutex;
std::condition_variable watch_ends;
bool watching = false;
std::thread watcher;

/// Nobody waits for what does not reach a terminal.
void write_line(const std::string& text)
{
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void show_line(const std::string& text, Clock::duration lasting)
{
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(lasting).count();
    const std::string shown = whole_characters(fmt::format("{} s  {}", seconds, text), line_width);
    const std::lock_guard lock(line_mutex);
    write_line(fmt::format("\r{:{}}", shown, line_width));
    line_is_shown = true;
}

void watch()
{
    std::unique_lock lock(watch_mutex);
    Clock::time_point begin = Clock::now();
    while (!watch_ends.wait_for(lock, between_looks, [] { return !watching; })) {
        const std::string text = activities_text();
        if (text.empty()) begin = Clock::now();
        if (text.empty())
            wipe_activity_line();
        else if (Clock::now() - begin >= before_shown)
            show_line(text, Clock::now() - begin);
    }
    wipe_activity_line();
}

} // namespace

ActivityWatch::ActivityWatch()
{
    if (::isatty(STDERR_FILENO) == 0) return;
    watching = true;
    // Signals are for the thread that computes.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    watcher = std::thread(watch);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ActivityWatch::~ActivityWatch()
{
    if (!watcher.joinable()) return;
    {
        const std::lock_guard lock(watch_mutex);
        watching = false;
    }
    watch_ends.notify_one();
    watcher.join();
}

void wipe_activity_line()
{
    const std::lock_guard lock(line_mutex);
    if (line_is_shown) write_line(fmt::format("\r{:{}}\r", "", line_width));
    line_is_shown = false;
}

} // namespace lagen
