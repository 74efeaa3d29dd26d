// SPDX-License-Identifier: MIT
/// The runtime at once: contract, integrators, packs, printing of a status.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen/kernel.hpp"
#include "lagen/lanes/pack.hpp"
#include "lagen/print_status.hpp"
#include "lagen/status.hpp"
