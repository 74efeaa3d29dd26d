// SPDX-License-Identifier: GPL-2.0-or-later
#include "runtime/pendulum.hpp"

LAGEN_PENDULUM_RUNS()
