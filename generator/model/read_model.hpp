// SPDX-License-Identifier: GPL-2.0-or-later
/// TOML to Model. Unknown keys are errors, the order of the file is kept, floats are re-read from their text.
#pragma once

#include "model/model.hpp"

#include <functional>

namespace lagen {

/// A parameter changed on the command line, `--set name=value`. It replaces the file's value before anything is derived
/// from it (so "mgl = 'm*g*l'" follows m). `--bind name=value` makes it a constant of the equations as well, and
/// `--bind name` does so with the value that it has.
struct Setting {
    std::string name;
    Excerpt value; ///< empty where the value stays
    bool binds = false;
    bool sizes_alone = false; ///< of a file that another includes: it is for a size of this name, where there is one

    [[nodiscard]] bool gives_value() const { return value.file != nullptr; }
};

/// Chooses the ambient coordinates that a nonholonomic model by constraints keeps as its fibre, as places in
/// ambient_fibre, where [fibre] leaves that open; of a model that is read as far as its base.
using KeptChooser = std::function<std::vector<std::size_t>(const Model&)>;

/// The words of a file on the frame of a level set.
struct LevelSetRequest {
    std::vector<std::size_t> kept;       ///< base coordinates whose velocities are to be the fibre's; empty: left open
    std::optional<std::size_t> sections; ///< the number of fibre coordinates; nothing: left open
    SourceRange where;
};

/// A frame of the tangent space of the level set of the base constraints.
struct LevelSetFrame {
    std::vector<std::size_t> constraints; ///< those that are no repetitions of others of the same matrix
    std::vector<std::size_t> kept;        ///< the base coordinates that parametrise it, one a section; of a curve none
    std::vector<AnchorEntry> anchor;
};

/// Makes one, of a model that is read as far as its base. Throws ModelError where there is none.
using FrameMaker = std::function<LevelSetFrame(const Model&, const LevelSetRequest&)>;

/// The choices that the reading of a model leaves to those who know geometry.
struct Choosers {
    KeptChooser kept;
    FrameMaker frame;
};

/// Reads and checks a model file. A missing or unreadable file, a folder, invalid UTF-8, a file above 16 MiB, TOML
/// errors, unknown keys, unknown names, names declared twice and expressions in error throw ModelError.
[[nodiscard]] Model read_model(const std::string& path, const std::vector<Setting>& settings = {},
                               const Choosers& choosers = {});

/// The same from a text in memory; `name` stands in messages for the path.
[[nodiscard]] Model read_model_text(const std::string& name, std::string text,
                                    const std::vector<Setting>& settings = {}, const Choosers& choosers = {});

} // namespace lagen
