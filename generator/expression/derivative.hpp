// SPDX-License-Identifier: GPL-2.0-or-later
/// Derivatives of closed trees by symbols, and what of them the expression language has: diff, grad, jacobian, Dt.
#pragma once

#include "expression/closed.hpp"
#include "expression/fold.hpp"

#include <functional>
#include <unordered_map>

namespace lagen {

/// diff(f, q), grad(f, q), jacobian(f, q) and Dt(X). They are no functions of values, and no words of the parser: a
/// function of the model that is called so is meant where there is one.
enum class Derivative { diff, grad, jacobian, rate };

struct DerivativeEntry {
    Derivative derivative;
    const char* name;
    std::size_t arity;
    const char* hint; ///< how it is written
};

/// nullptr where there is none of this name.
[[nodiscard]] const DerivativeEntry* find_derivative(std::string_view name);
[[nodiscard]] std::span<const DerivativeEntry> derivative_table();

/// The value of Dt(x) stands in the scope as a definition of this name, "x'", which no text can spell: a closed tree, 0
/// for a parameter. A symbol that has none has no rate; one whose body is null is put in later and cannot be
/// differentiated at all.
[[nodiscard]] std::string rate_name(const std::string& symbol);
[[nodiscard]] bool is_rate_name(std::string_view name);

/// d/ds of closed trees for all symbols s that are asked for, each node once. What is zero is left out, and sums and
/// products are folded as Maker folds them; each node that is walked over counts as an operation.
class Gradients {
  public:
    /// By the number of a symbol in the order of first sight.
    using Partials = std::map<std::size_t, ClosedTree>;
    /// True of names by which derivatives are asked for.
    using IsWanted = std::function<bool(const TreeNode&)>;

    Gradients(const Maker& maker, IsWanted is_wanted) : maker_(maker), is_wanted_(std::move(is_wanted)) {}

    /// Throws ModelError: a bound of expansion is exceeded; stumpff(31, z) or stumpff(32, z).
    const Partials& of(const Tree& tree);
    /// The tree with its size.
    ClosedTree measured(const Tree& tree);

    /// The symbols that were wanted, in the order of first sight.
    [[nodiscard]] const std::vector<std::string>& symbols() const { return symbols_; }

  private:
    Partials partials_of_node(const TreeNode& node, const ClosedTree& value);

    const Maker& maker_;
    IsWanted is_wanted_;
    std::vector<std::string> symbols_;
    std::unordered_map<const TreeNode*, Partials> partials_; ///< by address; looked up, never iterated
    Fold<Measure> measures_;                                 ///< keeps the addresses its own
};

/// d node / ds from the arguments of the node and their derivatives, null where they are zero; not all of them are.
[[nodiscard]] ClosedTree chain_rule(const Maker& maker, const ClosedTree& node, std::span<const ClosedTree> arguments,
                                    std::span<const ClosedTree* const> derivatives);

/// The c_k with tree = sum_k c_k symbols[k], null where they are zero; nothing where the tree is not, as it is written,
/// linear and without a constant term.
[[nodiscard]] std::optional<std::vector<Tree>> linear_coefficients(const Tree& tree,
                                                                   const std::vector<std::string>& symbols);

} // namespace lagen
