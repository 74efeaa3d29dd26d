// SPDX-License-Identifier: GPL-2.0-or-later
/// The reader of tests/data, compiled into this executable too.
#include "support/reference_case.cpp" // NOLINT(bugprone-suspicious-include)
