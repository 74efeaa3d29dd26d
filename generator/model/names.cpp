// SPDX-License-Identifier: GPL-2.0-or-later
/// Declarations and their clashes.
#include "model/names.hpp"

#include "expression/parse.hpp"
#include "expression/tree.hpp"
#include "model/table_reader.hpp"
#include "text/alphabet.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

const char* role_text(Role role)
{
    switch (role) {
    case Role::time: return "the time";
    case Role::size: return "a size";
    case Role::parameter: return "a parameter";
    case Role::base: return "a base coordinate";
    case Role::fibre: return "a fibre coordinate";
    case Role::ambient: return "an ambient fibre coordinate";
    case Role::momentum: return "a momentum";
    case Role::control: return "a control";
    case Role::state: return "a first-order state";
    case Role::input: return "an input";
    case Role::definition: return "a definition";
    case Role::casimir: return "a Casimir";
    case Role::observable: return "an observable";
    case Role::form: return "an E-form";
    case Role::element: return "an entry of the group element";
    case Role::next: return "a coordinate of the target";
    case Role::step: return "the step";
    case Role::velocity: return "an inner velocity";
    case Role::built_in: return "a built-in quantity";
    }
    return "a name";
}

std::string role_plural(Role role)
{
    if (role == Role::time) return "time";
    if (role == Role::momentum) return "momenta";
    if (role == Role::element) return "entries of the group element";
    if (role == Role::next) return "coordinates of the target";
    if (role == Role::step) return "the step";
    if (role == Role::built_in) return "built-in quantities";
    const std::string_view text = role_text(role);
    return std::string(text.substr(text.find(' ') + 1)) + "s";
}

std::string place_text(const SourceRange& where)
{
    if (!where.file) return "an unknown place";
    const std::string_view before = std::string_view(where.file->text).substr(0, where.begin);
    const std::string_view line = before.substr(before.rfind('\n') + 1); // the whole where there is no other
    return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'),
                       1 + std::ranges::count_if(line, begins_character));
}

void Names::declare(const std::string& name, Role role, const SourceRange& where)
{
    constexpr std::size_t most_names = 4096;
    require_identifier(name, where, role == Role::momentum ? "the name of a momentum" : "a name");
    if (name == "t") {
        throw ModelError(fmt::format("'t' is the time and cannot be {}", role_text(role)), where,
                         "choose another name");
    }
    if (is_reserved_name(name)) {
        throw ModelError(fmt::format("'{}' is a built-in function and cannot be {}", name, role_text(role)), where,
                         "choose another name");
    }
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
    if (order_.size() > most_names) {
        throw ModelError(fmt::format("the model declares more than {} names", most_names), where);
    }
}

void Names::declare_family(const std::string& name, const Shape& shape, Role role, const SourceRange& where)
{
    constexpr std::size_t most_entries = 16384;
    declare(name, role, where);
    family_entries_ += shape.size();
    if (family_entries_ > most_entries) {
        throw ModelError(fmt::format("the families of the model have more than {} entries in all", most_entries),
                         where);
    }
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

} // namespace lagen
