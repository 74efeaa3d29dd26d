// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/scene/branch_report.hpp"

#include <fmt/core.h>

namespace lagen {

namespace {

/// "2 arrows with these momenta are found, at distances 0.4 and 2.8"; `what` stands behind the arrows.
std::string found_text(const std::vector<double>& distances, const char* what)
{
    const std::size_t count = distances.size();
    if (count == 0) return fmt::format("no arrow {} is found", what);
    std::string text = count == 1 ? fmt::format("1 arrow {} is found, at the distance", what)
                                  : fmt::format("{} arrows {} are found, at the distances", count, what);
    for (std::size_t k = 0; k < count; ++k)
        text += fmt::format("{}{:.6g}", k == 0 ? " " : k + 1 == count ? " and " : ", ", distances[k]);
    return text;
}

/// "`--branch 1` to `--branch 4`"
std::string options_text(std::size_t count)
{
    return count == 1 ? "`--branch 1`" : fmt::format("`--branch 1` to `--branch {}`", count);
}

} // namespace

bool is_branch_missing(const RunOutcome& outcome)
{
    return outcome.branch > 0 && outcome.branches && outcome.branch > outcome.branches->size();
}

std::string missing_branch_text(const RunOutcome& outcome)
{
    return fmt::format("branch {} is not there: {}", outcome.branch,
                       found_text(*outcome.branches, "with the momenta of the start"));
}

std::string branches_text(const RunOutcome& outcome)
{
    if (succeeded(outcome.status) || is_branch_missing(outcome)) return {};
    std::string text;
    if (!outcome.others.empty())
        text += fmt::format("  {} from the arrow before\n", found_text(outcome.others, "on other branches"));
    if (!outcome.branches || outcome.branches->empty()) return text;
    const std::size_t count = outcome.branches->size();
    if (outcome.failed_at == outcome.t)
        text += fmt::format("  {}: {}\n", found_text(*outcome.branches, "on other branches"), options_text(count));
    else if (count > 1)
        text += fmt::format("  from the start {} branches are found: {}\n", count, options_text(count));
    return text;
}

void add_branches(Record& record, const RunOutcome& outcome)
{
    if (outcome.branches) record["branches"] = *outcome.branches;
    add_unless_empty(record, "other_branches", outcome.others);
}

} // namespace lagen
