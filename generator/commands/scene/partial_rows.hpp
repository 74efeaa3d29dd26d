// SPDX-License-Identifier: GPL-2.0-or-later
/// An interrupted run leaves the rows that it has written so far.
#pragma once

#include "commands/line/options.hpp"
#include "commands/scene/table.hpp"

namespace lagen {

/// Writes the rows where the run would have written them, but for a file, which is FILE.partial: what was there before
/// stays. `known` as for to_csv, `report` is the object of JSON, `t` the
/// last time of the run, NaN where it is not known.
ExitCode leave_rows(const Options& options, const Table& rows, const std::vector<std::string>& known,
                    const std::string& report, double t);

} // namespace lagen
