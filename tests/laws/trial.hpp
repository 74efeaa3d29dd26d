// SPDX-License-Identifier: GPL-2.0-or-later
/// One random algebroid and one near miss of it, judged and counted.
#pragma once

#include "families.hpp"
#include "tally.hpp"

namespace lagen::laws {

/// What went wrong, with the model that anybody can check again.
struct Failure {
    std::string name; ///< a file name: number, family, what
    std::string text; ///< the model file, the complaint as a comment on top
};

struct Trials {
    Tally valid;       ///< by family
    Tally near_misses; ///< by family
    Tally by_mutation;
    Tally own_kind;                 ///< the notation of the kind itself
    std::vector<Failure> failures;  ///< wrong verdicts, exceptions, false witnesses
    std::vector<Failure> undecided; ///< and those above 5 s
};

/// Trial `number` with its own seed: family number modulo the number of families.
void run_trial(std::size_t number, Trials& trials);

} // namespace lagen::laws
