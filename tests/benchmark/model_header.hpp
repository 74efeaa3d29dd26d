// SPDX-License-Identifier: GPL-2.0-or-later
/// A header that is named when a benchmark is compiled: with -D MODEL=heavy_top, `#include MODEL_HEADER(MODEL)`
/// includes heavy_top.hpp, `#include MODEL_HEADER_IN(generated, MODEL)` generated/heavy_top.hpp, and TEXT_OF(MODEL) is
/// its name.
#pragma once

#define TEXT_OF_(x) #x
#define TEXT_OF(x) TEXT_OF_(x)
// A space here would stand in the name of the file.
// clang-format off
#define MODEL_HEADER(model) TEXT_OF(model.hpp)
#define MODEL_HEADER_IN(folder, model) TEXT_OF(folder/model.hpp)
// clang-format on
