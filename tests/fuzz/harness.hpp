// SPDX-License-Identifier: GPL-2.0-or-later
/// What the fuzz targets share. A target is one function of bytes; libFuzzer calls it with bytes of its own making,
/// replay.cpp with those of the corpus. Whatever a user can cause is answered by ModelError or MathematicsError;
/// everything else that is thrown, a broken law and a sanitizer's report end the process.
#pragma once

#include "text/diagnostic.hpp"

#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace lagen::fuzz {

/// Ends the process with `text` where `law` does not hold.
void require(bool law, const std::string& text);

/// Runs `action`; false where it was refused as a user's mistake.
template <class Action>
bool accepted(const Action& action)
{
    try {
        action();
        return true;
    } catch (const ModelError&) {
        return false;
    } catch (const MathematicsError&) {
        return false;
    }
}

} // namespace lagen::fuzz
