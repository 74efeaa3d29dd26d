// SPDX-License-Identifier: GPL-2.0-or-later
/// A model file's bytes.
#pragma once

#include <string>

namespace lagen {

/// The whole content of the file. Throws ModelError: it does not exist, is a folder, cannot be opened or read, or holds
/// more than 16 MiB (pipes are read too, and bounded alike).
[[nodiscard]] std::string read_file(const std::string& path);

} // namespace lagen
