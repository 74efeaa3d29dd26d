// SPDX-License-Identifier: GPL-2.0-or-later
/// The expansion of definitions, families, sums and arrays, behind Scope::close.
#pragma once

#include "expression/closed.hpp"
#include "expression/scope.hpp"
#include "expression/tree_identity.hpp"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

/// Everything that one set of names has expanded to: each definition once, each function once for each distinct list
/// of arguments, each body of a sum once for each distinct list of the indices in it.
class Expansion {
  public:
    /// The scope is passed at each call, since copies of a scope share one expansion.
    [[nodiscard]] Value close(const Scope& scope, const Tree& tree);

    /// The body of a definition, its parameters standing for themselves, of whatever shape.
    void check(const Scope& scope, const Definition& definition);

    /// Every entry of a value.
    [[nodiscard]] std::vector<ClosedTree> entries(const Value& value, const SourceRange& where);

    Expansion() = default;
    Expansion(const Expansion&) = delete; // a member refers to another
    Expansion& operator=(const Expansion&) = delete;

  private:
    class Closing;
    /// A definition with the numbers of its arguments.
    using Key = std::pair<std::string, std::vector<std::size_t>>;
    /// A sum or product with the numbers of what the names in its body are bound to.
    using RepetitionKey = std::pair<const TreeNode*, std::vector<std::size_t>>;

    /// The sum of a body over from..to, made of `chain` sums one inside the other; `terms` counts what it stands for.
    struct Partial {
        Value value;
        std::size_t chain = 1;
        std::size_t terms = 0;
    };
    struct Repetition {
        Tree alive;                                      ///< keeps the address of the key its own
        std::map<long, Value> terms;                     ///< the body at each index
        std::map<long, std::map<long, Partial>> results; ///< by `from`, then by `to`
    };

    /// The same number for values with the same entries.
    std::size_t number_of(Closed& value);

    Budget budget_{0, "the definitions expand to more than {} operations",
                   "a function is expanded once for each distinct list of its arguments"};
    std::map<Key, Value> expanded_;
    std::map<RepetitionKey, Repetition> repetitions_;
    TreeIdentity identity_;
    SignedIdentity signed_identity_{identity_};
    std::map<std::vector<std::size_t>, std::size_t> numbers_;
};

} // namespace lagen
