// SPDX-License-Identifier: GPL-2.0-or-later
/// The key `jump` of an event.
#pragma once

#include "model/model_reader.hpp"

namespace lagen {

/// What coordinates, momenta and first-order states are behind a crossing, as expressions of the state before it.
/// `title` names the event in messages. Throws ModelError: a name that is none of the state's, given twice, or held by
/// a constraint or a group; fibre coordinates beside momenta; a model with [control].
[[nodiscard]] std::vector<NamedTree> read_jump(const ModelReader& reader, const TomlEntry& block,
                                               const std::string& title);

} // namespace lagen
