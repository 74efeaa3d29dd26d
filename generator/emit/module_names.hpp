// SPDX-License-Identifier: GPL-2.0-or-later
/// The C++ names of everything in a module, as members and inside functions.
#pragma once

#include "emit/print_body.hpp"
#include "graph/kernel.hpp"

namespace lagen {

struct ModuleNames {
    std::string class_name;
    std::vector<std::string> parameters; ///< members of Parameters
    std::vector<std::string> base;       ///< members of Base
    std::vector<std::string> fibre;      ///< members of the second group
    std::map<NodeId, std::string> guess; ///< members of Guess, by the unknown that is followed
    LocalNames locals;
    std::vector<NodeId> moving; ///< time and state lanes, and what is solved for over them
};

[[nodiscard]] ModuleNames name_module(const KernelModule& module);

} // namespace lagen
