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

/// A sentence with places for texts, and the hint that ends it unless another is given.
template <class... Parts>
struct Complaint {
    const char* sentence;
    const char* usual_hint = "";

    ModelError operator()(Parts... parts, Place where, Text hint) const
    {
        return {fmt::format(fmt::runtime(sentence), parts...), where, hint};
    }
    ModelError operator()(Parts... parts, Place where) const { return (*this)(parts..., where, usual_hint); }
};

using OfOne = Complaint<Text>;
using OfTwo = Complaint<Text, Text>;
using OfThree = Complaint<Text, Text, Text>;

inline constexpr const char* keep_one = "keep one of them";
inline constexpr OfTwo has_no{"{} has no key '{}'"};
inline constexpr OfTwo has_neither{"{} has neither '{}'"};
inline constexpr OfThree both{"{} gives both '{}' and '{}'", keep_one};
inline constexpr OfTwo takes_no{"{} takes no '{}'"};
inline constexpr OfTwo beside{"{} stands beside {}"}; // what the model is
inline constexpr OfTwo needs{"{} needs {}"};
inline constexpr OfOne twice{"{} is given twice", keep_one};
inline constexpr OfThree twice_by{"{} is given twice: by '{}' and by '{}'", keep_one}; // a family's name and an entry
inline constexpr OfTwo names_twice{"{} names '{}' twice", keep_one};
inline constexpr OfThree names_no{"{} names '{}', which is no {}"};
inline constexpr OfTwo leaves_out{"{} leaves out {}"};
inline constexpr OfTwo may_not_depend{"{} may not depend on {}"};
inline constexpr OfOne like_itself{"{} is like itself, through 'like'"};
inline constexpr Complaint<Text, std::size_t, Text, std::size_t> too_many{"{} has {} {}, more than {}"};

inline ModelError unknown_key(Text key, Text title, Place where, const std::vector<std::string>& known)
{
    return {fmt::format("unknown key '{}' in {}", key, title), where, hint_for(key, known, "keys")};
}

inline ModelError unknown_word(Text what, Text word, Place where, const std::vector<std::string>& known,
                               const char* noun)
{
    return {fmt::format("{} is {}, which is none of the {}", what, quote(word), noun), where,
            hint_for(word, known, noun)};
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

/// One key, or all of several of which one is wanted.
inline ModelError missing(Text owner, const std::vector<std::string>& keys, Place where, Text hint = {})
{
    return keys.size() == 1 ? has_no(owner, keys[0], where, hint)
                            : has_neither(owner, fmt::format("{}", fmt::join(keys, "' nor '")), where, hint);
}

} // namespace lagen::complain

namespace lagen {
using complain::hint_for;
} // namespace lagen
