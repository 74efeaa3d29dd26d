// SPDX-License-Identifier: GPL-2.0-or-later
/// A scene that is integrated in the process, over its compiled model.
#pragma once

#include "commands/scene/scene_program.hpp"

#include <functional>

namespace lagen {

/// Is this the path of a compiled model, and not that of a program?
[[nodiscard]] bool is_compiled_model(const std::string& path);

/// Integrates what `input` asks for by its method. The rows go to `rows` one after another, as the program writes them;
/// the report into `outcome`, whose state has its names. Throws MachineError where the model cannot be loaded. False
/// where an interrupt ended the run.
[[nodiscard]] bool integrate_in_process(const std::string& path, const ProgramInput& input,
                                        const std::function<void(std::string_view)>& rows, RunOutcome& outcome);

} // namespace lagen
