// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as LaTeX symbols: the user's own LaTeX where there is one, else Greek letters by name, trailing
/// digits and what follows '_' as subscripts, several letters in one \mathit, "δx" as the variation of x.
#pragma once

#include "typeset/equation_set.hpp"

#include <map>
#include <optional>
#include <set>

namespace lagen {

class LatexNames {
  public:
    explicit LatexNames(const std::vector<SymbolText>& symbols);
    [[nodiscard]] std::string symbol(const std::string& name) const;
    [[nodiscard]] std::string dotted(const std::string& name) const;   ///< the time derivative
    [[nodiscard]] std::string raisable(const std::string& name) const; ///< in front of an exponent

  private:
    /// Body and subscript of an identifier; the subscript may be empty.
    struct Parts {
        std::string body;
        std::string subscript;
    };

    /// What stands around the indices of each entry: "p_{\omega", "_{" and "}" of p_{\omega_{1}}, "v_{x", "," and "" of
    /// v_{x,1}.
    struct FamilyLatex {
        std::string before, opens, after;

        friend bool operator==(const FamilyLatex&, const FamilyLatex&) = default;
    };

    [[nodiscard]] static std::string subscripted(const Parts& parts);
    [[nodiscard]] Parts split(const std::string& name) const;
    [[nodiscard]] static std::optional<FamilyLatex> family_of(const std::string& latex, const std::string& indices);
    void tell_apart(const std::vector<SymbolText>& symbols);
    [[nodiscard]] std::string given(const std::string& name) const; ///< empty: it is made from the name
    [[nodiscard]] std::string family_symbol(const std::string& name) const;

    std::set<std::string> known_; ///< names, of families without indices
    std::map<std::string, std::string> given_;
    std::map<std::string, FamilyLatex> families_; ///< by their names, where all entries are alike
};

/// Plain text for LaTeX: \ { } $ & # _ % ^ ~ as themselves, Greek letters as symbols.
[[nodiscard]] std::string escape_latex(std::string_view text);

} // namespace lagen
