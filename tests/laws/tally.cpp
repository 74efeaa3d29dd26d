// SPDX-License-Identifier: GPL-2.0-or-later
/// Columns of the tables.
#include "tally.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen::laws {
namespace {

std::string line(const std::string& name, const Count& count)
{
    const double share =
        count.number == 0 ? 0 : 100.0 * static_cast<double>(count.undecided) / static_cast<double>(count.number);
    const double mean = count.number == 0 ? 0 : count.milliseconds / static_cast<double>(count.number);
    return fmt::format("{:<24}{:>8}{:>7}{:>11}{:>8.2f}%{:>10.2f}{:>10.1f}\n", name, count.number, count.wrong,
                       count.undecided, share, mean, count.slowest);
}

} // namespace

void Count::add(bool is_wrong, const std::string& reason_undecided, double time)
{
    ++number;
    wrong += is_wrong ? 1 : 0;
    milliseconds += time;
    slowest = std::max(slowest, time);
    if (reason_undecided.empty()) return;
    ++undecided;
    ++reasons[reason_undecided];
}

Count& Tally::of(const std::string& name)
{
    if (!counts.contains(name)) order.push_back(name);
    return counts[name];
}

Count Tally::total() const
{
    Count sum;
    for (const auto& [name, count] : counts) {
        sum.number += count.number;
        sum.wrong += count.wrong;
        sum.undecided += count.undecided;
        sum.milliseconds += count.milliseconds;
        sum.slowest = std::max(sum.slowest, count.slowest);
    }
    return sum;
}

std::string table_text(const std::string& title, const Tally& tally)
{
    std::string text = fmt::format("{:<24}{:>8}{:>7}{:>11}{:>9}{:>10}{:>10}\n", title, "models", "wrong", "undecided",
                                   "share", "mean ms", "max ms");
    for (const std::string& name : tally.order) text += line(name, tally.counts.at(name));
    text += line("all", tally.total());
    if (tally.discarded > 0) text += fmt::format("{} discarded\n", tally.discarded);
    for (const std::string& name : tally.order)
        for (const auto& [reason, number] : tally.counts.at(name).reasons)
            text += fmt::format("  undecided, {}: {} x {}\n", name, number, reason);
    return text;
}

} // namespace lagen::laws
