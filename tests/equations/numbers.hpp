// SPDX-License-Identifier: GPL-2.0-or-later
/// Derived equations as numbers.
#pragma once

#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "typeset/equation_set.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace lagen {

using Values = std::map<std::string, double>;

/// The value of a tree, its names replaced by numbers; a name without one makes it not a number.
class Numbers {
  public:
    explicit Numbers(Values values) : values_(std::move(values)) {}

    double operator()(const Tree& tree)
    {
        const NodeId outputs[] = {lower_(tree)};
        for (const NodeId input : graph_.inputs()) values_.try_emplace(graph_.input_name(input), std::nan(""));
        return evaluate<double>(graph_, outputs, values_)[0];
    }

    double right(const Equation& equation)
    {
        double sum = 0;
        for (const TermGroup& group : equation.groups) sum += (*this)(group.value);
        return sum;
    }

    /// The largest absolute value among the groups and masses: the scale of rounding in an equation.
    double scale(const Equation& equation, const Values& rates)
    {
        double largest = 1e-3;
        for (const TermGroup& group : equation.groups) largest = std::max(largest, std::abs((*this)(group.value)));
        for (const TermGroup& mass : equation.mass)
            largest = std::max(largest, std::abs((*this)(mass.value) * rates.at(mass.label)));
        return largest;
    }

  private:
    Graph graph_;
    Lowering lower_{graph_};
    Values values_;
};

/// The block whose title begins so.
inline const EquationBlock& block_of(const EquationSet& set, const std::string& title)
{
    for (const EquationBlock& block : set.blocks)
        if (block.title.starts_with(title)) return block;
    throw std::runtime_error("no block " + title + " in the equations of " + set.model);
}

} // namespace lagen
