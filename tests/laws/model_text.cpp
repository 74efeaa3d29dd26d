// SPDX-License-Identifier: GPL-2.0-or-later
/// Inline tables of formulas, pairs in either order.
#include "model_text.hpp"

#include <algorithm>

namespace lagen::laws {

std::string inline_table(const std::vector<std::string>& names, const std::vector<Formula>& values)
{
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        if (!values[k].is_zero()) text += (text.empty() ? "" : ", ") + names[k] + " = \"" + values[k].text() + '"';
    return text.empty() ? "" : "{ " + text + " }";
}

namespace {

void append_pair(std::string& text, const LocalAlgebroid& E, std::size_t a, std::size_t b,
                 const std::vector<Formula>& entries)
{
    std::string line = inline_table(E.fibre, entries);
    if (line.empty()) line = "{ " + E.fibre[0] + " = 0 }";
    text += "\"" + E.fibre[a] + "," + E.fibre[b] + "\" = " + line + "\n";
}

std::vector<Formula> column(const LocalAlgebroid& E, std::size_t a, std::size_t b)
{
    std::vector<Formula> entries;
    for (std::size_t c = 0; c < E.r(); ++c) entries.push_back(E.bracket(c, a, b));
    return entries;
}

} // namespace

std::string quoted_list(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return "[" + text + "]";
}

std::string model_head(const LocalAlgebroid& algebroid, const std::vector<std::string>& fibre)
{
    std::string text;
    if (!algebroid.parameters.empty()) text += "[parameters]\n";
    for (const std::string& name : algebroid.parameters) text += name + " = 1\n";
    if (algebroid.n() > 0) {
        text += "[base]\ncoordinates = " + quoted_list(algebroid.base) + "\n";
        std::vector<std::string> lines;
        for (const Formula& h : algebroid.constraints) lines.push_back(h.text());
        if (!lines.empty()) text += "constraints = " + quoted_list(lines) + "\n";
        lines.clear();
        for (const Formula& g : algebroid.positive) lines.push_back(g.text() + " > 0");
        if (!lines.empty()) text += "domain = " + quoted_list(lines) + "\n";
    }
    return text + "[fibre]\ncoordinates = " + quoted_list(fibre) + "\n";
}

std::string entries_text(const LocalAlgebroid& algebroid, const std::string& title)
{
    std::string text = algebroid.n() > 0 ? "[" + title + ".anchor]\n" : "";
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        std::vector<Formula> entries;
        for (std::size_t i = 0; i < algebroid.n(); ++i) entries.push_back(algebroid.anchor(i, a));
        const std::string line = inline_table(algebroid.base, entries);
        if (!line.empty()) text += algebroid.fibre[a] + " = " + line + "\n";
    }
    text += "[" + title + ".bracket]\n";
    for (std::size_t a = 0; a < algebroid.r(); ++a)
        for (std::size_t b = a + 1; b < algebroid.r(); ++b) {
            const auto second = std::find_if(algebroid.second_orders.begin(), algebroid.second_orders.end(),
                                             [&](const SecondOrder& s) { return s.a == a && s.b == b; });
            const std::vector<Formula> entries = column(algebroid, a, b);
            if (second != algebroid.second_orders.end()) {
                append_pair(text, algebroid, a, b, entries);
                append_pair(text, algebroid, b, a, second->entries);
            } else if (!inline_table(algebroid.fibre, entries).empty()) {
                const bool turned = (a + 2 * b) % 3 == 0;
                append_pair(text, algebroid, turned ? b : a, turned ? a : b,
                            turned ? column(algebroid, b, a) : entries);
            }
        }
    return text;
}

std::string model_text(const LocalAlgebroid& algebroid)
{
    return model_head(algebroid, algebroid.fibre) + "[algebroid]\nkind = \"general\"\n" +
           entries_text(algebroid, "algebroid");
}

} // namespace lagen::laws
