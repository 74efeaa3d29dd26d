// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/plot/labels.hpp"

#include "model/families.hpp"
#include "text/alphabet.hpp"
#include "text/comma_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <utility>

namespace lagen {

namespace {

constexpr std::size_t longest_label = 40, longest_legend = 60; ///< columns that an axis and a legend have

/// The letters of a command behind its backslash.
std::string command_at(const std::string& text, std::size_t at)
{
    std::size_t end = at;
    while (end < text.size() && std::isalpha(static_cast<unsigned char>(text[end])) != 0) ++end;
    return text.substr(at, end - at);
}

/// "∂" for the command "partial"; empty where it has no character.
std::string_view character_of(std::string_view command)
{
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> signs{
        {{"ell", "ℓ"}, {"partial", "∂"}, {"cdot", "·"}, {"times", "×"}}};
    for (const auto& [name, character] : signs)
        if (name == command) return character;
    const GreekLetter* greek = greek_letter_called(command);
    return greek == nullptr ? std::string_view() : greek->character;
}

/// "kg m^2/s" with its digits raised.
std::string raised(const std::string& unit)
{
    std::string out;
    for (std::size_t at = 0; at < unit.size(); ++at) {
        if (unit[at] != '^') {
            out += unit[at];
            continue;
        }
        const std::size_t digits = at + (unit.compare(at, 2, "^-") == 0 ? 2 : 1);
        const std::size_t end = std::min(unit.find_first_not_of("0123456789", digits), unit.size());
        out += raised_digits(unit.substr(at + 1, end - at - 1));
        at = end - 1;
    }
    return out;
}

std::string with_unit(const std::string& text, const std::string& unit)
{
    return unit.empty() || unit == "1" ? text : fmt::format("{} [{}]", text, raised(unit));
}

std::string symbol_text(const Symbol& symbol)
{
    const std::string characters = characters_of_latex(symbol.latex);
    return characters.empty() ? symbol.name : characters;
}

/// Their unit, where it is one.
std::string shared_unit(const std::vector<Symbol>& symbols)
{
    const bool shared =
        std::ranges::all_of(symbols, [&](const Symbol& each) { return each.unit == symbols.front().unit; });
    return shared ? symbols.front().unit : "";
}

std::vector<Symbol> without_repetition(const std::vector<Symbol>& symbols)
{
    std::set<std::string> seen;
    std::vector<Symbol> out;
    for (const Symbol& symbol : symbols)
        if (seen.insert(symbol.name).second) out.push_back(symbol);
    return out;
}

/// Several entries of one family: "x" for x[1], x[2], "Q[·,1]" for Q[1,1], Q[2,1]. Empty where they are of several.
std::string entries_text(const std::vector<Symbol>& symbols)
{
    const std::string first = symbols.front().name, family = family_name(first);
    std::size_t before = first.size(), behind = first.size();
    for (const Symbol& symbol : symbols) {
        const std::string& name = symbol.name;
        if (family_name(name) != family) return "";
        const auto front = std::mismatch(name.begin(), name.end(), first.begin(), first.end()).first - name.begin();
        const auto back = std::mismatch(name.rbegin(), name.rend(), first.rbegin(), first.rend()).first - name.rbegin();
        before = std::min(before, static_cast<std::size_t>(front));
        behind = std::min(behind, static_cast<std::size_t>(back));
    }
    const std::string text = first.substr(0, before) + "·" + first.substr(first.size() - behind);
    return text == family + "[·]" || text == family + "[·,·]" ? family : text;
}

/// The symbols of one coordinate of all curves.
std::vector<Symbol> along(const std::vector<std::vector<Symbol>>& curves, std::size_t axis)
{
    std::vector<Symbol> symbols;
    for (const auto& curve : curves) symbols.push_back(curve[axis]);
    return symbols;
}

/// `text`, its end cut off for dots where it has more columns.
std::string shortened(const std::string& text, std::size_t columns)
{
    return columns_of(text) <= columns ? text : whole_characters(text, columns - 3) + "...";
}

} // namespace

std::string characters_of_latex(const std::string& latex)
{
    std::string out, accent; // that of the next character
    const auto add = [&](const std::string& text) { out += text + std::exchange(accent, ""); };
    for (std::size_t at = 0; at < latex.size(); ++at) {
        const char c = latex[at];
        if (c == '\\') {
            const std::string command = command_at(latex, at + 1);
            const std::string_view character = character_of(command);
            if (command == "dot")
                accent = "\u0307";
            else if (character.empty())
                return "";
            else
                add(std::string(character));
            at += command.size();
        } else if (c == '_') {
            const bool braces = at + 1 < latex.size() && latex[at + 1] == '{';
            const std::size_t begin = at + (braces ? 2 : 1);
            const std::size_t end = braces ? latex.find('}', begin) : begin + 1;
            if (end == std::string::npos || end > latex.size()) return "";
            const std::string below = latex.substr(begin, end - begin);
            if (below.empty() || !std::ranges::all_of(below, [](char each) { return is_digit(each); })) return "";
            out += lowered_digits(below);
            at = braces ? end : begin;
        } else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == ' ') {
            if (c != ' ') add(std::string(1, c));
        } else
            return "";
    }
    return out;
}

