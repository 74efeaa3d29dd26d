// SPDX-License-Identifier: GPL-2.0-or-later
/// A chain whose Jacobian is computed by columns, in every kind of scalar: scalars.hpp prints a line.
#include "scalars.hpp"

#include "chain_relative.hpp"

int main()
{
    compare<lagen::models::chain_relative>("chain_relative");
}
