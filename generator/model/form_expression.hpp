// SPDX-License-Identifier: GPL-2.0-or-later
/// Expressions in forms: names of forms, d(A), wedge(A, B, ..), i(s, A), sums, and products with functions.
#pragma once

#include "model/model_reader.hpp"

namespace lagen {

/// Throws ModelError where a form of this degree has more components than can be looked at one by one.
void require_few_components(std::size_t degree, std::size_t rank, const std::string& what, const SourceRange& where);

/// Once the forms of the model are read. A section s is the name of a fibre coordinate, for the basis section e_s, or a
/// vector of r components. `what` opens messages. Throws ModelError: a sum of different degrees, a product of two
/// forms, i of a function, an unknown name, a wrong number of arguments.
[[nodiscard]] FormExpression read_form_expression(const ModelReader& reader, const Tree& tree, const std::string& what);

} // namespace lagen
