// SPDX-License-Identifier: GPL-2.0-or-later
/// The subcommands of `lagen`: one function a file. Each parses its own arguments, writes its result to standard output
/// and everything else to standard error, and answers an exit code.
#pragma once

#include "text/diagnostic.hpp"

#include <memory>
#include <span>
#include <string>

namespace lagen {

using Arguments = std::span<const std::string>;

[[nodiscard]] ExitCode run_check(Arguments arguments);
[[nodiscard]] ExitCode run_derive(Arguments arguments);
[[nodiscard]] ExitCode run_generate(Arguments arguments);
[[nodiscard]] ExitCode run_compile(Arguments arguments);
[[nodiscard]] ExitCode run_run(Arguments arguments);
[[nodiscard]] ExitCode run_sweep(Arguments arguments);
[[nodiscard]] ExitCode run_chart(Arguments arguments);
[[nodiscard]] ExitCode run_reduce(Arguments arguments);
[[nodiscard]] ExitCode run_explain(Arguments arguments);
[[nodiscard]] ExitCode run_solve(Arguments arguments);
[[nodiscard]] ExitCode run_linearize(Arguments arguments);
[[nodiscard]] ExitCode run_new(Arguments arguments);
[[nodiscard]] ExitCode run_schema(Arguments arguments);
[[nodiscard]] ExitCode run_models(Arguments arguments);
[[nodiscard]] ExitCode run_methods(Arguments arguments);

class Options;
/// `lagen run` of a file with a [morphism] block: a scene of the source, the same motion in the target, and how far
/// they are apart.
[[nodiscard]] ExitCode run_morphism(const Options& options, const std::shared_ptr<const SourceFile>& file);

/// Exit code of several outcomes together: 5, 4, 3, 1, 2, 0 in this order of precedence (130 above all).
[[nodiscard]] ExitCode worst(ExitCode a, ExitCode b);

} // namespace lagen
