// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/form.hpp"

#include <algorithm>
#include <array>

namespace lagen {

namespace {

constexpr std::array form_rows{
    EquationForm{.kind = FormKind::lagrange,
                 .name = "lagrange",
                 .suffix = "",
                 .lane_group = "Fibre",
                 .lanes = "fibre coordinates",
                 .momenta = false,
                 .needs = "no [lagrangian]",
                 .exists = [](const Model& model) { return model.lagrangian != nullptr; },
                 .rank = 1},
    EquationForm{
        .kind = FormKind::hamilton,
        .name = "hamilton",
        .suffix = "_hamilton",
        .lane_group = "Momenta",
        .lanes = "momenta",
        .momenta = true,
        .needs = "neither [hamiltonian] nor [lagrangian]",
        .exists = [](const Model& model) { return model.lagrangian != nullptr || model.hamiltonian != nullptr; },
        .rank = 2},
    EquationForm{.kind = FormKind::pontryagin,
                 .name = "pontryagin",
                 .suffix = "_pontryagin",
                 .lane_group = "Momenta",
                 .lanes = "momenta",
                 .momenta = true,
                 .needs = "no [control]",
                 .exists = [](const Model& model) { return model.control.has_value(); },
                 .rank = 0},
    EquationForm{.kind = FormKind::discrete,
                 .name = "discrete",
                 .suffix = "_discrete",
                 .lane_group = "Momenta",
                 .lanes = "momenta",
                 .momenta = true,
                 .steps = true,
                 .needs = "no [discrete]",
                 .exists = [](const Model& model) { return model.discrete.has_value(); },
                 .rank = -1},
};

static_assert([] {
    for (std::size_t k = 0; k < form_rows.size(); ++k)
        if (form_rows[k].kind != static_cast<FormKind>(k) || form_rows[k].exists == nullptr) return false;
    return form_rows.back().kind == FormKind::discrete;
}()); // in the order of the enumeration, to its last entry

} // namespace

std::span<const EquationForm> form_table()
{
    return form_rows;
}

const EquationForm& entry_of(FormKind kind)
{
    return form_rows[static_cast<std::size_t>(kind)];
}

const EquationForm& form_named(const std::string& name)
{
    const auto* const row =
        std::ranges::find_if(form_rows, [&](const EquationForm& form) { return name == form.name; });
    if (row == form_rows.end()) throw InternalError("there is no form called " + name);
    return *row;
}

bool is_form(const std::string& name, FormKind kind)
{
    return name == entry_of(kind).name;
}

} // namespace lagen
