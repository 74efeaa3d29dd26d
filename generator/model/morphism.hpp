// SPDX-License-Identifier: GPL-2.0-or-later
/// The record of a morphism file: two models and the map between them, or morphisms that follow each other.
///   [morphism]  source, target, base, fibre, parameters, controls, element;  or  compose;  and  equals
#pragma once

#include "model/model.hpp"
#include "model/read_model.hpp"

namespace lagen {

struct MorphismFile {
    std::string name;
    std::shared_ptr<const SourceFile> file;
    Model source, target;
    std::vector<Tree> base;     ///< phi^i, one a base coordinate of the target, over x and parameters of the source
    std::vector<Tree> fibre;    ///< y'^a, one a fibre coordinate of the target, over x, y and parameters of the source
    std::vector<Tree> controls; ///< u'^A over x, u, t and parameters of the source; empty where left out
    std::vector<Tree> element;  ///< W' by rows, over the coordinates of an arrow of the source; empty where left out
    std::vector<Tree> parameters; ///< one a free parameter of the target, over those of the source; null: the source's
                                  ///< of the same name, or none that the source knows
    std::vector<MorphismFile> stages; ///< of `compose`: the first is done first; then there is no map beside
    std::vector<MorphismFile> equals; ///< one that is claimed to be the same map, or none
};

/// The model where the map, or its first stage, starts; and that where the map, or its last stage, ends.
[[nodiscard]] const Model& source_of(const MorphismFile& morphism);
[[nodiscard]] const Model& target_of(const MorphismFile& morphism);

/// True where the file has a [morphism] block.
[[nodiscard]] bool is_morphism(const std::shared_ptr<const SourceFile>& file);

/// Reads a morphism file with its models; `settings` are of the source's parameters. Throws ModelError.
[[nodiscard]] MorphismFile read_morphism(const std::shared_ptr<const SourceFile>& file,
                                         const std::vector<Setting>& settings = {}, const Choosers& choosers = {});

} // namespace lagen
