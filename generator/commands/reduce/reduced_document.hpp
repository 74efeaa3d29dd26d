// SPDX-License-Identifier: GPL-2.0-or-later
/// The model file of a reduction in the making: the file of the whole model, with what the reduction changes.
#pragma once

#include "model/print_toml.hpp"
#include "model/read_model.hpp"

#include <string>
#include <vector>

namespace lagen {

class ReducedDocument {
  public:
    /// With the values that `settings` give to parameters, and the title "TITLE, reduced HOW".
    ReducedDocument(const Model& model, const std::vector<Setting>& settings, const std::string& how);

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
