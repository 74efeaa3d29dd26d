// SPDX-License-Identifier: GPL-2.0-or-later
/// The [hamilton_jacobi] block: `S = expr`, or `alpha = {a = expr}`, a section of E* over the base.
#include "model/components.hpp"
#include "model/read_values.hpp"
#include "model/table_reader.hpp"

namespace lagen {

namespace {

constexpr const char* candidate_example = "S = \"a*x\", or alpha = { v_x = \"a\" }";

} // namespace

void read_hamilton_jacobi(ModelReader& reader, const TomlEntry* block)
{
    if (block == nullptr) return;
    refuse_nonholonomic(reader, *block);
    Model& model = reader.model;
    if (!model.lagrangian && !model.hamiltonian)
        throw ModelError("[hamilton_jacobi] stands in a model without a Hamiltonian", block->where(),
                         "give [hamiltonian] H, or [lagrangian] L");
    TableReader table(block->value, "[hamilton_jacobi]", candidate_example);
    const TomlEntry* S = table.take("S");
    const TomlEntry* alpha = table.take("alpha");
    table.finish();
    if ((S == nullptr) == (alpha == nullptr))
        throw ModelError(S == nullptr ? "[hamilton_jacobi] has neither S nor alpha"
                                      : "[hamilton_jacobi] has S and alpha, where one of them is the candidate",
                         block->where(), candidate_example);
    HamiltonJacobi& candidate = model.hamilton_jacobi.emplace();
    candidate.where = block->where();
    if (S != nullptr)
        candidate.S = reader.close(read_expression(S->value, "S of [hamilton_jacobi]"), {Role::parameter, Role::base},
                                   "S of [hamilton_jacobi]");
    else
        candidate.alpha = read_components(
            reader, *alpha,
            {"'alpha' of [hamilton_jacobi]", "the component of alpha on", {Role::parameter, Role::base}, false});
}

} // namespace lagen
