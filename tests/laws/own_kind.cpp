// SPDX-License-Identifier: GPL-2.0-or-later
/// The tables [algebroid.sections], .connection, .of, .spanned_by and `representation`.
#include "own_kind.hpp"

#include "model_text.hpp"

namespace lagen::laws {
namespace {

/// Row `k` of a table with `columns` columns.
std::vector<Formula> row(const std::vector<Formula>& values, std::size_t k, std::size_t columns)
{
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k * columns);
    return {begin, begin + static_cast<std::ptrdiff_t>(columns)};
}

std::string inner_table(const LocalAlgebroid& inner)
{
    return "[algebroid.of]\nkind = \"general\"\nfibre = " + quoted_list(inner.fibre) + "\n" +
           entries_text(inner, "algebroid.of");
}

} // namespace

std::string frame_text(const LocalAlgebroid& inner, const Frame& frame)
{
    const std::vector<std::string> sections = numbered("f", inner.r());
    std::string text = model_head(inner, sections) + "[algebroid]\nkind = \"frame\"\n[algebroid.sections]\n";
    for (std::size_t a = 0; a < inner.r(); ++a)
        text += sections[a] + " = " + inline_table(inner.fibre, row(frame.A, a, inner.r())) + "\n";
    return text + inner_table(inner);
}

std::string atiyah_text(const LocalAlgebroid& structure, const std::vector<std::string>& base,
                        const std::vector<Formula>& connection)
{
    const std::size_t n = base.size(), s = structure.r();
    LocalAlgebroid vertical(base, numbered("e", n + s));
    vertical.parameters = structure.parameters;
    const std::vector<std::string> names(vertical.fibre.begin() + static_cast<std::ptrdiff_t>(n), vertical.fibre.end());
    std::string text =
        model_head(vertical, vertical.fibre) + "[algebroid]\nkind = \"atiyah\"\n[algebroid.connection]\n";
    for (std::size_t i = 0; i < n; ++i) {
        const std::string line = inline_table(names, row(connection, i, s));
        if (!line.empty()) text += base[i] + " = " + line + "\n";
    }
    LocalAlgebroid renamed = structure;
    renamed.fibre = names;
    return text + entries_text(renamed, "algebroid");
}

std::string prolongation_text(const LocalAlgebroid& inner, bool dual)
{
    const LocalAlgebroid result = prolongation(inner, dual);
    return model_head(result, result.fibre) + "[algebroid]\nkind = \"prolongation\"\nbundle = \"" +
           (dual ? "E*" : "E") + "\"\n" + inner_table(inner);
}

std::string subbundle_text(const LocalAlgebroid& algebroid)
{
    std::string text =
        model_head(algebroid, algebroid.fibre) + "[algebroid]\nkind = \"subbundle\"\n[algebroid.spanned_by]\n";
    for (std::size_t a = 0; a < algebroid.r(); ++a) {
        std::vector<Formula> column;
        for (std::size_t i = 0; i < algebroid.n(); ++i) column.push_back(algebroid.anchor(i, a));
        text += algebroid.fibre[a] + " = " + inline_table(algebroid.base, column) + "\n";
    }
    return text;
}

std::string lie_algebra_text(const LocalAlgebroid& algebra)
{
    return model_head(algebra, algebra.fibre) + "[algebroid]\nkind = \"lie_algebra\"\n" +
           entries_text(algebra, "algebroid");
}

std::string representation_text(const MatrixAlgebra& algebra, const LocalAlgebroid& algebroid)
{
    std::string matrices;
    for (const auto& matrix : algebra.basis) {
        matrices += matrices.empty() ? "[" : ", [";
        for (std::size_t i = 0; i < algebra.m; ++i) {
            matrices += i == 0 ? "[" : ", [";
            for (std::size_t j = 0; j < algebra.m; ++j)
                matrices += (j == 0 ? "\"" : ", \"") + matrix[i * algebra.m + j].get_str() + "\"";
            matrices += "]";
        }
        matrices += "]";
    }
    LocalAlgebroid brackets({}, algebroid.fibre);
    brackets.C = algebroid.C;
    return model_head(algebroid, algebroid.fibre) + "[algebroid]\nkind = \"action\"\nrepresentation = [" + matrices +
           "]\n" + entries_text(brackets, "algebroid");
}

} // namespace lagen::laws
