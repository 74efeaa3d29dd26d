// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/table.hpp"

#include "lagen_run/text.hpp"
#include "model/plain_names.hpp"

#include <limits>

namespace lagen {

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

} // namespace lagen
