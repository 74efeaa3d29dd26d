// SPDX-License-Identifier: GPL-2.0-or-later
/// Parts of trees, each shared one looked at once.
#pragma once

#include "expression/tree.hpp"

#include <functional>
#include <iterator>
#include <unordered_set>

namespace lagen {

/// Looks at the parts of trees depth first, each before its arguments and these from left to right. A part is looked at
/// once, whatever its parents and trees; the trees must outlive the search.
class PartSearch {
  public:
    /// The first part that `is_wanted` among those not looked at before; null where there is none. `inside` gives the
    /// arguments of a part that are looked at.
    template <typename Predicate, typename Inside>
    Tree operator()(const Tree& tree, Predicate is_wanted, Inside inside)
    {
        std::vector<const Tree*> open{&tree};
        while (!open.empty()) {
            const Tree& part = *open.back();
            open.pop_back();
            if (part == nullptr || !seen_.insert(part.get()).second) continue;
            if (is_wanted(part)) return part;
            const auto& arguments = inside(part);
            for (auto each = std::rbegin(arguments); each != std::rend(arguments); ++each) open.push_back(&*each);
        }
        return nullptr;
    }

    template <typename Predicate>
    Tree operator()(const Tree& tree, Predicate is_wanted)
    {
        return (*this)(tree, is_wanted, [](const Tree& part) -> const std::vector<Tree>& { return part->arguments; });
    }

  private:
    std::unordered_set<const TreeNode*> seen_; ///< looked up, never iterated
};

/// True where one of the parts is wanted.
template <typename Predicate>
[[nodiscard]] bool any_part(const Tree& tree, Predicate is_wanted)
{
    return PartSearch()(tree, is_wanted) != nullptr;
}

/// Visits each part once, in the order of PartSearch.
template <typename Visit>
void for_each_part(const Tree& tree, Visit visit)
{
    (void)any_part(tree, [&](const Tree& part) {
        visit(part);
        return false;
    });
}

/// The first name in `trees` that `is_wanted`; null where there is none.
[[nodiscard]] Tree find_name(const std::vector<Tree>& trees, const std::function<bool(const std::string&)>& is_wanted);

} // namespace lagen
