// SPDX-License-Identifier: GPL-2.0-or-later
/// A million units of time: walk.hpp prints a line an orbit.
#include "walk.hpp"

int main()
{
    walks(1e6);
    return 0;
}
