// SPDX-License-Identifier: GPL-2.0-or-later
/// The [about] block: texts, units and LaTeX of names, of a family at once or of single entries.
#include "model/complaints.hpp"
#include "model/families.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// The reason why a text cannot stand inside a formula, and where it is; npos: it can.
struct LatexDefect {
    std::size_t at = std::string::npos;
    const char* what = "";
};

LatexDefect latex_defect(const std::string& text)
{
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] == '\\' && k + 1 == text.size()) return {k, "ends in the middle of a command"};
        if (text[k] == '\\')
            ++k;
        else if (text[k] == '{')
            open.push_back(k);
        else if (text[k] == '}' && open.empty())
            return {k, "closes a brace that it does not open"};
        else if (text[k] == '}')
            open.pop_back();
        else if (std::string_view("$%&#").find(text[k]) != std::string_view::npos)
            return {k, "has a character that no formula may have"};
    }
    return open.empty() ? LatexDefect{} : LatexDefect{open.back(), "opens a brace that it does not close"};
}

Symbol read_entry(const Item& item)
{
    const auto text = [&](const char* key) { return item.at(key) ? item.at(key).text() : ""; };
    const Symbol about{item.name(), item.where(), text("text"), text("unit"), text("latex")};
    if (const LatexDefect defect = latex_defect(about.latex); defect.at != std::string::npos)
        throw ModelError(fmt::format("{} {}", item.at("latex").title(), defect.what),
                         item.at("latex").value().text.range(defect.at, defect.at + 1),
                         "write it as it stands between two $ in LaTeX, for instance '\\dot{\\theta}_1'");
    return about;
}

/// The LaTeX of an entry: the family's, with the indices below.
std::string entry_latex(const std::string& family, const std::string& name)
{
    if (family.empty()) return {};
    const std::size_t open = name.find('[') + 1;
    std::string indices = name.substr(open, name.size() - 1 - open);
    if (indices.size() == 3) std::erase(indices, ','); // two digits need no comma
    return with_below(family, indices);
}

/// The entry `about` for one of the symbols that its key names.
Symbol for_symbol(const Symbol& about, const std::string& name, const SourceRange& where)
{
    Symbol out = about;
    out.where = where;
    if (about.name != name && about.name == family_name(name)) out.latex = entry_latex(about.latex, name);
    out.name = name;
    return out;
}

/// Puts the text to what it is about. The number of symbols, or of observables, invariants and Casimirs, which have
/// notes, one a column; 0 for definitions and t.
std::size_t describe(Model& model, const Symbol& about)
{
    std::size_t count = 0;
    for_each_symbol(model, [&](Role role, Symbol& symbol) {
        if (role == Role::element || role == Role::next || !names_entry(about.name, symbol.name)) return;
        symbol = for_symbol(about, symbol.name, symbol.where);
        ++count;
    });
    if (count > 0) return count;
    for (const auto* list : {&model.observables, &model.invariants, &model.base.casimirs})
        for (const NamedTree& each : *list) {
            if (!names_entry(about.name, each.name)) continue;
            model.notes.push_back(for_symbol(about, each.name, about.where));
            ++count;
        }
    return count;
}

} // namespace

void read_about(ModelReader& reader)
{
    Model& model = reader.model;
    std::vector<std::string> known = reader.names.order();
    known.emplace_back("t");
    for (const NamedTree& invariant : reader.invariants) known.push_back(invariant.name);
    for (const bool families : {true, false}) // the text of an entry wins over that of its family, wherever it stands
        for (const Item& item : reader.at("about").items()) {
            const Symbol about = read_entry(item);
            const bool family = std::ranges::find(known, about.name) != known.end();
            if (family != families || describe(model, about) > 0) continue;
            if (!family)
                throw complain::names_no("[about]", item.name(), "name of the model", item.where(),
                                         hint_for(item.name(), known, "names"));
            model.notes.push_back(about);
        }
}

} // namespace lagen
