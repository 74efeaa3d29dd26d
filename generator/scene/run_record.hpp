// SPDX-License-Identifier: GPL-2.0-or-later
/// The record of a run is kept in the cache beside its program, with everything that was proved: the next run of the
/// same text, with the same kernels, reads it, and goes from the values of its scene straight to the program.
#pragma once

#include "pipeline.hpp"
#include "scene/scene_program.hpp"
#include "text/content_hash.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lagen {

struct RunRecord {
    std::string program;               ///< path of the executable
    std::vector<std::string> warnings; ///< of the model
    TableNames names;
    bool energy_changes = false; ///< forces, explicit time, a drift of constraints or jumps
    bool searches = false;       ///< controls are searched for, and followed
    /// The values of the parameters for which d2L/dy2 was decided; empty where it was decided for all.
    std::vector<long double> decided_for;
    /// Parameters with the values for which alone the equations are proved, "c = 3/5"; the program takes no others.
    std::vector<std::string> proved_for;

    static void each(auto& self, auto& archive)
    {
        archive(self.program, self.warnings, self.names.lanes, self.names.observables, self.names.states,
                self.energy_changes, self.searches, self.decided_for, self.proved_for);
    }
};

/// The record of a model that is generated, without its program.
[[nodiscard]] RunRecord record_of(const CheckedModel& checked, const KernelModule& module,
                                  const std::vector<long double>& parameters);

/// The text of the model and of the files that it includes, without lines of comments, its sizes and the parameters
/// that are bound.
void add_model(ContentHash& hash, const Model& model);

/// Adds everything of a scene that its kernels rest on besides the text of the model: not its name, its start, its
/// times, its tolerances. False where an expression is so long that its text does not tell it from others.
[[nodiscard]] bool add_scene(ContentHash& hash, const Model& model, const Scene& scene);

/// The file in the cache for what has this hash, with lagen itself, the runtime and the compiler. Empty where there is
/// no compiler, or no place for a cache.
[[nodiscard]] std::string kept_file(ContentHash hash);

/// Nothing where there is no record, where it or its program is damaged, or its program is gone.
[[nodiscard]] std::optional<RunRecord> find_record(const std::string& file);

/// A failure to write is no failure of the run.
void keep_record(const std::string& file, const RunRecord& record);

/// Whether what `record` says was decided for these values of the parameters, or for all.
[[nodiscard]] bool is_decided_for(const RunRecord& record, const std::vector<long double>& parameters);

/// Whether these parameters have the values of `proved_for`, as nearly as the program asks.
[[nodiscard]] bool is_proved_for(const RunRecord& record, const Model& model,
                                 const std::vector<long double>& parameters);

} // namespace lagen
