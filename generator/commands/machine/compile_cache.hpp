// SPDX-License-Identifier: GPL-2.0-or-later
/// The folder of compiled scenes, kept small: each file is a program whose name is its key, or the record of a run
/// (KEY.run).
#pragma once

#include <string>

namespace lagen {

/// True where the program is there and may be executed; it counts as used just now.
[[nodiscard]] bool use_cached(const std::string& program);

/// Removes the files used longest ago until at most 200 of them with at most 1 GiB are left, and what compilations
/// that were killed have left for more than a day. Files with other names are not touched; failures are ignored.
void trim_cache(const std::string& folder);

} // namespace lagen
