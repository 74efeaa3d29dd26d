// SPDX-License-Identifier: GPL-2.0-or-later
/// Trees as Python expressions of SymPy, which is called sp there. All is exact: what Python would compute with its own
/// numbers, as 1/2, begins with one of SymPy's.
#pragma once

#include "expression/tree_identity.hpp"

#include <map>

namespace lagen {

/// How tightly a text of Python holds together, loosest first.
enum class SympyHold { sum, product, power, atom };

class SympyWriter {
  public:
    /// `variables`: the Python names of symbols; a symbol that has none keeps its name. `model` is for messages.
    SympyWriter(std::map<std::string, std::string> variables, std::string model)
        : variables_(std::move(variables)), model_(std::move(model))
    {
    }

    /// From now on trees like this one are written as `variable`.
    void define(const Tree& tree, const std::string& variable) { definitions_.try_emplace(identity_(tree), variable); }

    /// The expression in parentheses where it holds together less than `at_least`. Throws MathematicsError where it is
    /// longer than 50000 nodes (a shared tree may be exponentially long) and for functions that SymPy lacks.
    [[nodiscard]] std::string write(const Tree& tree, SympyHold at_least = SympyHold::sum);
    /// An expression of SymPy in any case: an integer as sp.Integer(1).
    [[nodiscard]] std::string write_value(const Tree& tree);

    [[nodiscard]] const std::string& variable(const std::string& symbol) const
    {
        const auto found = variables_.find(symbol);
        return found == variables_.end() ? symbol : found->second;
    }

  private:
    struct Piece {
        std::string text;
        SympyHold hold = SympyHold::atom;
        bool plain = false; ///< made of Python's integers alone
    };

    [[nodiscard]] Piece piece(const Tree& tree);
    [[nodiscard]] Piece write_node(const Tree& tree);
    [[nodiscard]] Piece write_sum(const Tree& tree);
    [[nodiscard]] Piece write_product(const Tree& tree);
    [[nodiscard]] Piece write_operation(const Tree& tree, const char* sign, SympyHold left, SympyHold right,
                                        SympyHold hold);
    [[nodiscard]] Piece write_call(const Tree& tree);
    [[nodiscard]] Piece write_solve(const Tree& tree);
    [[nodiscard]] std::string listed(const Tree& tree, std::size_t first, std::size_t count);

    std::map<std::string, std::string> variables_;
    std::string model_;
    TreeIdentity identity_;
    std::map<std::size_t, std::string> definitions_; ///< by the identity of their trees
    std::size_t written_ = 0;                        ///< nodes of the expression
};

} // namespace lagen
