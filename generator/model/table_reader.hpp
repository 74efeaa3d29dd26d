// SPDX-License-Identifier: GPL-2.0-or-later
/// Taking known keys out of a TOML table: what is left over is an error with the nearest known key as hint.
#pragma once

#include "model/toml_document.hpp"

#include <initializer_list>
#include <set>
#include <string>
#include <vector>

namespace lagen {

class TableReader {
  public:
    /// `title` is how messages call the table, e.g. "[base]". Throws ModelError, with this hint, where `value` is no
    /// table.
    TableReader(const TomlValue& value, std::string title, const std::string& hint = {});

    /// The entry called `key`, or nullptr; the key is known from now on.
    [[nodiscard]] const TomlEntry* take(const std::string& key);

    /// Keys that the format has and this version of lagen does not read: one of them present is a ModelError of its
    /// own.
    void refuse_later(std::initializer_list<const char*> keys) const;

    /// Throws ModelError for the first entry that was not taken.
    void finish() const;

    [[nodiscard]] const std::string& title() const { return title_; }
    [[nodiscard]] const SourceRange& where() const { return value_.where; }

  private:
    const TomlValue& value_;
    std::string title_;
    std::vector<std::string> known_;
    std::set<std::string> taken_;
};

/// "did you mean 'x'?" for the nearest of `known`, else "known NOUN: a, b, c" (at most twenty of them), else "".
[[nodiscard]] std::string hint_for(const std::string& unknown, const std::vector<std::string>& known, const char* noun);

} // namespace lagen
