// SPDX-License-Identifier: GPL-2.0-or-later
/// Integrates compiled models in the process, by methods that are instantiated once. The files of this room are
/// compiled with the options that round every sum and product by itself, whatever the build says, so that rows have the
/// bits of a program that was compiled with the header (commands/machine/compile.hpp: rounding_options).
#pragma once

#include "lagen_run/arguments.hpp"

#include <csignal>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace lagen {

/// What a method asks of a compiled model besides its right-hand side.
struct KernelsAsked {
    bool jacobian = false, packs = false;
};

/// Is there such a method for compiled models, and what does it ask of them? Empty where there is none. `type` is the
/// runtime's, "Dop853"; methods whose structure is in types (groups, discrete motions, exact flows) are compiled with
/// their model.
[[nodiscard]] std::optional<KernelsAsked> integrates_compiled(const std::string& type);

/// What a run left besides its rows.
struct CompiledRun {
    std::string not_loaded; ///< why the model could not be loaded, as to_text(LoadStatus); empty where it was
    std::string complaint;  ///< what is wrong with what it was given; then there is no report
    std::string report;     ///< as lagen_run/driver.hpp describes it
    bool interrupted = false;
};

/// The run that `given` asks for, over the compiled model of this path, with a method that integrates_compiled
/// finds. The rows go to `rows`, one after another; a signal that is not zero ends the run. (Names of the runtime stay
/// out of here: some are those of other things in the rooms around.)
[[nodiscard]] CompiledRun integrate_compiled(const std::string& path, const std::string& type,
                                             const detail::DriveArguments& given,
                                             const std::function<void(std::string_view)>& rows,
                                             const volatile std::sig_atomic_t* signal);

} // namespace lagen
