// SPDX-License-Identifier: MIT
/// `lagen::integrate` with every method. A program that uses one method compiles sooner with the header of that one,
/// as `lagen/dop853.hpp`.
#pragma once

#include "lagen/dop853.hpp"
#include "lagen/dopri5.hpp"
#include "lagen/fixed_step.hpp"
#include "lagen/gauss.hpp"
#include "lagen/group/crouch_grossman.hpp"
#include "lagen/group/lie_poisson.hpp"
#include "lagen/group/munthe_kaas.hpp"
#include "lagen/nystrom.hpp"
#include "lagen/ode.hpp"
#include "lagen/print_status.hpp"
#include "lagen/radau5.hpp"
#include "lagen/reversible.hpp"
#include "lagen/run.hpp"
#include "lagen/splittings.hpp"
#include "lagen/taylor.hpp"
#include "lagen/tsit5.hpp"
#include "lagen/variational/arrows.hpp"
#include "lagen/variational/composition.hpp"
#include "lagen/variational/discrete.hpp"
#include "lagen/verner.hpp"
