// SPDX-License-Identifier: GPL-2.0-or-later
/// Compiling a scene's program with the system compiler, cached by content.
#pragma once

#include "content_hash.hpp"

#include <string>

namespace lagen {

struct Compiled {
    std::string program; ///< path of the executable
    bool cached = false; ///< it was there already
    double seconds = 0;  ///< of the compiler
};

/// Compiles a program of two files: `header` (included as "model.hpp") and `main`. The cache key is the content of
/// both (comments apart), of every header of the runtime, the compiler (path, size, time) and the flags. CXX names the
/// compiler (with arguments, if any), else c++, g++ or clang++; CXXFLAGS is added. The cache is kept below 200 programs
/// and 1 GiB. Throws MachineError: no compiler, or its message when it fails.
[[nodiscard]] Compiled compile_program(const std::string& header, const std::string& main);

/// What a program depends on besides its two files.
void add_compilation(ContentHash& hash);

} // namespace lagen
