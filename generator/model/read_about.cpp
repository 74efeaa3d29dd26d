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

/// Observables, invariants, definitions, Casimirs and t have no symbols: their texts are notes, one a column.
void note(Model& model, const Symbol& about)
{
    const auto before = model.notes.size();
    for (const auto* list : {&model.observables, &model.invariants, &model.base.casimirs}) {
        for (const NamedTree& each : *list)
            if (each.name != about.name && names_entry(about.name, each.name))
                model.notes.push_back(for_symbol(about, each.name, about.where));
    }
    if (model.notes.size() == before) model.notes.push_back(about);
}

/// Calls visit(symbol) for each symbol of the model that [about] may describe.
template <class Visit>
void for_each_symbol(Model& model, Visit visit)
{
    for (Parameter& parameter : model.parameters) visit(parameter.symbol);
    for (auto* list : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta})
        std::ranges::for_each(*list, visit);
    if (is_nonholonomic(model)) std::ranges::for_each(model.algebroid.of[0].fibre, visit);
    if (model.control) std::ranges::for_each(model.control->controls, visit);
    for (FirstOrderState& state : model.states) visit(state.symbol);
    for (Input& input : model.inputs) visit(input.symbol);
}

void describe(Model& model, const Symbol& about)
{
    bool found = false;
    for_each_symbol(model, [&](Symbol& symbol) {
        if (!names_entry(about.name, symbol.name)) return;
        symbol = for_symbol(about, symbol.name, symbol.where);
        found = true;
    });
    if (!found) note(model, about);
}

/// True for a single entry of a family, or of an observable that is a vector.
bool is_entry(Model& model, const std::string& name)
{
    bool found = false;
    for_each_symbol(model, [&](const Symbol& symbol) { found = found || names_entry(name, symbol.name); });
    for (const auto* list : {&model.observables, &model.invariants, &model.base.casimirs})
        for (const NamedTree& each : *list) found = found || names_entry(name, each.name);
    return found;
}

} // namespace

void read_about(ModelReader& reader)
{
    Model& model = reader.model;
    std::vector<std::string> known = reader.names.order();
    known.emplace_back("t");
    for (const auto& [key, value] : reader.invariants) known.push_back(key.text);
    std::vector<Symbol> entries;
    for (const Item& item : reader.at("about").items()) {
        const Symbol about = read_entry(item);
        const bool family = std::ranges::find(known, about.name) != known.end();
        if (!family && !is_entry(model, about.name))
            throw complain::names_no("[about]", item.name(), "name of the model", item.where(),
                                     hint_for(item.name(), known, "names"));
        // An entry's own text wins over that of its family, wherever it stands.
        if (family)
            describe(model, about);
        else
            entries.push_back(about);
    }
    for (const Symbol& about : entries) describe(model, about);
}

} // namespace lagen
