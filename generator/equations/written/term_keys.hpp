// SPDX-License-Identifier: GPL-2.0-or-later
/// Texts by which terms are compared that are equal but written otherwise: (x - y)^2 and (y - x)^2.
#pragma once

#include "symbolic/ginac_door.hpp"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace lagen {

using Keys = std::multiset<std::string>;

class TermKeys {
  public:
    /// One text for each term of the expression, expanded, its sums over indices written out. Nothing where the
    /// expression has no value, as m/(x - x), of what GiNaC does not take, and when much has been asked already.
    std::optional<Keys> of(const Tree& tree);

    /// Characters of all terms that were expanded, a measure of the time.
    [[nodiscard]] std::size_t expanded() const { return expanded_; }

  private:
    bool append(const Tree& tree, bool negative, Keys& keys);
    const std::vector<std::string>& keys_of(const Tree& term);

    SymbolTable symbols_;
    std::map<std::string, std::vector<std::string>> known_;
    std::size_t expanded_ = 0; ///< characters
};

} // namespace lagen
