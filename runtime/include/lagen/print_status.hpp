// SPDX-License-Identifier: MIT
/// `std::cerr << status`: apart from status.hpp, so that kernels do not pull in <ostream>.
#pragma once

#include "lagen/status.hpp"

#include <ostream>

namespace lagen {

/// The name of the status as `lagen run` prints it.
inline std::ostream& operator<<(std::ostream& out, Status status)
{
    return out << to_text(status);
}

} // namespace lagen
