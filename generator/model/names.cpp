// SPDX-License-Identifier: GPL-2.0-or-later
/// Declarations and their clashes.
#include "model/names.hpp"

#include "expression/parse.hpp"
#include "expression/tree.hpp"
#include "model/complaints.hpp"
#include "text/alphabet.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// One and several of each role, in the order of the enumeration.
constexpr std::pair<const char*, const char*> role_texts[] = {
    {"the time", "time"},
    {"a size", "sizes"},
    {"a parameter", "parameters"},
    {"a base coordinate", "base coordinates"},
    {"a fibre coordinate", "fibre coordinates"},
    {"an ambient fibre coordinate", "ambient fibre coordinates"},
    {"a momentum", "momenta"},
    {"a control", "controls"},
    {"a first-order state", "first-order states"},
    {"an input", "inputs"},
    {"a definition", "definitions"},
    {"an inner velocity", "inner velocities"},
    {"a Casimir", "Casimirs"},
    {"an observable", "observables"},
    {"an E-form", "E-forms"},
    {"an entry of the group element", "entries of the group element"},
    {"a coordinate of the target", "coordinates of the target"},
    {"the step", "the step"},
    {"a built-in quantity", "built-in quantities"},
};
static_assert(std::size(role_texts) == static_cast<std::size_t>(Role::built_in) + 1);

/// C++20 keywords [lex.key], alternative tokens, and macros of the standard library that a header may meet.
constexpr std::string_view reserved_words =
    " EOF FILE INFINITY NAN NULL alignas alignof and and_eq asm assert auto bitand bitor bool break case catch char "
    "char16_t char32_t char8_t class co_await co_return co_yield compl concept const const_cast consteval constexpr "
    "constinit continue decltype default delete do double dynamic_cast else enum errno explicit export extern false "
    "float for friend goto if inline int linux long main mutable namespace new noexcept not not_eq nullptr offsetof "
    "operator or or_eq private protected public register reinterpret_cast requires return setjmp short signed sizeof "
    "static static_assert static_cast stderr stdin stdout struct switch template this thread_local throw true try "
    "typedef typeid typename union unix unsigned using virtual void volatile wchar_t while xor xor_eq ";

std::string shown(const std::string& name)
{
    constexpr std::size_t longest = 60;
    std::string out;
    for (const char c : name.substr(0, longest)) out.push_back(static_cast<unsigned char>(c) < 0x20 ? '?' : c);
    return name.size() > longest ? out + "..." : out;
}

/// Line and column (both from 1, columns in characters) of the start of `where`, as "line 3, column 5".
std::string place_text(const SourceRange& where)
{
    if (!where.file) return "an unknown place";
    const std::string_view before = std::string_view(where.file->text).substr(0, where.begin);
    const std::string_view line = before.substr(before.rfind('\n') + 1); // the whole where there is no other
    return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'),
                       1 + std::ranges::count_if(line, begins_character));
}

} // namespace

const char* role_text(Role role)
{
    return role_texts[static_cast<std::size_t>(role)].first;
}

std::string role_plural(Role role)
{
    return role_texts[static_cast<std::size_t>(role)].second;
}

void Names::declare(const std::string& name, Role role, const SourceRange& where)
{
    constexpr std::size_t most_names = 4096;
    require_identifier(name, where, role == Role::momentum ? "the name of a momentum" : "a name");
    const char* other = name == "t" ? "the time" : is_reserved_name(name) ? "a built-in function" : nullptr;
    if (other != nullptr)
        throw ModelError(fmt::format("'{}' is {} and cannot be {}", name, other, role_text(role)), where,
                         "choose another name");
    const auto [place, fresh] = entries_.try_emplace(name, Entry{role, where});
    if (!fresh) {
        const Entry& first = place->second;
        const bool momentum = role == Role::momentum;
        const auto text = [&](const SourceRange& each) {
            return first.where.file == where.file ? place_text(each) : lagen::place(each);
        };
        throw ModelError(fmt::format("'{}' is declared twice: as {} at {} and as {} at {}", name, role_text(first.role),
                                     text(first.where), role_text(role), text(where)),
                         where, momentum ? "name the momenta: [fibre] momenta = [..]" : "rename one of them");
    }
    order_.push_back(name);
    if (order_.size() > most_names)
        throw ModelError(fmt::format("the model declares more than {} names", most_names), where);
}

void Names::declare_family(const std::string& name, const Shape& shape, Role role, const SourceRange& where)
{
    constexpr std::size_t most_entries = 16384;
    declare(name, role, where);
    family_entries_ += shape.size();
    if (family_entries_ > most_entries)
        throw ModelError(fmt::format("the families of the model have more than {} entries in all", most_entries),
                         where);
    for (std::size_t k = 0; k < shape.size(); ++k) entries_.emplace(entry_name(name, shape, k), Entry{role, where});
}

const Names::Entry* Names::find(const std::string& name) const
{
    const auto place = entries_.find(name);
    return place == entries_.end() ? nullptr : &place->second;
}

std::vector<std::string> Names::of(Role role) const
{
    std::vector<std::string> out;
    for (const std::string& name : order_) {
        if (entries_.at(name).role == role) out.push_back(name);
    }
    return out;
}

void require_identifier(const std::string& name, const SourceRange& where, const char* what)
{
    if (is_identifier(name)) return;
    throw ModelError(
        fmt::format("'{}' cannot be {}: letters, digits and '_' are allowed, and no digit first", name, what), where);
}

void require_class_name(const std::string& name, const SourceRange& where, bool from_file_name)
{
    constexpr std::size_t longest = 200;
    const std::string hint = from_file_name ? "give the model a name: name = \"my_model\""
                                            : "use letters, digits and '_', with no digit first, e.g. \"heavy_top\"";
    const std::string subject = from_file_name
                                    ? fmt::format("the file's stem '{}', which names the model,", shown(name))
                                    : fmt::format("the model name '{}'", shown(name));
    const auto refuse = [&](const char* why, const std::string& advice) {
        throw ModelError(subject + " " + why, where, advice);
    };
    const bool spelled =
        !name.empty() && (is_letter(name.front()) || name.front() == '_') &&
        std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
    if (!spelled) refuse("is not a C++ identifier", hint);
    if (name.size() > longest) refuse("is longer than 200 characters", {});
    if (reserved_words.find(" " + name + " ") != std::string_view::npos)
        refuse("is a reserved word of C++", "choose another name");
    const bool capital = name.size() > 1 && name[0] == '_' && name[1] >= 'A' && name[1] <= 'Z';
    if (capital || name.find("__") != std::string::npos)
        refuse("is of a form that C++ reserves for itself", "choose another name");
}

} // namespace lagen
