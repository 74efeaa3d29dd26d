// SPDX-License-Identifier: GPL-2.0-or-later
/// The C++ names of everything in a module, as members and inside functions.
#pragma once

#include "emit/write_body.hpp"
#include "graph/kernel.hpp"

namespace lagen {

struct ModuleNames {
    std::string class_name;
    std::vector<std::string> parameters;          ///< members of Parameters
    std::vector<std::string> inputs;              ///< members of Inputs
    std::vector<std::vector<std::string>> groups; ///< members of the structs of lanes
    std::map<NodeId, std::string> guess;          ///< members of Guess, by the unknown that is followed
    LocalNames locals;
    std::vector<NodeId> moving; ///< every input but the parameters: those that change during a run
};

[[nodiscard]] ModuleNames name_module(const KernelModule& module);

/// Inputs that stand in for one another in alike terms: parameters, and the lanes of State that stand together.
[[nodiscard]] std::vector<std::vector<NodeId>> families_of(const KernelModule& module);

/// The local copy of a state that an output may overwrite while it is read.
[[nodiscard]] std::string copy_of(const KernelInput& input);

/// True where the kernel, as a function, returns its output; else it writes to references.
[[nodiscard]] bool returns_value(const Kernel& kernel);

} // namespace lagen
