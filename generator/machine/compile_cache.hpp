// SPDX-License-Identifier: GPL-2.0-or-later
/// The folder of compiled scenes, kept small: each file is a program whose name is its key, or the record of a run
/// (KEY.run). A file of it is whole where its last line is the seal of what stands before, which loaders and shells do
/// not read: what was cut off, or is something else, is made again.
#pragma once

#include "lagen_run/archive.hpp"

#include <optional>
#include <string>
#include <utility>

namespace lagen {

/// True where the program is there, whole, and may be executed; it counts as used just now.
[[nodiscard]] bool use_cached(const std::string& program);

/// The text of a file that `keep_text` has written, which counts as used just now; nothing where it is not there, or
/// not whole.
[[nodiscard]] std::optional<std::string> kept_text(const std::string& file);

/// Keeps a text; a failure is none of the command's: the next one finds nothing.
void keep_text(const std::string& file, const std::string& text);

/// Seals the file `made`, which stands in the folder of the cache, and gives it the name `kept`, whatever had it.
/// Renamed into place whole: two runs at once may both compile, neither sees half a program. Throws MachineError.
void keep_program(const std::string& made, const std::string& kept);

/// Removes the files used longest ago until at most 200 of them with at most 1 GiB are left, and what compilations
/// that were killed have left for more than a day. Files with other names are not touched; failures are ignored.
void trim_cache(const std::string& folder);

/// A structure (lagen_run/archive.hpp) under its heading, which says what it is. Nothing is kept where `file` is empty.
template <class T>
void keep(const std::string& file, std::string_view heading, const T& value)
{
    if (!file.empty()) keep_text(file, std::string(heading) + detail::packed(value));
}

/// Nothing where there is none in this file.
template <class T>
[[nodiscard]] std::optional<T> kept(const std::string& file, std::string_view heading)
{
    const std::optional<std::string> text = kept_text(file);
    if (!text || !text->starts_with(heading)) return std::nullopt;
    std::string_view bytes = std::string_view(*text).substr(heading.size());
    T value;
    return detail::take_packed(bytes, value) && bytes.empty() ? std::optional(std::move(value)) : std::nullopt;
}

} // namespace lagen