Symbol symbol_of(const Model& model, const std::string& name)
{
    const std::vector<Symbol> states = symbols_of(model, Role::state), inputs = symbols_of(model, Role::input);
    std::vector<const std::vector<Symbol>*> lists{
        &model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta, &model.notes, &states, &inputs};
    if (model.control) lists.push_back(&model.control->controls);
    for (const auto* symbols : lists) {
        const auto found = std::ranges::find(*symbols, name, &Symbol::name);
        if (found != symbols->end()) return *found;
    }
    return {name, {}, {}, {}, {}};
}

std::string short_label(const Symbol& symbol)
{
    return with_unit(symbol_text(symbol), symbol.unit);
}

std::string panel_label(const std::string& text, const std::vector<Symbol>& symbols)
{
    return with_unit(text, shared_unit(symbols));
}

std::string axis_label(const std::vector<Symbol>& symbols)
{
    const std::vector<Symbol> all = without_repetition(symbols);
    if (all.size() == 1) {
        const std::string brief = short_label(all[0]), full = all[0].text + ", " + brief;
        return all[0].text.empty() || columns_of(full) > longest_label ? shortened(brief, longest_label) : full;
    }
    const std::string together = entries_text(all);
    const std::string full = with_unit(together.empty() ? comma_list(all, symbol_text) : together, shared_unit(all));
    return columns_of(full) <= longest_label ? full : shortened(short_label(all[0]), longest_label - 5) + ", ...";
}

std::vector<std::string> legends_of(const std::vector<std::vector<Symbol>>& curves)
{
    std::vector<std::string> legends(curves.size());
    if (curves.size() < 2) return legends;
    std::vector<std::vector<Symbol>> told(curves.size());
    bool units = false; // of one axis at least
    for (std::size_t axis = 0; axis < curves[0].size(); ++axis) {
        const std::vector<Symbol> symbols = along(curves, axis);
        if (without_repetition(symbols).size() < 2) continue;
        units = units || shared_unit(symbols).empty();
        for (std::size_t k = 0; k < curves.size(); ++k) told[k].push_back(symbols[k]);
    }
    for (std::size_t k = 0; k < curves.size(); ++k) {
        const std::string entries = told[k].size() > 1 && !units ? entries_text(told[k]) : "";
        for (const Symbol& symbol : told[k])
            legends[k] += (legends[k].empty() ? "" : ", ") + (units ? short_label(symbol) : symbol_text(symbol));
        legends[k] = shortened(entries.empty() ? legends[k] : entries, longest_legend);
    }
    return legends;
}

} // namespace lagen
