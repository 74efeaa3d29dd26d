// SPDX-License-Identifier: GPL-2.0-or-later
/// What is wrong with the command line, and with what it shares with a model file.
#pragma once

#include "text/diagnostic.hpp"

namespace lagen {

/// The command line is wrong (exit code 4): a sentence without a full stop. `lagen` says before it which command was
/// called.
class UsageError : public Error {
  public:
    explicit UsageError(const std::string& text, const std::string& hint = {})
        : Error(ExitCode::usage, with_hint(text, hint))
    {
    }
};

/// True for a place in the text of an option, whose file is called "<--NAME>".
[[nodiscard]] inline bool is_option(const SourceRange& where)
{
    return where.file && where.file->name.starts_with("<--");
}

/// Something is wrong with what stands there: a UsageError where an option says it, else a ModelError.
[[noreturn]] inline void refuse(const std::string& text, const SourceRange& where, const std::string& hint = {})
{
    if (is_option(where)) throw UsageError(text, hint);
    throw ModelError(text, where, hint);
}

} // namespace lagen
