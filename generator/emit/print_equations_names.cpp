// SPDX-License-Identifier: GPL-2.0-or-later
/// LaTeX symbols from identifiers.
#include "emit/print_equations_names.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

constexpr const char* greek_names[] = {
    "alpha", "beta",  "gamma",  "delta", "epsilon", "zeta",  "eta",     "theta", "iota", "kappa", "lambda", "mu",
    "nu",    "xi",    "pi",     "rho",   "sigma",   "tau",   "upsilon", "phi",   "chi",  "psi",   "omega",  "Gamma",
    "Delta", "Theta", "Lambda", "Xi",    "Pi",      "Sigma", "Upsilon", "Phi",   "Psi",  "Omega"};

struct GreekLetter {
    const char* letter;
    const char* latex;
};

/// Capital letters that look Latin have no LaTeX command of their own.
constexpr GreekLetter greek_letters[] = {
    {"α", "\\alpha"},   {"β", "\\beta"},     {"γ", "\\gamma"}, {"δ", "\\delta"},    {"ε", "\\varepsilon"},
    {"ζ", "\\zeta"},    {"η", "\\eta"},      {"θ", "\\theta"}, {"ι", "\\iota"},     {"κ", "\\kappa"},
    {"λ", "\\lambda"},  {"μ", "\\mu"},       {"ν", "\\nu"},    {"ξ", "\\xi"},       {"ο", "o"},
    {"π", "\\pi"},      {"ρ", "\\rho"},      {"σ", "\\sigma"}, {"ς", "\\varsigma"}, {"τ", "\\tau"},
    {"υ", "\\upsilon"}, {"φ", "\\varphi"},   {"χ", "\\chi"},   {"ψ", "\\psi"},      {"ω", "\\omega"},
    {"ϕ", "\\phi"},     {"ϑ", "\\vartheta"}, {"Γ", "\\Gamma"}, {"Δ", "\\Delta"},    {"Θ", "\\Theta"},
    {"Λ", "\\Lambda"},  {"Ξ", "\\Xi"},       {"Π", "\\Pi"},    {"Σ", "\\Sigma"},    {"Υ", "\\Upsilon"},
    {"Φ", "\\Phi"},     {"Ψ", "\\Psi"},      {"Ω", "\\Omega"}};

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// A word without digits or '_'.
std::string word(const std::string& text)
{
    if (std::find(std::begin(greek_names), std::end(greek_names), text) != std::end(greek_names)) return "\\" + text;
    const bool ascii =
        std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    if (ascii) return text.size() == 1 ? text : "\\mathit{" + text + "}";
    std::string latex;
    for (std::size_t k = 0; k < text.size();) {
        const auto found =
            std::find_if(std::begin(greek_letters), std::end(greek_letters), [&](const GreekLetter& entry) {
                return text.compare(k, std::string_view(entry.letter).size(), entry.letter) == 0;
            });
        if (found != std::end(greek_letters)) {
            latex += std::string(latex.empty() ? "" : " ") + found->latex;
            k += std::string_view(found->letter).size();
            continue;
        }
        std::size_t end = k + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
        latex += "\\text{" + text.substr(k, end - k) + "}";
        k = end;
    }
    return latex;
}

/// Body and subscript of an identifier; the subscript may be empty.
struct Parts {
    std::string body;
    std::string subscript;
};

std::string subscripted(const Parts& parts)
{
    return parts.subscript.empty() ? parts.body : parts.body + "_{" + parts.subscript + "}";
}

/// \gamma_{1,more} of \gamma_{1}.
std::string with_subscript(const std::string& latex, const std::string& more)
{
    const std::size_t open = latex.find("_{");
    if (open != std::string::npos && latex.find('}', open) == latex.size() - 1)
        return latex.substr(0, latex.size() - 1) + "," + more + "}";
    const bool plain = latex.find_first_of("_^ ") == std::string::npos;
    return (plain ? latex : "{" + latex + "}") + "_{" + more + "}";
}

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
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

/// What stands between the '_' of a name: "V", "q[1]", "q[2]" of V_q[1]_q[2].
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

constexpr std::string_view next = "_next";   ///< of a coordinate, of an arrow one step on
constexpr std::string_view transposed = "ᵀ"; ///< of a matrix in written equations
constexpr const char* transposed_latex = "^{\\mathsf{T}}";

Parts split(const std::string& name)
{
    Parts parts;
    if (name.ends_with(transposed))
        return {subscripted(split(name.substr(0, name.size() - transposed.size()))) + transposed_latex, ""};
    const std::size_t open = indices_begin(name);
    if (open != std::string::npos && name.find('[') == open) { // the only ones
        parts = split(name.substr(0, open));
        parts.subscript += (parts.subscript.empty() ? "" : ",") + entry_indices(name);
        return parts;
    }
    for (const std::string& piece : pieces_of(name)) {
        std::string inner;
        if (indices_begin(piece) != std::string::npos && !parts.body.empty()) {
            inner = subscripted(split(piece));
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
    if (parts.body.empty()) return {"\\mathit{" + escape_latex(name) + "}", ""};
    return parts;
}

} // namespace

LatexNames::LatexNames(const std::vector<SymbolText>& symbols)
{
    std::set<std::string> uneven;
    for (const SymbolText& symbol : symbols) {
        if (!symbol.latex.empty()) given_.emplace(symbol.name, symbol.latex);
        const std::size_t open = indices_begin(symbol.name);
        if (open == std::string::npos) continue;
        const std::string indices = "_{" + entry_indices(symbol.name) + "}";
        const std::size_t at = symbol.latex.find(indices);
        const std::string stem = symbol.name.substr(0, open);
        if (at == std::string::npos) {
            uneven.insert(stem);
            continue;
        }
        const FamilyLatex latex{symbol.latex.substr(0, at), symbol.latex.substr(at + indices.size())};
        if (families_.emplace(stem, latex).first->second != latex) uneven.insert(stem);
    }
    for (const std::string& stem : uneven) families_.erase(stem);
    tell_apart(symbols);
}

/// k1 beside k[1], whose LaTeX is k_{1}, is spelled out.
void LatexNames::tell_apart(const std::vector<SymbolText>& symbols)
{
    std::map<std::string, std::string> names;
    for (const bool entries : {true, false})
        for (const SymbolText& each : symbols)
            if ((indices_begin(each.name) != std::string::npos) == entries &&
                names.emplace(symbol(each.name), each.name).first->second != each.name && each.latex.empty())
                given_.emplace(each.name, "\\mathit{" + escape_latex(each.name) + "}");
}

/// Of an entry or, without indices, of the whole family.
std::string LatexNames::family_symbol(const std::string& name) const
{
    const std::size_t open = indices_begin(name);
    const auto family = families_.find(name.substr(0, open));
    if (family == families_.end()) return {};
    const std::string indices = open == std::string::npos ? "" : "_{" + entry_indices(name) + "}";
    return family->second.before + indices + family->second.after;
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
    for (const char c : text) {
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
