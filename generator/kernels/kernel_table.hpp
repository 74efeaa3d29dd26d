// SPDX-License-Identifier: GPL-2.0-or-later
/// Every kernel that lagen makes: its name, the forms that have it, its output and its documentation.
#pragma once

#include "graph/kernel.hpp"
#include "model/scene_form.hpp"

namespace lagen {

/// Forms of the equations, a bit each.
using Forms = unsigned;
[[nodiscard]] constexpr Forms only(FormKind form)
{
    return 1u << static_cast<unsigned>(form);
}

/// What a kernel says of its output.
struct OutputSignature {
    int rank = 0;
    ArrayRole role = ArrayRole::value;
    bool sparse = false;
    bool checked = false; ///< the kernel answers a status
};

struct KernelRow {
    const char* name = "";
    Forms forms = 0; ///< that have it
    OutputSignature output = {};
    const char* documentation = ""; ///< of the kernel; {0} and {1} are the rows and columns of its output
    bool on_request = false;        ///< made only where it is asked for by name
};

/// In the order in which lists of kernels are printed. A kernel of several forms with a formula each has several rows.
[[nodiscard]] std::span<const KernelRow> kernel_table();

[[nodiscard]] constexpr bool has_form(const KernelRow& row, FormKind form)
{
    return (row.forms & only(form)) != 0;
}

/// Throws InternalError where the form has no such kernel.
[[nodiscard]] const KernelRow& kernel_row(const std::string& name, FormKind form);

} // namespace lagen
