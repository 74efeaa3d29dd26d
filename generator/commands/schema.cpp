// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen schema`: what editors need to know of model files.
#include "model/schema.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "machine/write_file.hpp"

namespace lagen {

namespace {

const CommandSyntax schema_syntax{"schema",
                                  "",
                                  "Prints the JSON Schema (2020-12) of model files, by which editors complete keys and "
                                  "check them.",
                                  {}};

} // namespace

ExitCode run_schema(Arguments arguments)
{
    const Options options(schema_syntax, arguments);
    if (!options.help()) write_standard_output(json_schema_text());
    return ExitCode::done;
}

} // namespace lagen
