// SPDX-License-Identifier: GPL-2.0-or-later
/// Several stages of the pipeline at once, for tests that begin with a model and look at its end.
#pragma once

#include "advice/advise.hpp"
#include "elaborate/build_algebroid.hpp"
#include "elaborate/elaborate.hpp"
#include "elaborate/require_values.hpp"

namespace lagen {

/// A report with its hints, and rho and C as they were built.
struct ModelReport : Report {
    WrittenAlgebroid algebroid;
};

[[nodiscard]] inline ModelReport verify(const Model& model, const std::vector<NamedTree>& extra_invariants = {},
                                        const ProofBudget& budget = {})
{
    require_values(extra_invariants);
    const System system = elaborate(model);
    ModelReport report{verify(system, extra_invariants, budget), system.written.algebroid};
    advise(system, report, budget);
    return report;
}

} // namespace lagen
