// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/table.hpp"

#include "lagen_run/text.hpp"
#include "model/plain_names.hpp"

#include <algorithm>
#include <limits>

namespace lagen {

namespace {

constexpr double lost = 1e-2; ///< of the size of the states: no digit is left

/// Steps of half the length come to the same time but for rounding.
bool is_same_time(double a, double b)
{
    return std::fabs(a - b) <= 1e-13 * std::max(std::fabs(a), std::fabs(b));
}

} // namespace

double Table::last_time() const
{
    return count() == 0 ? std::numeric_limits<double>::quiet_NaN() : row(count() - 1)[0];
}

double row_distance(std::span<const double> a, std::span<const double> b)
{
    double most = 0;
    for (std::size_t k = 1; k < a.size(); ++k)
        if (std::isfinite(a[k]) && std::isfinite(b[k])) most = std::hypot(most, a[k] - b[k]);
    return most;
}

double row_size(std::span<const double> a)
{
    return row_distance(a, std::vector<double>(a.size(), 0.0));
}

std::string to_csv(const Table& table, const std::vector<std::string>& known)
{
    std::string text;
    for (const std::string& column : plain_names(table.columns, known)) text += (text.empty() ? "" : ",") + column;
    text += "\r\n";
    for (std::size_t k = 0; k < table.count(); ++k) {
        detail::append_fields(text, table.row(k));
        text += "\r\n";
    }
    return text;
}

std::optional<StateAccuracy> accuracy_of(const Table& run, const Table& second, bool by_number)
{
    const std::size_t columns = run.columns.size();
    if (columns < 2 || second.columns.size() != columns) return std::nullopt;
    std::vector<double> distances;
    double size = 0;
    for (std::size_t k = 0; k < std::min(run.count(), second.count()); ++k) {
        if (!by_number && !is_same_time(run.row(k)[0], second.row(k)[0])) break;
        distances.push_back(row_distance(run.row(k), second.row(k)));
        size = std::max(size, row_size(second.row(k)));
    }
    if (distances.empty()) return std::nullopt;
    const double most = *std::ranges::max_element(distances);
    // One of more rows alone, and the same in both, is the start.
    if (!by_number && distances.size() == 1 && most == 0 && run.count() + second.count() > 2) return std::nullopt;
    StateAccuracy accuracy{most > 0 ? most / size : 0};
    const auto first = std::ranges::find_if(distances, [&](double each) { return each > lost * size; });
    if (first != distances.end())
        accuracy.holds_until = run.row(static_cast<std::size_t>(first - distances.begin()))[0];
    return accuracy;
}

} // namespace lagen
