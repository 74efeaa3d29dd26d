// SPDX-License-Identifier: GPL-2.0-or-later
#include "text/activity.hpp"

#include "text/comma_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace lagen {

namespace {

std::mutex activities_mutex;
std::vector<const Activity*> lasting; ///< from the outside in

} // namespace

Activity::Activity(std::string what, std::size_t count) : what_(std::move(what)), count_(count)
{
    const std::lock_guard lock(activities_mutex);
    lasting.push_back(this);
}

Activity::~Activity()
{
    const std::lock_guard lock(activities_mutex);
    std::erase(lasting, this);
}

std::string Activity::text() const
{
    const std::size_t k = begun_;
    return count_ == 0 || k == 0 ? what_ : fmt::format("{}, {} of {}", what_, std::min(k, count_), count_);
}

std::string activities_text()
{
    const std::lock_guard lock(activities_mutex);
    return comma_list(lasting, &Activity::text, ": ");
}

} // namespace lagen
