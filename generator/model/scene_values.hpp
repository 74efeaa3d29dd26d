// SPDX-License-Identifier: GPL-2.0-or-later
/// Values that the tables of a scene give to symbols, and those that they leave out.
#pragma once

#include "model/families.hpp"

#include <set>
#include <unordered_map>

namespace lagen {

/// Replaces the entries of the same names, appends the others.
void put_all(std::vector<NamedTree>& list, std::vector<NamedTree> entries);

/// Values that a table of a scene gives; a family's name gives all its entries.
class GivenValues {
  public:
    explicit GivenValues(std::string what) : what_(std::move(what)) {}

    /// `key` names entries of `symbols`. Throws ModelError: an entry that was given already, a value over anything but
    /// parameters, or of another shape.
    void add(const ModelReader& reader, const TomlEntry& entry, const ResolvedKey& key,
             const std::vector<Symbol>& symbols);

    std::vector<NamedTree> list;

  private:
    std::string what_;
    std::unordered_map<std::string, std::string> keys_; ///< by which key each name is given; looked up, never iterated
};

/// Symbols without a value; a family that has none at all by its name.
struct Missing {
    std::size_t count = 0; ///< of symbols
    std::vector<std::string> names;

    void add(const Missing& more);
    [[nodiscard]] std::string text() const;
};

[[nodiscard]] Missing missing_of(const std::vector<Symbol>& symbols, const std::set<std::string>& given);

/// The names of the entries.
[[nodiscard]] std::set<std::string> given_names(const std::vector<NamedTree>& entries);

} // namespace lagen
