// SPDX-License-Identifier: GPL-2.0-or-later
/// LaTeX of every model in every form stands in a document: braces, scripts, words, ASCII.
#include "program.hpp"

#include "support/latex_defects.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;

namespace {

const std::vector<std::string> forms{"lagrange",   "hamilton", "pontryagin", "discrete", "exterior", "cartan",
                                     "invariants", "poisson",  "variations", "reaction", "projected"};

/// Whether the model has this form; where it has, its LaTeX is in order.
bool check_latex(const std::string& model, const std::string& form)
{
    INFO(model << ", " << form);
    const Outcome outcome = call({"derive", model + ".toml", "--form", form, "--format", "latex"});
    if (outcome.code != 0) return false;
    CHECK(outcome.out.starts_with("\\subsection*{"));
    CHECK(latex_defects(outcome.out) == "");
    return true;
}

} // namespace

TEST_CASE("defects of LaTeX are found")
{
    CHECK(latex_defects("\\paragraph{a $\\sigma$(t)} $\\dot\\sigma^a_b$\n\\begin{align*}\n x_{1}^{2} &= "
                        "{\\dot{y}_{i}}_{r} \\left(a\\right)^{2} \\mathit{k1\\_}\n\\end{align*}\n")
              .empty());
    for (const char* wrong :
         {"$a_{b}_c$", "$a^2^{3}$", "$\\mathit{a_b}$", "$\\left( x$", "$x}$", "a_b", "σ", "\\begin{align*} x", "$x"}) {
        INFO(wrong);
        CHECK(!latex_defects(wrong).empty());
    }
}

TEST_CASE("the LaTeX of a model is in order, of one form after the other", "[long]")
{
    std::size_t k = 0, found = 0;
    for (const std::string& model : example_models()) {
        if (k % 4 == 0) found += check_latex(model, "variations") ? 1U : 0U;
        found += check_latex(model, forms[k++ % forms.size()]) ? 1U : 0U;
    }
    CHECK(found > 40);
}

TEST_CASE("the LaTeX of every model is in order, of each form", "[all]")
{
    std::size_t found = 0;
    for (const std::string& model : example_models())
        for (const std::string& form : forms) found += check_latex(model, form) ? 1U : 0U;
    CHECK(found > 370);
}
