// SPDX-License-Identifier: GPL-2.0-or-later
/// What would mend a refuted model, in the words of its file.
#pragma once

#include "verify/verify.hpp"

namespace lagen {

/// Fills in `Check::hint` of the structure equations, tangency and Casimirs that were refuted. `report` is that of
/// `system`; a system that was not read from a file has no entries to change and gets no hints.
void advise(const System& system, Report& report, const ProofBudget& budget = {});

} // namespace lagen
