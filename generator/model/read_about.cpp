// SPDX-License-Identifier: GPL-2.0-or-later
/// The [about] block: texts, units and LaTeX of names, of a family at once or of single entries.
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

/// What keeps a text from standing inside a formula, and where; npos: nothing does.
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

std::string read_latex(const TomlValue& value, const std::string& name)
{
    std::string text = read_text(value, fmt::format("the latex of '{}'", name));
    const LatexDefect defect = latex_defect(text);
    if (defect.at != std::string::npos)
        throw ModelError(fmt::format("the latex of '{}' {}", name, defect.what),
                         value.text.range(defect.at, defect.at + 1),
                         "write it as it stands between two $ in LaTeX, for instance '\\dot{\\theta}_1'");
    return text;
}

Symbol read_entry(const TomlEntry& entry)
{
    TableReader table(entry.value, fmt::format("'{}' of [about]", entry.name()),
                      fmt::format("write {} = {{ text = \"..\", unit = \"..\", latex = \"..\" }}", entry.name()));
    Symbol about{entry.name(), entry.where(), {}, {}, {}};
    const auto take = [&](const char* key, std::string& text) {
        const TomlEntry* field = table.take(key);
        if (field != nullptr) text = read_text(field->value, fmt::format("the {} of '{}'", key, entry.name()));
    };
    take("text", about.text);
    take("unit", about.unit);
    if (const TomlEntry* latex = table.take("latex")) about.latex = read_latex(latex->value, entry.name());
    table.finish();
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

/// What `about` says, for one of the symbols that its key names.
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

void describe(Model& model, const Symbol& about)
{
    bool found = false;
    const auto apply = [&](Symbol& symbol) {
        if (!names_entry(about.name, symbol.name)) return;
        symbol = for_symbol(about, symbol.name, symbol.where);
        found = true;
    };
    for (Parameter& parameter : model.parameters) apply(parameter.symbol);
    for (auto* list : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta})
        std::for_each(list->begin(), list->end(), apply);
    if (is_nonholonomic(model)) std::ranges::for_each(model.algebroid.of[0].fibre, apply);
    if (model.control) std::for_each(model.control->controls.begin(), model.control->controls.end(), apply);
    for (FirstOrderState& state : model.states) apply(state.symbol);
    for (Input& input : model.inputs) apply(input.symbol);
    if (!found) note(model, about);
}

/// True for a single entry of a family, or of an observable that is a vector.
bool is_entry(const Model& model, const std::string& name)
{
    const auto is_named = [&](const auto& each) { return names_entry(name, each.name); };
    const auto has_name = [&](const auto& each) { return is_named(each.symbol); };
    bool found = std::ranges::any_of(model.parameters, has_name) || std::ranges::any_of(model.states, has_name) ||
                 std::ranges::any_of(model.inputs, has_name);
    for (const auto* list : {&model.base.coordinates, &model.fibre.coordinates, &model.fibre.momenta})
        found = found || std::any_of(list->begin(), list->end(), is_named);
    if (model.control) found = found || std::ranges::any_of(model.control->controls, is_named);
    for (const auto* list : {&model.observables, &model.invariants, &model.base.casimirs})
        found = found || std::any_of(list->begin(), list->end(), is_named);
    return found;
}

} // namespace

void read_about(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    const TableReader blocks(block->value, "[about]");
    Model& model = reader.model;
    std::vector<std::string> known = reader.names.order();
    known.emplace_back("t");
    for (const auto& [key, value] : reader.invariants) known.push_back(key.text);
    std::vector<Symbol> entries;
    for (const TomlEntry& entry : block->value.entries) {
        Symbol about = read_entry(entry);
        const bool family = std::find(known.begin(), known.end(), about.name) != known.end();
        if (!family && !is_entry(model, about.name)) {
            throw ModelError(fmt::format("[about] describes '{}', which the model does not declare", entry.name()),
                             entry.where(), hint_for(entry.name(), known, "names"));
        }
        // What is said of an entry wins over what is said of its family, wherever it stands.
        if (family) {
            describe(model, about);
        } else {
            entries.push_back(std::move(about));
        }
    }
    for (const Symbol& about : entries) describe(model, about);
}

} // namespace lagen
