// SPDX-License-Identifier: GPL-2.0-or-later
/// The model file of a reduction in the making: the file of the whole model, with what the reduction changes.
#pragma once

#include "model/print_toml.hpp"
#include "pipeline.hpp"

#include <string>
#include <vector>

namespace lagen {

/// A model that was made of another one, with its proof.
struct ReducedModel {
    StructureReport report;
    std::string said;     ///< for a person: what names are defined as, and L or R; or why there is no file
    std::string document; ///< the model file; empty where what the reduction rests on is refuted
    std::string lagrangian;
};

class ReducedDocument {
  public:
    /// With the values that the command line gave to parameters, and the title "TITLE, reduced HOW".
    ReducedDocument(const CheckedModel& whole, const std::string& how);

    /// Writes the velocities out where a rate Dt stands, also by way of a definition: of a coordinate that the
    /// reduction fixes or forgets Dt says something else.
    void write_out_rates(const Model& model);

    /// A top-level table or key, made where it is missing.
    [[nodiscard]] TomlValue& at(const std::string& block) { return entry_in(document_, block); }
    /// The same, or nullptr where it is missing.
    [[nodiscard]] TomlValue* find(const std::string& block);
    /// The table [scene.NAME].
    [[nodiscard]] TomlValue& scene(const std::string& name) { return entry_in(at("scene"), name); }
    /// Leaves out, without a word, a block, all but some, keys of one.
    void forget(const std::string& block);
    void keep(const std::vector<std::string>& blocks);
    void erase(const std::string& block, const std::vector<std::string>& keys);
    /// Leaves out whole blocks, and says so where they were there.
    void drop(const std::vector<std::string>& blocks);
    /// Leaves out an entry of a block, which the comment calls `called`.
    void drop(const std::string& block, const std::string& key, const std::string& called);

    /// `head` (comment lines), what was left out, then the tables where a person puts them: what was made stands at the
    /// end.
    [[nodiscard]] std::string text(const std::string& head);

  private:
    TomlValue document_;
    std::vector<std::string> dropped_;
};

/// Throws MathematicsError where the model is no Lagrangian on a tangent bundle, which "REDUCTION takes".
void require_tangent_lagrangian(const Model& model, const char* reduction);

/// A list of strings.
[[nodiscard]] TomlValue toml_list(const std::vector<std::string>& texts);

} // namespace lagen
