// SPDX-License-Identifier: GPL-2.0-or-later
/// Names of a model as LaTeX symbols: the user's own LaTeX where there is one, else Greek letters by name, trailing
/// digits and what follows '_' as subscripts, several letters in one \mathit.
#pragma once

#include "notation/equation_set.hpp"

#include <map>

namespace lagen {

class LatexNames {
  public:
    explicit LatexNames(const std::vector<SymbolText>& symbols);
    [[nodiscard]] std::string symbol(const std::string& name) const;
    [[nodiscard]] std::string dotted(const std::string& name) const;   ///< the time derivative
    [[nodiscard]] std::string raisable(const std::string& name) const; ///< in front of an exponent

  private:
    /// What stands before and behind the index of each entry: "p_{\omega" and "}" of p_{\omega_{1}}.
    struct FamilyLatex {
        std::string before, after;

        friend bool operator==(const FamilyLatex&, const FamilyLatex&) = default;
    };

    void tell_apart(const std::vector<SymbolText>& symbols);
    [[nodiscard]] std::string given(const std::string& name) const; ///< empty: it is made from the name
    [[nodiscard]] std::string family_symbol(const std::string& name) const;

    std::map<std::string, std::string> given_;
    std::map<std::string, FamilyLatex> families_; ///< by their names, where all entries are alike
};

/// Plain text for LaTeX: \ { } $ & # _ % ^ ~ as themselves.
[[nodiscard]] std::string escape_latex(std::string_view text);

} // namespace lagen
