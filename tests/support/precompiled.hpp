// SPDX-License-Identifier: GPL-2.0-or-later
/// Programs that lagen compiles while it is tested: nothing of them is timed, and what they include is read once for
/// all.
#pragma once

#include "support/golden.hpp"

#include <filesystem>
#include <string>

namespace lagen::testing {

/// The headers of `run`, `sweep` and `chart` as the compiler keeps them once it has read them, in a folder that must be
/// there. A compiler passes over what was read with other options and reads the headers themselves.
class PrecompiledHeaders {
  public:
    explicit PrecompiledHeaders(const std::string& folder) : header_(folder + "/programs.hpp")
    {
        write_text(header_, "#include \"lagen_sweep/driver.hpp\"\n#include \"lagen_chart/points.hpp\"\n");
    }

    /// For CXXFLAGS, the same whatever was read yet.
    [[nodiscard]] std::string flags() const { return optimisation + " -include " + header_; }

    void read_for_runs() const { read("runs", "-ffp-contract=off -fno-tree-slp-vectorize -DLAGEN_SAME_BITS"); }
    void read_for_charts() const { read("charts", ""); }

  private:
    void read(const std::string& name, const std::string& options) const
    {
        const std::string kept = header_ + ".gch/" + name, runtime = LAGEN_SOURCE_DIR "/runtime";
        if (std::filesystem::exists(header_ + ".gch/" + name)) return;
        std::filesystem::create_directories(header_ + ".gch");
        (void)run_shell("c++ -std=c++20 -O2 -pthread " + options + " " + optimisation + " -I'" + runtime +
                        "/include' -I'" + runtime + "/program' $(pkg-config --cflags eigen3) -x c++-header '" +
                        header_ + "' -o '" + kept + "'");
    }

    std::string header_;
    static inline const std::string optimisation = "-Og";
};

} // namespace lagen::testing
