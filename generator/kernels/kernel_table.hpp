// SPDX-License-Identifier: GPL-2.0-or-later
/// Every kernel that lagen makes: its name, the forms that have it, its output and its documentation.
#pragma once

#include "graph/kernel.hpp"
#include "model/form.hpp"

#include <optional>

namespace lagen {

/// What a kernel says of its output.
struct OutputSignature {
    int rank = 0;
    ArrayRole role = ArrayRole::value;
    bool sparse = false;
    bool checked = false; ///< the kernel answers a status
};

struct KernelRow {
    const char* name = "";
    std::optional<FormKind> form = std::nullopt; ///< none: every form
    OutputSignature output = {};
    const char* documentation = ""; ///< of the kernel; {0} and {1} are the rows and columns of its output
    bool on_request = false;        ///< made only where it is asked for by name
};

/// In the order in which lists of kernels are printed. A kernel of several forms with a formula each has several rows.
[[nodiscard]] std::span<const KernelRow> kernel_table();

/// Throws InternalError where the form has no such kernel.
[[nodiscard]] const KernelRow& kernel_row(const std::string& name, FormKind form);

} // namespace lagen
