// SPDX-License-Identifier: GPL-2.0-or-later
/// A function that Debian's libstdc++ refers to and its newlib lacks, so that programs without a system can be linked.
#include <cstddef>

extern "C" int getentropy(void* /*bytes*/, std::size_t /*count*/)
{
    return -1;
}
