// SPDX-License-Identifier: GPL-2.0-or-later
/// Integrates compiled models in the process, by methods that are instantiated once. The files of this room are
/// compiled with the options that round every sum and product by itself, whatever the build says, so that rows have the
/// bits of a program that was compiled with the header (machine/compile.hpp: rounding_options).
#pragma once

#include "lagen_run/job.hpp"
#include "lagen_run/report.hpp"

#include <csignal>
#include <optional>
#include <string>

namespace lagen {

/// Kernels that a method calls of a compiled model besides its right-hand side.
struct KernelsAsked {
    bool jacobian = false, packs = false;
};

/// Is there such a method for compiled models, and what does it ask of them? Empty where there is none. `type` is the
/// runtime's, "Dop853"; methods whose structure is in types (groups, discrete motions, exact flows) are compiled with
/// their model.
[[nodiscard]] std::optional<KernelsAsked> integrates_compiled(const std::string& type);

/// The run that the job asks for, over the compiled model of this path, with a method that integrates_compiled finds.
/// The rows go to `rows`, one after another; a signal that is not zero ends the run. Answers why the model could
/// not be loaded, or nothing; std::invalid_argument where the job is that of another model. (Names of the runtime stay
/// out of here: some are those of other things in the rooms around.)
[[nodiscard]] std::string integrate_compiled(const std::string& path, const std::string& type,
                                             const detail::RunJob& job, const detail::RowTaker& rows,
                                             const volatile std::sig_atomic_t* signal, detail::RunReport& report);

} // namespace lagen
