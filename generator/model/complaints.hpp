// SPDX-License-Identifier: GPL-2.0-or-later
/// The catalogue of what may be wrong with a model file beyond TOML and single expressions: a sentence each.
#pragma once

#include "text/comma_list.hpp"
#include "text/diagnostic.hpp"

#include <fmt/format.h>

namespace lagen::complain {

using Text = const std::string&;
using Place = const SourceRange&;

/// "did you mean 'x'?" for the nearest of `known`, else "known NOUN: a, b, c" (at most twenty of them), else "".
[[nodiscard]] inline std::string hint_for(Text unknown, const std::vector<std::string>& known, const char* noun)
{
    constexpr std::size_t longest_list = 20;
    const std::string nearest = nearest_name(unknown, known);
    if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
    if (known.empty()) return {};
    if (known.size() <= longest_list) return fmt::format("known {}: {}", noun, comma_list(known));
    return fmt::format("known {}: {}, ...", noun,
                       comma_list(std::vector<std::string>(known.begin(), known.begin() + longest_list)));
}

inline ModelError unknown_key(Text key, Text title, Place where, const std::vector<std::string>& known)
{
    return {fmt::format("unknown key '{}' in {}", key, title), where, hint_for(key, known, "keys")};
}

/// A value of another kind, shape or number.
template <class Found>
ModelError is_not(Text what, const Found& found, Text wanted, Place where, Text hint = {})
{
    return {fmt::format("{} is {}, where {} is required", what, found, wanted), where, hint};
}

template <class Wanted>
ModelError wrong_number(Text things, std::size_t found, Text who, const Wanted& wanted, Place where, Text hint = {})
{
    return {fmt::format("the number of {} is {}, where {} needs {}", things, found, who, wanted), where, hint};
}

inline ModelError unknown_word(Text what, Text word, Place where, const std::vector<std::string>& known,
                               const char* noun)
{
    return {fmt::format("{} is {}, which is none of the {}", what, quote(word), noun), where,
            hint_for(word, known, noun)};
}

/// One key, or all of several of which one is wanted.
inline ModelError missing(Text owner, const std::vector<std::string>& keys, Place where, Text hint = {})
{
    return {keys.size() == 1 ? fmt::format("{} has no key '{}'", owner, keys[0])
                             : fmt::format("{} has neither '{}'", owner, fmt::join(keys, "' nor '")),
            where, hint};
}

inline ModelError both(Text owner, Text a, Text b, Place where)
{
    return {fmt::format("{} gives both '{}' and '{}'", owner, a, b), where, "keep one of them"};
}

inline ModelError takes_no(Text owner, Text key, Place where, Text hint = {})
{
    return {fmt::format("{} takes no '{}'", owner, key), where, hint};
}

/// A block that does not go with what the model is.
inline ModelError beside(Text what, Text other, Place where, Text hint)
{
    return {fmt::format("{} stands beside {}", what, other), where, hint};
}

/// A block or value without what it is about.
inline ModelError needs(Text what, Text needed, Place where, Text hint = {})
{
    return {fmt::format("{} needs {}", what, needed), where, hint};
}

inline ModelError twice(Text what, Place where, Text hint = "keep one of them")
{
    return {fmt::format("{} is given twice", what), where, hint};
}

/// By two keys: a family's name and an entry.
inline ModelError twice(Text what, Text first, Text second, Place where)
{
    return {fmt::format("{} is given twice: by '{}' and by '{}'", what, first, second), where, "keep one of them"};
}

inline ModelError names_twice(Text owner, Text name, Place where, Text hint = "keep one of them")
{
    return {fmt::format("{} names '{}' twice", owner, name), where, hint};
}

inline ModelError names_no(Text owner, Text name, Text noun, Place where, Text hint)
{
    return {fmt::format("{} names '{}', which is no {}", owner, name, noun), where, hint};
}

inline ModelError leaves_out(Text owner, Text what, Place where, Text hint = {})
{
    return {fmt::format("{} leaves out {}", owner, what), where, hint};
}

inline ModelError too_many(Text what, std::size_t count, Text things, std::size_t most, Place where)
{
    return {fmt::format("{} has {} {}, more than {}", what, count, things, most), where};
}

inline ModelError may_not_depend(Text what, Text other, Place where, Text hint)
{
    return {fmt::format("{} may not depend on {}", what, other), where, hint};
}

inline ModelError like_itself(Text what, Place where)
{
    return {fmt::format("{} is like itself, through 'like'", what), where};
}

} // namespace lagen::complain

namespace lagen {
using complain::hint_for;
} // namespace lagen
