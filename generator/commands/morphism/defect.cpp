// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/morphism/defect.hpp"

#include "text/diagnostic.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lagen {

namespace {

constexpr double large = 1e-3;  ///< of the size of a column
constexpr double least = 1e-12; ///< of the largest column: a column that is smaller is 0 but for rounding

/// A row by the names of its columns.
Values row_values(const Table& table, std::size_t row)
{
    Values values;
    for (std::size_t k = 0; k < table.columns.size(); ++k) values[table.columns[k]] = table.row(row)[k];
    return values;
}

void join(ColumnDefect& defect, long double given, long double image, double time)
{
    double difference = static_cast<double>(std::fabs(given - image));
    if (!std::isfinite(difference)) difference = std::numeric_limits<double>::infinity();
    if (difference <= defect.max) return;
    defect.max = difference;
    defect.time = time;
}

/// When each column first was far off, once their sizes are known.
void find_moved(RunComparison& comparison)
{
    const std::size_t count = comparison.defects.size();
    double most = 0;
    for (const ColumnDefect& defect : comparison.defects) most = std::fmax(most, defect.size);
    for (std::size_t row = 0; row < comparison.table.count(); ++row) {
        const std::span<const double> values = comparison.table.row(row);
        for (std::size_t k = 0; k < count; ++k) {
            ColumnDefect& defect = comparison.defects[k];
            const double allowed = std::fmax(large * defect.size, least * most);
            if (defect.moved || std::fabs(values[k + 1] - values[count + k + 1]) <= allowed) continue;
            defect.moved = true;
            defect.moved_at = values[0];
        }
    }
}

/// The names of the column and of its image.
std::pair<std::string, std::string> headings(const ComparedColumn& column)
{
    switch (column.kind) {
    case ComparedColumn::Kind::projected: return {column.name, "projected_" + column.name};
    case ComparedColumn::Kind::pulled: return {column.name, "pulled_" + column.name};
    case ComparedColumn::Kind::lifted: break;
    }
    return {"source_" + column.name, "lifted_" + column.name};
}

/// The column with the largest defect; null where there are no columns.
const ColumnDefect* largest_defect(const RunComparison& comparison, bool lifted)
{
    const ColumnDefect* largest = nullptr;
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.lifted == lifted && (largest == nullptr || defect.max > largest->max)) largest = &defect;
    return largest;
}

} // namespace

RunComparison compare(const Projection& projection, const Table& source, const Table& target)
{
    const std::vector<ComparedColumn>& columns = projection.columns();
    RunComparison found;
    found.table.columns = {"t"};
    for (const ComparedColumn& column : columns) {
        found.table.columns.push_back(headings(column).first);
        found.defects.push_back({column.name, column.kind == ComparedColumn::Kind::lifted});
    }
    for (const ComparedColumn& column : columns) found.table.columns.push_back(headings(column).second);
    for (std::size_t row = 0; row < std::min(source.count(), target.count()); ++row) {
        const Values here = row_values(source, row), there = row_values(target, row);
        if (here.at("t") != there.at("t")) throw InternalError("the rows of the two sides have different times");
        const std::vector<long double> images = projection(here, there);
        std::vector<double> behind;
        found.table.numbers.push_back(static_cast<double>(here.at("t")));
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const bool of_target = columns[k].kind == ComparedColumn::Kind::projected;
            const long double given = (of_target ? there : here).at(columns[k].name);
            ColumnDefect& defect = found.defects[k];
            join(defect, given, images[k], static_cast<double>(here.at("t")));
            for (const long double value : {given, images[k]})
                if (std::isfinite(value)) defect.size = std::fmax(defect.size, std::fabs(static_cast<double>(value)));
            found.table.numbers.push_back(static_cast<double>(given));
            behind.push_back(static_cast<double>(images[k]));
        }
        found.table.numbers.insert(found.table.numbers.end(), behind.begin(), behind.end());
    }
    find_moved(found);
    return found;
}

Record defect_record(const RunComparison& comparison, bool lifted)
{
    const ColumnDefect* largest = largest_defect(comparison, lifted);
    Record columns = Record::object();
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.lifted == lifted) columns[defect.name] = defect.max;
    return {{"max", largest == nullptr ? 0 : largest->max},
            {"t", largest == nullptr ? 0 : largest->time},
            {"columns", columns}};
}

std::string defect_text(const RunComparison& comparison)
{
    std::string text;
    for (const bool lifted : {false, true})
        if (const ColumnDefect* largest = largest_defect(comparison, lifted))
            text += fmt::format("defect of the {}: at most {:.3g}, of {} at t = {:.6g}, in {} rows\n",
                                lifted ? "reconstruction" : "projection", largest->max, largest->name, largest->time,
                                comparison.table.count());
    for (const ColumnDefect& defect : comparison.defects)
        if (defect.moved)
            text +=
                fmt::format("warning: {}: {} is off by {:.3g}, more than 1e-3 of its size {:.3g} from t = {:.6g} on\n",
                            defect.lifted ? "what is lifted is not the motion of the source"
                                          : "the projection of the source is not the motion of the target",
                            defect.name, defect.max, defect.size, defect.moved_at);
    return text;
}

} // namespace lagen
