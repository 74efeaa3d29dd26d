// SPDX-License-Identifier: GPL-2.0-or-later
/// LaTeX symbols from identifiers.
#include "typeset/latex_names.hpp"

#include "expression/symbol.hpp"
#include "text/alphabet.hpp"
#include "text/diagnostic.hpp"

#include <algorithm>
#include <utility>

namespace lagen {
namespace {

/// A word without digits or '_'.
std::string word(const std::string& text)
{
    if (const GreekLetter* greek = greek_letter_called(text); greek != nullptr && greek->name == text)
        return "\\" + text;
    const bool ascii =
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (ascii) return text.size() == 1 ? text : "\\mathit{" + text + "}";
    std::string latex;
    for (std::size_t k = 0; k < text.size();) {
        const GreekLetter* found = greek_letter_at(text, k);
        if (found != nullptr && !found->latex.empty()) {
            k += found->character.size();
            std::string letter(found->latex);
            for (const auto& [mark, command] : {std::pair("̇", "\\dot{"), std::pair("̈", "\\ddot{")})
                if (std::string_view(text).substr(k).starts_with(mark)) {
                    letter = command + letter + "}";
                    k += std::string_view(mark).size();
                }
            latex += (latex.empty() ? "" : " ") + letter;
            continue;
        }
        const std::size_t length = std::max<std::size_t>(decode_utf8(text, k).length, 1);
        latex += "\\text{" + text.substr(k, length) + "}";
        k += length;
    }
    return latex;
}

/// \gamma_{1,more} of \gamma_{1}.
std::string with_subscript(const std::string& latex, const std::string& more)
{
    const std::size_t open = latex.find("_{");
    if (open != std::string::npos && latex.find('}', open) == latex.size() - 1)
        return latex.substr(0, latex.size() - 1) + "," + more + "}";
    return with_below(latex, more);
}

/// Where the first letter or command of a given symbol ends if a subscript follows it ("\\omega_1": 6), else 0.
std::size_t letter_before_subscript(const std::string& latex)
{
    std::size_t end = 1;
    if (!latex.empty() && latex[0] == '\\')
        while (end < latex.size() && is_letter(latex[end])) ++end;
    else if (latex.empty() || !is_letter(latex[0]))
        return 0;
    return end > 0 && end < latex.size() && latex[end] == '_' ? end : 0;
}

/// Where the indices of an entry of a family begin, "W[1,2]": 1; npos: there are none at the end.
std::size_t indices_begin(const std::string& name)
{
    return name.ends_with(']') ? name.rfind('[') : std::string::npos;
}

/// The indices as LaTeX has them: two single digits stand together, others with a comma.
std::string entry_indices(const std::string& name)
{
    const std::size_t open = indices_begin(name);
    std::string indices = name.substr(open + 1, name.size() - open - 2);
    const bool single = indices.size() == 3 && indices[1] == ',';
    return single ? std::string{indices[0], indices[2]} : indices;
}

/// The pieces between the '_' of a name: "V", "q[1]", "q[2]" of V_q[1]_q[2].
std::vector<std::string> pieces_of(const std::string& name)
{
    std::vector<std::string> pieces(1);
    for (const char c : name)
        if (c == '_')
            pieces.emplace_back();
        else
            pieces.back() += c;
    return pieces;
}

/// A name as it is, in a formula.
std::string spelled_out(const std::string& name)
{
    std::string latex = escape_latex(name);
    std::erase(latex, '$'); // around Greek letters; no name has one
    return "\\mathit{" + latex + "}";
}

constexpr std::string_view next = "_next";   ///< of a coordinate, of an arrow one step on
constexpr std::string_view transposed = "ᵀ"; ///< of a matrix in written equations
constexpr std::string_view variation = "δ";  ///< of a coordinate, of a momentum
constexpr std::string_view second = "δ²";    ///< of a Lagrangian
constexpr const char* transposed_latex = "^{\\mathsf{T}}";
constexpr const char* variation_latex = "\\delta ";
constexpr const char* second_latex = "\\delta^{2} ";

/// The name that is varied, "x" of "δx"; nothing of "δ", "δ_1" and "δ[1]", which are names of their own.
std::string varied_name(const std::string& name, std::string_view mark)
{
    const bool more = name.starts_with(mark) && name.size() > mark.size();
    return more && std::string_view("_[0123456789").find(name[mark.size()]) == std::string_view::npos
               ? name.substr(mark.size())
               : "";
}

} // namespace

std::string LatexNames::subscripted(const Parts& parts)
{
    return parts.subscript.empty() ? parts.body : parts.body + "_{" + parts.subscript + "}";
}

/// What stands behind a '_' and is the name of another quantity has its LaTeX.
LatexNames::Parts LatexNames::split(const std::string& name) const
{
    Parts parts;
    if (name.ends_with(transposed))
        return {subscripted(split(name.substr(0, name.size() - transposed.size()))) + transposed_latex, ""};
    const std::size_t first = name.find('_', 1);
    const std::string rest = first == std::string::npos ? "" : name.substr(first + 1);
    if (indices_begin(rest) == rest.find('[') && known_.contains(rest.substr(0, rest.find('['))))
        return {subscripted(split(name.substr(0, first))), symbol(rest)}; // p_v_x is the momentum of v_x
    const std::size_t open = indices_begin(name);
    if (open != std::string::npos && name.find('[') == open) { // the only ones
        parts = split(name.substr(0, open));
        parts.subscript += (parts.subscript.empty() ? "" : ",") + entry_indices(name);
        return parts;
    }
    for (const std::string& piece : pieces_of(name)) {
        std::string inner;
        if (!parts.body.empty() && (indices_begin(piece) != std::string::npos || !given(piece).empty())) {
            inner = symbol(piece);
        } else {
            std::size_t digits = piece.size();
            while (digits > 0 && is_digit(piece[digits - 1])) --digits;
            const std::string body = digits == 0 ? "" : word(piece.substr(0, digits));
            const std::string number = piece.substr(digits);
            if (parts.body.empty()) {
                parts.body = body;
                if (!body.empty() && !number.empty()) parts.subscript = number;
                continue;
            }
            inner = body.empty() ? number : subscripted({body, number});
        }
        if (!inner.empty()) parts.subscript += (parts.subscript.empty() ? "" : ",") + inner;
    }
    if (name.ends_with('_')) parts.subscript += "\\_"; // another quantity than the name without it
    if (parts.body.empty()) return {spelled_out(name), ""};
    return parts;
}

LatexNames::LatexNames(const std::vector<SymbolText>& symbols)
{
    std::set<std::string> uneven;
    for (const SymbolText& symbol : symbols) {
        if (!symbol.latex.empty()) given_.emplace(symbol.name, symbol.latex);
        const std::size_t open = indices_begin(symbol.name);
        known_.insert(symbol.name.substr(0, open));
        if (open == std::string::npos) continue;
        const std::string stem = symbol.name.substr(0, open);
        const std::optional<FamilyLatex> latex = family_of(symbol.latex, entry_indices(symbol.name));
        if (!latex || families_.emplace(stem, *latex).first->second != *latex) uneven.insert(stem);
    }
    for (const std::string& stem : uneven) families_.erase(stem);
    tell_apart(symbols);
}

std::optional<LatexNames::FamilyLatex> LatexNames::family_of(const std::string& latex, const std::string& indices)
{
    for (const std::string opens : {"_{", ","})
        if (const std::size_t at = latex.find(opens + indices + "}"); at != std::string::npos)
            return FamilyLatex{latex.substr(0, at), opens, latex.substr(at + opens.size() + indices.size() + 1)};
    return {};
}

/// k1 beside k[1], whose LaTeX is k_{1}, is spelled out; and the second of two that [about] gives the same.
void LatexNames::tell_apart(const std::vector<SymbolText>& symbols)
{
    std::map<std::string, std::string> names;
    for (const bool given : {true, false})
        for (const bool entries : {true, false})
            for (const SymbolText& each : symbols) {
                const std::size_t open = indices_begin(each.name);
                if (each.latex.empty() == given || (open != std::string::npos) != entries) continue;
                if (names.emplace(symbol(each.name), each.name).first->second == each.name) continue;
                given_.insert_or_assign(each.name, spelled_out(each.name));
                if (open != std::string::npos) families_.erase(each.name.substr(0, open));
            }
}

/// The LaTeX of an entry or, without indices, of the whole family.
std::string LatexNames::family_symbol(const std::string& name) const
{
    const std::size_t open = indices_begin(name);
    const auto family = families_.find(name.substr(0, open));
    if (family == families_.end()) return {};
    const auto& [before, opens, after] = family->second;
    const bool own = opens == "_{"; // a subscript of the indices alone
    if (open == std::string::npos) return before + (own ? "" : "}") + after;
    return before + opens + entry_indices(name) + "}" + after;
}

std::string LatexNames::given(const std::string& name) const
{
    if (name.ends_with(transposed)) {
        const std::string latex = given(name.substr(0, name.size() - transposed.size()));
        return latex.empty() ? latex : latex + transposed_latex;
    }
    const auto known = given_.find(name);
    if (known != given_.end()) return known->second;
    const std::size_t open = std::min(indices_begin(name), name.size());
    if (const std::string stem = name.substr(0, open); stem.ends_with(next)) {
        const std::string latex = given(stem.substr(0, stem.size() - next.size()) + name.substr(open));
        return latex.empty() ? latex : with_subscript(latex, "\\mathit{next}");
    }
    if (const std::string twice = varied_name(name, second); !twice.empty()) return second_latex + symbol(twice);
    if (const std::string once = varied_name(name, variation); !once.empty()) return variation_latex + symbol(once);
    return family_symbol(name);
}

std::string LatexNames::symbol(const std::string& name) const
{
    const std::string latex = given(name);
    return latex.empty() ? subscripted(split(name)) : latex;
}

std::string LatexNames::dotted(const std::string& name) const
{
    if (const std::string latex = given(name); !latex.empty()) {
        if (latex.starts_with("\\dot") && latex.size() > 4 && !is_letter(latex[4])) return "\\ddot" + latex.substr(4);
        if (latex.starts_with(variation_latex)) return "\\frac{d}{dt} " + latex;
        const std::size_t letter = letter_before_subscript(latex);
        if (letter == 0) return "\\dot{" + latex + "}";
        return "\\dot{" + latex.substr(0, letter) + "}" + latex.substr(letter);
    }
    const Parts parts = split(name);
    return subscripted({"\\dot{" + parts.body + "}", parts.subscript});
}

std::string LatexNames::raisable(const std::string& name) const
{
    const std::string latex = given(name);
    return latex.empty() ? subscripted(split(name)) : "{" + latex + "}";
}

std::string escape_latex(std::string_view text)
{
    std::string escaped;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (const GreekLetter* greek = greek_letter_at(text, k); greek != nullptr && !greek->latex.empty()) {
            escaped.append("$").append(greek->latex).append("$");
            k += greek->character.size() - 1;
            continue;
        }
        const char c = text[k];
        switch (c) {
        case '\\': escaped += "\\textbackslash{}"; break;
        case '^': escaped += "\\textasciicircum{}"; break;
        case '~': escaped += "\\textasciitilde{}"; break;
        case '{':
        case '}':
        case '$':
        case '&':
        case '#':
        case '_':
        case '%': escaped += std::string("\\") + c; break;
        default: escaped += c;
        }
    }
    return escaped;
}

} // namespace lagen
