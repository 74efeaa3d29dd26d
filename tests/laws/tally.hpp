// SPDX-License-Identifier: GPL-2.0-or-later
/// Counts by family and by mutation, printed as a table.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace lagen::laws {

/// One line of the table.
struct Count {
    std::size_t number = 0, wrong = 0, undecided = 0;
    double milliseconds = 0, slowest = 0;
    std::map<std::string, std::size_t> reasons; ///< of undecided

    void add(bool is_wrong, const std::string& reason_undecided, double time);
};

struct Tally {
    std::vector<std::string> order; ///< names in order of first use
    std::map<std::string, Count> counts;
    std::size_t discarded = 0; ///< near misses that stay valid, and models that are defined nowhere

    Count& of(const std::string& name);
    [[nodiscard]] Count total() const;
};

/// name, number, wrong, undecided, mean and longest time; then the reasons for "undecided".
[[nodiscard]] std::string table_text(const std::string& title, const Tally& tally);

} // namespace lagen::laws
