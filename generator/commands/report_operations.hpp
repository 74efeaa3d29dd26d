// SPDX-License-Identifier: GPL-2.0-or-later
/// What `generate --report` prints of the simplification of each kernel.
#pragma once

#include "kernels/form_kernels.hpp"

namespace lagen {

/// One table: of each kernel the operations as written, after each pass that changed them on the way to the form that
/// was kept, and as kept; below them its costliest terms. Of several forms with the same operations the first is shown.
/// Lines end in a line feed.
[[nodiscard]] std::string operations_text(const std::vector<KernelReport>& reports);

} // namespace lagen
