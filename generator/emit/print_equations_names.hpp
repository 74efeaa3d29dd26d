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
    std::map<std::string, std::string> given_;
};

/// Plain text for LaTeX: \ { } $ & # _ % ^ ~ as themselves.
[[nodiscard]] std::string escape_latex(std::string_view text);

} // namespace lagen
