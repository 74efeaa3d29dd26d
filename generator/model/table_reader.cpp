// SPDX-License-Identifier: GPL-2.0-or-later
/// Known and unknown keys.
#include "model/table_reader.hpp"

#include "text/comma_list.hpp"

#include <fmt/format.h>

namespace lagen {

TableReader::TableReader(const TomlValue& value, std::string title, const std::string& hint)
    : value_(value), title_(std::move(title))
{
    if (value.kind == TomlKind::table) return;
    throw ModelError(fmt::format("{} is {}, where a table is required", title_, kind_text(value.kind)), value.where,
                     hint);
}

const TomlEntry* TableReader::take(const std::string& key)
{
    known_.push_back(key);
    taken_.insert(key);
    for (const TomlEntry& entry : value_.entries) {
        if (entry.name() == key) return &entry;
    }
    return nullptr;
}

void TableReader::refuse_later(std::initializer_list<const char*> keys) const
{
    for (const TomlEntry& entry : value_.entries) {
        for (const char* key : keys) {
            if (entry.name() != key) continue;
            const std::string what = title_ == "the model" ? fmt::format("the block [{}]", key)
                                                           : fmt::format("the key '{}' of {}", key, title_);
            throw ModelError(what + " belongs to the model format, but this version of lagen does not read it",
                             entry.where());
        }
    }
}

void TableReader::finish() const
{
    for (const TomlEntry& entry : value_.entries) {
        if (taken_.contains(entry.name())) continue;
        throw ModelError(fmt::format("unknown key '{}' in {}", entry.name(), title_), entry.where(),
                         hint_for(entry.name(), known_, "keys"));
    }
}

std::string hint_for(const std::string& unknown, const std::vector<std::string>& known, const char* noun)
{
    constexpr std::size_t longest_list = 20;
    const std::string nearest = nearest_name(unknown, known);
    if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
    if (known.empty()) return {};
    if (known.size() <= longest_list) return fmt::format("known {}: {}", noun, comma_list(known));
    const std::vector<std::string> first(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(longest_list));
    return fmt::format("known {}: {}, ...", noun, comma_list(first));
}

} // namespace lagen
