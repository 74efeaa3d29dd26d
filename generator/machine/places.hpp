// SPDX-License-Identifier: GPL-2.0-or-later
/// Where things are on this machine: the runtime's headers, the example models, the cache.
#pragma once

#include <string>
#include <vector>

namespace lagen {

/// Folders for -I: the runtime's headers (LAGEN_INCLUDE, else beside the executable, else the source tree that it was
/// built from), the program of `run` around a header (beside the executable, else in the source tree) and Eigen. Throws
/// MachineError where they are nowhere.
[[nodiscard]] std::string runtime_folder();
[[nodiscard]] std::string program_folder();
[[nodiscard]] std::string eigen_folder();

/// The folder of the example models (LAGEN_MODELS, else the installed one, else the source tree), or "".
[[nodiscard]] std::string models_folder();

/// The file that a MODEL of the command line means: a bare name ("kepler", no folder, no extension) that is no file
/// here and has no NAME.toml here either is looked up among the example models, which standard error is told.
[[nodiscard]] std::string model_path(const std::string& given);

/// A folder for compiled scenes: LAGEN_CACHE, else XDG_CACHE_HOME/lagen, else ~/.cache/lagen; made if missing. Where
/// it cannot be written, is full, or no program can be run from there, a private folder below TMPDIR, which standard
/// error is told once. MachineError where that cannot be used either.
[[nodiscard]] std::string cache_folder();

} // namespace lagen
