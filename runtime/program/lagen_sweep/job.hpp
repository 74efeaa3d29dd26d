// SPDX-License-Identifier: MIT
/// What a sweep is asked for. No name of the runtime is in here.
#pragma once

#include "lagen_run/job.hpp"

namespace lagen::detail {

/// What is the same for all trajectories: events, columns and the kind of the rows.
struct SweepJob {
    RunJob run;
    std::size_t threads = 0; ///< 0: as many as the machine gives this process

    static void each(auto& self, auto& archive) { archive(self.run, self.threads); }
};

} // namespace lagen::detail
