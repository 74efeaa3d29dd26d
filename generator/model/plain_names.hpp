// SPDX-License-Identifier: GPL-2.0-or-later
/// Names as words, as headings of files have them: x[1] is x_1, W[1,1] is W_1_1. A name that is a word by itself keeps
/// it wherever it stands, and is what that word means; a word that is taken gets a number.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace lagen {

struct Model;

/// Letters of any alphabet, digits and '_'; all else becomes one '_'. A leading digit gains a '_' in front.
[[nodiscard]] std::string plain_name(const std::string& name);

/// Words for `names`, all different. The words of `known`, what a model calls anything at all, are taken for what they
/// are called there: where the model has an x_1, x[1] is x_1_2.
[[nodiscard]] std::vector<std::string> plain_names(const std::vector<std::string>& names,
                                                   const std::vector<std::string>& known = {});

/// The place in `names` of what `word` means: the name itself, else the one that plain_names gives that word.
[[nodiscard]] std::optional<std::size_t> find_plain(const std::vector<std::string>& names, const std::string& word,
                                                    const std::vector<std::string>& known);

/// The names of the model for anything that may be a column: symbols, entries of families, observables, definitions.
[[nodiscard]] std::vector<std::string> all_names(const Model& model);

} // namespace lagen
