// SPDX-License-Identifier: GPL-2.0-or-later
#include "stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace lagen {

namespace {

std::mutex stages_mutex;
std::vector<const Stage*> lasting; ///< from the outside in

} // namespace

Stage::Stage(std::string what, std::size_t count) : what_(std::move(what)), count_(count)
{
    const std::lock_guard lock(stages_mutex);
    lasting.push_back(this);
}

Stage::~Stage()
{
    const std::lock_guard lock(stages_mutex);
    std::erase(lasting, this);
}

std::string Stage::text() const
{
    const std::size_t k = begun_;
    return count_ == 0 || k == 0 ? what_ : fmt::format("{}, {} of {}", what_, std::min(k, count_), count_);
}

std::string stages_text()
{
    const std::lock_guard lock(stages_mutex);
    std::string text;
    for (const Stage* stage : lasting) text += (text.empty() ? "" : ": ") + stage->text();
    return text;
}

} // namespace lagen
