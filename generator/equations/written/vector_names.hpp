// SPDX-License-Identifier: GPL-2.0-or-later
/// Vectors of three and matrices of three by three among the declared names: families, and names with the numbers 1
/// to 3.
#pragma once

#include "model/model.hpp"
#include "typeset/equation_set.hpp"

#include <array>

namespace lagen {

struct VectorName {
    std::string name;
    std::array<std::string, 3> entries; ///< empty where a definition's entry is 0
    std::string latex = {};             ///< made of that of the entries; empty: from the name
    bool family = false;                ///< its entries are name[1] to name[3], or those of a row
};

struct MatrixName {
    std::string name;                   ///< "Jᵀ" of the transposed family
    std::array<std::string, 9> entries; ///< by rows; empty where an entry is 0
    bool diagonal = false;              ///< of three numbered parameters
};

struct VectorNames {
    std::vector<VectorName> vectors;
    std::vector<MatrixName> matrices;
    std::array<std::string, 3> basis = {}; ///< free names of e_1 to e_3; empty where a vector of the model is called e
};

/// Those of the symbols of `equations` and of what these stand for. Names with numbers are a vector where the name
/// without them is free: g1, g2, g3 beside a parameter g are none. Three numbered parameters of `model` may also be a
/// diagonal matrix.
[[nodiscard]] VectorNames vector_names(const EquationSet& equations, const Model& model);

} // namespace lagen
