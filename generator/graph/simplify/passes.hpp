// SPDX-License-Identifier: GPL-2.0-or-later
/// What `simplify` can do: the passes in the order in which they run, and the strategies, each a choice among them.
/// A new pass is a row of the first table and its function, a new strategy a row of the second.
#pragma once

#include "graph/simplify/form.hpp"

#include <optional>
#include <string>

namespace lagen {

/// Outputs on their way through the passes: nodes until a pass reads them as polynomials, a form from then on.
struct Work {
    Graph& graph;
    std::vector<NodeId> outputs; ///< as the form was read off them
    std::optional<Form> form;    ///< of the outputs, then of the divisors of rows
};

enum class WorksOn {
    nodes,       ///< Work::outputs
    polynomials, ///< every sum and product of the form
    systems,     ///< the rows of its linear systems
};

/// The passes that a strategy may choose, as bits; the others run in every strategy.
using Choices = std::uint16_t;
enum Choice : Choices {
    in_every_strategy = 0,
    angles_added = 1,
    nested = 2,
    flattened = 4,
    monomials_expanded = 8,
    expanded = 16,
    rows_divided = 32,
    terms_shared = 64, ///< before factors are drawn out, too
    factored = 128,
};

struct Pass {
    const char* name; ///< what it has done
    WorksOn works_on;
    Choice choice;
    /// May it run, and is there anything for it to do? A strategy that chose it ends here where not. Null: always.
    bool (*guard)(const Work&);
    void (*apply)(Work&); ///< throws FormRefused where the outputs are too large for it
};

/// In the order in which they run.
[[nodiscard]] std::span<const Pass> passes();

/// In the order in which they are tried: of forms that weigh the same the first is kept.
[[nodiscard]] std::span<const Choices> strategies();

[[nodiscard]] inline bool runs(const Pass& pass, Choices strategy)
{
    return pass.choice == in_every_strategy || (pass.choice & strategy) != 0;
}

/// The passes of its choice by name: "expanded, rows divided, factors drawn out".
[[nodiscard]] std::string name_of(Choices strategy);

} // namespace lagen
