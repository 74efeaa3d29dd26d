// SPDX-License-Identifier: GPL-2.0-or-later
/// The integrators that `run` knows, as the runtime's headers define them.
#pragma once

#include <span>
#include <string>

namespace lagen {

struct MethodEntry {
    const char* name;    ///< as in scenes and --method
    const char* type;    ///< the runtime's type
    const char* order;   ///< "5(4)"
    bool adaptive;       ///< takes a tolerance; else a step
    bool separable_only; ///< partitioned methods for xdot = f(y), ydot = g(x)
    const char* text;    ///< one line, with the source
    bool series = false; ///< needs the kernels of Taylor coefficients
};

[[nodiscard]] std::span<const MethodEntry> method_table();
[[nodiscard]] const MethodEntry* find_method(const std::string& name); ///< nullptr where there is none
/// The method that was meant: one of a name like it, or what other programs call so; empty where there is none.
[[nodiscard]] std::string nearest_method(const std::string& name);
/// Every method name, in the order of the table.
[[nodiscard]] std::span<const std::string> method_names();

} // namespace lagen
