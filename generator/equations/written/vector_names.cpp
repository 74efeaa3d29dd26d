// SPDX-License-Identifier: GPL-2.0-or-later
/// Vectors and matrices among the names.
#include "equations/written/vector_terms.hpp"

#include <algorithm>
#include <set>

namespace lagen {
namespace {

/// "\\gamma" of "\\gamma_1" and "\\gamma_2"; nothing where they are not alike.
std::string without_numbers(const std::string& first, const std::string& second)
{
    const auto without = [](std::string text, const std::string& number) {
        const std::size_t at = text.find(number);
        return at == std::string::npos ? std::string() : text.erase(at, number.size());
    };
    for (const auto& [one, two] : {std::pair("_1", "_2"), std::pair("_{1}", "_{2}")})
        if (const std::string stem = without(first, one); !stem.empty() && stem == without(second, two)) return stem;
    return {};
}

/// True where a name would be taken for a basis vector: e, e3, e_3, e[3].
bool looks_like_basis(const std::string& name)
{
    return name == "e" || (name.starts_with('e') && name.find_first_of("_[0123456789") == 1);
}

class NameSearch {
  public:
    NameSearch(const EquationSet& equations, const Model& model) : equations_(equations)
    {
        for (const SymbolText& symbol : equations.symbols) add(symbol.name);
        for (const WhereEntry& entry : equations.where) {
            add(entry.symbol);
            if (entry.value->kind == TreeKind::number && entry.value->number == 0) zeros_.insert(entry.symbol);
        }
        for (const EquationBlock& block : equations.given) // claimed invariants
            for (const Equation& equation : block.equations)
                if (equation.left == LeftSide::symbol) add(equation.symbol);
        for (const Parameter& parameter : model.parameters) parameters_.insert(parameter.symbol.name);
        for (const std::string& taken : symbol_names(model)) declared_.insert(taken);
        declared_.insert({"t", "pi"});
        for (const EquationBlock& block : equations.blocks) // E, H
            for (const Equation& equation : block.equations) declared_.insert(equation.symbol);
    }

    [[nodiscard]] VectorNames find() const
    {
        VectorNames found;
        for (const std::string& name : names_) {
            if (name.ends_with("[1]"))
                take_family(name.substr(0, name.size() - 3), found);
            else if (name.ends_with("[1,1]")) {
                take_matrix(name.substr(0, name.size() - 5), found);
                take_rows(name.substr(0, name.size() - 5), found);
            } else if (name.ends_with('1'))
                take_numbered(name.substr(0, name.size() - 1), found);
        }
        if (std::ranges::none_of(declared_, looks_like_basis) &&
            std::ranges::find(found.vectors, "e", &VectorName::name) == found.vectors.end())
            found.basis = {"e_1", "e_2", "e_3"};
        return found;
    }

  private:
    void add(const std::string& name)
    {
        if (declared_.insert(name).second) names_.push_back(name);
    }

    [[nodiscard]] bool has(const std::string& name) const { return declared_.contains(name); }

    void take_family(const std::string& stem, VectorNames& found) const
    {
        if (has(stem + "[4]") || !has(stem + "[2]") || !has(stem + "[3]")) return;
        VectorName vector{stem, {stem + "[1]", stem + "[2]", stem + "[3]"}, {}, true};
        for (std::string& entry : vector.entries)
            if (zeros_.contains(entry)) entry.clear();
        found.vectors.push_back(std::move(vector));
    }

    void take_matrix(const std::string& stem, VectorNames& found) const
    {
        if (has(stem + "[4,1]") || has(stem + "[1,4]")) return;
        MatrixName matrix{stem, {}};
        for (std::size_t k = 0; k < 9; ++k) {
            matrix.entries[k] = stem + "[" + std::to_string(k / 3 + 1) + "," + std::to_string(k % 3 + 1) + "]";
            if (!has(matrix.entries[k])) return;
        }
        MatrixName transposed = matrix;
        transposed.name += "ᵀ";
        for (std::size_t k = 0; k < 9; ++k) transposed.entries[k] = matrix.entries[k % 3 * 3 + k / 3];
        found.matrices.push_back(matrix);
        found.matrices.push_back(transposed);
    }

    /// The rows of a matrix of three columns: R[1,:], R[2,:], ..
    void take_rows(const std::string& stem, VectorNames& found) const
    {
        if (has(stem + "[1,4]") || !has(stem + "[1,3]")) return;
        for (std::size_t row = 1; has(stem + "[" + std::to_string(row) + ",1]"); ++row) {
            const std::string begin = stem + "[" + std::to_string(row) + ",";
            found.vectors.push_back({begin + ":]", {begin + "1]", begin + "2]", begin + "3]"}, {}, true});
        }
    }

    void take_numbered(const std::string& stem, VectorNames& found) const
    {
        const std::string name = stem.ends_with('_') ? stem.substr(0, stem.size() - 1) : stem;
        if (name.empty() || has(name) || (name.back() >= '0' && name.back() <= '9')) return;
        if (has(stem + "0") || has(stem + "4") || !has(stem + "2") || !has(stem + "3")) return;
        found.vectors.push_back({name,
                                 {stem + "1", stem + "2", stem + "3"},
                                 without_numbers(latex_of_name(stem + "1"), latex_of_name(stem + "2"))});
        if (parameters_.contains(stem + "1"))
            found.matrices.push_back({name, {stem + "1", "", "", "", stem + "2", "", "", "", stem + "3"}, true});
    }

    [[nodiscard]] std::string latex_of_name(const std::string& name) const
    {
        const auto known = std::ranges::find(equations_.symbols, name, &SymbolText::name);
        return known == equations_.symbols.end() ? std::string() : known->latex;
    }

    const EquationSet& equations_;
    std::vector<std::string> names_; ///< as declared
    std::set<std::string> declared_, parameters_, zeros_;
};

} // namespace

VectorNames vector_names(const EquationSet& equations, const Model& model)
{
    return NameSearch(equations, model).find();
}

} // namespace lagen
