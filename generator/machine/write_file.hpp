// SPDX-License-Identifier: GPL-2.0-or-later
/// Output files: written beside their place under a temporary name, then renamed, so that a reader never sees half a
/// file and a failure leaves what was there before.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lagen {

/// Writes `content` to `path` ("-" is standard output). A device or a pipe is written directly. Throws MachineError
/// with the reason (disk full, no such folder, ...); no temporary is left behind, on a signal neither. A reader of a
/// pipe who went away has what he wanted: the rest is written to nobody, and the command comes to its own end.
void write_file(const std::string& path, std::string_view content);

/// Throws as `write_file` will where `path` is a folder or stands in none that files can be made in: before a long
/// computation whose result goes there.
void require_writable(const std::string& path);

/// Writes to standard output and reports failure (a closed stream, a full disk) as MachineError; a reader who went away
/// is none, as above.
void write_standard_output(std::string_view content);

/// Writes to standard error as well as it can: a message that nobody can read is no reason to fail.
void write_standard_error(std::string_view text);

/// "warning: TEXT" on a line of standard error, and the hint on the next one.
void warn(const std::string& text, const std::string& hint = {});
void warn(const std::vector<std::string>& texts);

/// "cannot write 'PATH': why", as a MachineError; `error` is an errno.
[[noreturn]] void refuse_writing(const std::string& path, int error, const std::string& hint = {});
[[noreturn]] void refuse_reading(const std::string& path, int error);

/// The whole content of a file; MachineError where it cannot be read.
[[nodiscard]] std::string content_of_file(const std::string& path);

} // namespace lagen
