// SPDX-License-Identifier: GPL-2.0-or-later
/// Compiling a scene's program with the system compiler, cached by content.
#pragma once

#include "text/content_hash.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace lagen {

/// A program of two files, and the libraries that it is linked to ("-lquadmath").
struct ProgramText {
    std::string header, main;
    std::vector<std::string> libraries = {};
    std::vector<std::string> options = {}; ///< of the compiler, before CXXFLAGS
    bool is_model = false;                 ///< a compiled model, which is loaded, in place of a program
};

/// The options with which every sum and product is rounded by itself, whatever vectors a program is compiled for. Where
/// sums and differences alternate g++ 12 fuses the vectors that it makes itself, whatever -ffp-contract says.
[[nodiscard]] std::vector<std::string> rounding_options();

/// The options with which a compiler uses the vectors of this machine. None where CXXFLAGS say how to compile.
[[nodiscard]] std::vector<std::string> vector_options();

/// Compiles programs of two files, as many at a time as there are cores, and returns their paths: `header` (included as
/// "model.hpp") and `main`. The cache key is the content of both (comments apart), of every header of the runtime, the
/// compiler (path, size, time) and the flags. CXX names the compiler (with arguments, if any), else c++, g++ or
/// clang++; CXXFLAGS is added. The cache is kept below 200 programs and 1 GiB. Standard error is told how many are
/// missing, if several are. Throws MachineError: no compiler, or its message when it fails.
std::vector<std::string> compile_programs(const std::vector<ProgramText>& programs);

/// Whether the compiler finds a header, "gsl/gsl_odeiv2.h".
[[nodiscard]] bool finds_header(const std::string& header);

/// Throws MachineError where the compiler makes no program with __float128 and libquadmath.
void require_quad();

/// The compiler with its flags, as a user would type it.
[[nodiscard]] std::string compiler_text();

/// lagen with its runtime by their contents, the compiler with its flags by what it says of itself: a line that is the
/// same wherever the same two are installed.
[[nodiscard]] std::string build_text();

/// The lines that are neither empty nor comments alone, which begin with `comment`.
[[nodiscard]] std::string lines_of_code(const std::string& text, std::string_view comment);

/// What a program depends on besides its two files.
void add_compilation(ContentHash& hash);

} // namespace lagen
