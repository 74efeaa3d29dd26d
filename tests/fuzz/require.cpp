// SPDX-License-Identifier: GPL-2.0-or-later
/// A broken law ends the process, as a sanitizer's report does.
#include "fuzz/harness.hpp"

#include <cstdio>
#include <cstdlib>

namespace lagen::fuzz {

void require(bool law, const std::string& text)
{
    if (law) return;
    std::fprintf(stderr, "broken law: %s\n", text.c_str());
    std::abort();
}

} // namespace lagen::fuzz
