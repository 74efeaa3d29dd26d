// SPDX-License-Identifier: GPL-2.0-or-later
/// A document as a TOML text: parse_toml gives it back, positions aside.
#pragma once

#include "model/toml_document.hpp"

namespace lagen {

/// Keys first, then tables as [NAME], those of [scene] as [scene.NAME]; what is in them is written inline. Comments are
/// lost.
[[nodiscard]] std::string print_toml(const TomlValue& document);

/// A string, and a key with its value, that stand in no file.
[[nodiscard]] TomlValue toml_string(const std::string& text);
[[nodiscard]] TomlEntry toml_entry(const std::string& key, TomlValue value);

/// The entry of a table, which must be one; made at its end where it is missing.
[[nodiscard]] TomlValue& entry_in(TomlValue& table, const std::string& key);

} // namespace lagen
