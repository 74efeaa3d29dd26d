// SPDX-License-Identifier: GPL-2.0-or-later
/// Programs that lagen compiles while it is tested: nothing of them is timed, and what they include is read once for
/// all. clang takes half of the time of g++, and is the compiler of all but charts, which are measured by numbers of
/// 113 bits that it does not make.
#pragma once

#include "support/golden.hpp"

#include <filesystem>
#include <string>

namespace lagen::testing {

/// How lagen is to compile: CXX, and how far that optimises.
struct CompilerChoice {
    std::string compiler, level;
};

/// The headers of `run`, `sweep` and `chart` as the compilers keep them once they have read them, in a folder that must
/// be there. A compiler passes over what another one read, or itself with other options.
class PrecompiledHeaders {
  public:
    explicit PrecompiledHeaders(const std::string& folder) : header_(folder + "/programs.hpp")
    {
        write_text(header_, "#include \"lagen_sweep/driver.hpp\"\n#include \"lagen_chart/points.hpp\"\n"
                            "#include \"lagen/export_model.hpp\"\n");
        std::filesystem::create_directories(header_ + ".gch");
    }

    /// For CXXFLAGS, the same whatever was read yet.
    [[nodiscard]] std::string flags(const CompilerChoice& choice) const
    {
        return choice.level + " -include " + header_;
    }

    void read_for_models(const CompilerChoice& choice) const
    {
        read("models", choice, same_bits + " -fPIC -fvisibility=hidden -DEIGEN_MAX_ALIGN_BYTES=16");
    }
    void read_for_runs(const CompilerChoice& choice) const { read("runs", choice, same_bits); }
    void read_for_charts(const CompilerChoice& choice) const { read("charts", choice, ""); }

  private:
    void read(const std::string& name, const CompilerChoice& choice, const std::string& options) const
    {
        const std::string kept = header_ + ".gch/" + name + "_" + choice.compiler + choice.level;
        if (std::filesystem::exists(kept)) return;
        const std::string runtime = LAGEN_SOURCE_DIR "/runtime";
        (void)run_shell(choice.compiler + " -std=c++20 -O2 -pthread " + options + " " + choice.level + " -I'" +
                        runtime + "/include' -I'" + runtime +
                        "/program' $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) -x c++-header '" + header_ +
                        "' -o '" + kept + "'");
    }

    std::string header_;
    static inline const std::string same_bits = "-ffp-contract=off -fno-tree-slp-vectorize -DLAGEN_SAME_BITS";
};

} // namespace lagen::testing
