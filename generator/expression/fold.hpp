// SPDX-License-Identifier: GPL-2.0-or-later
/// Values of trees from the values of their arguments.
#pragma once

#include "expression/tree.hpp"

#include <optional>
#include <unordered_map>
#include <utility>

namespace lagen {

/// Goes through a tree with a stack of its own, arguments first and from left to right, and asks for the value of each
/// part once. The values are kept, and with them the trees, for those that come later and share parts.
template <typename Value>
class Fold {
  public:
    /// `value_of(part, values)` has the values of the arguments; `known(part)` is asked first, and where it gives a
    /// value (a std::optional) the arguments are not looked at.
    template <typename ValueOf, typename Known>
    const Value& operator()(const Tree& tree, ValueOf value_of, Known known)
    {
        if (const auto found = values_.find(tree.get()); found != values_.end()) return found->second;
        kept_.push_back(tree);
        std::vector<std::pair<const Tree*, std::size_t>> open{{&tree, 0}}; // and how many arguments have their values
        std::vector<Value> values;
        while (!open.empty()) {
            auto& [part, next] = open.back();
            const TreeNode* node = part->get();
            std::optional<Value> value;
            if (!values_.contains(node)) {
                if (next == 0) value = known(*part);
                if (!value && next < node->arguments.size()) {
                    const Tree* argument = &node->arguments[next++];
                    open.emplace_back(argument, 0);
                    continue;
                }
                if (!value) {
                    values.clear();
                    for (const Tree& argument : node->arguments) values.push_back(values_.at(argument.get()));
                    value = value_of(*part, std::as_const(values));
                }
                values_.emplace(node, std::move(*value));
            }
            open.pop_back();
        }
        return values_.at(tree.get());
    }

    template <typename ValueOf>
    const Value& operator()(const Tree& tree, ValueOf value_of)
    {
        return (*this)(tree, value_of, [](const Tree&) { return std::nullopt; });
    }

  private:
    std::unordered_map<const TreeNode*, Value> values_; ///< looked up, never iterated
    std::vector<Tree> kept_;
};

} // namespace lagen
