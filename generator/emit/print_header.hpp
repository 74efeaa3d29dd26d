// SPDX-License-Identifier: GPL-2.0-or-later
/// The C++ header of a kernel module: scalar-generic, allocation-free, documented, the same bytes on every machine.
#pragma once

#include "graph/kernel.hpp"

namespace lagen {

[[nodiscard]] std::string print_header(const KernelModule& module);

/// A name as a C++ identifier: keywords, macros and names that the header itself uses gain a trailing '_', Greek is
/// transliterated, other letters become "uXXXX"; distinct names stay distinct (a second clash gains another '_').
[[nodiscard]] std::vector<std::string> cpp_names(const std::vector<std::string>& names);

/// The name of the class of a module: no member and no argument of it is called so.
[[nodiscard]] std::string class_name(const std::string& module_name);

} // namespace lagen
