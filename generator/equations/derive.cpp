// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/derive.hpp"

#include "equations/cartan.hpp"
#include "equations/discrete.hpp"
#include "equations/exterior.hpp"
#include "equations/hamilton.hpp"
#include "equations/lagrange.hpp"
#include "equations/lagrangian_cartan.hpp"
#include "equations/poisson.hpp"
#include "equations/pontryagin.hpp"
#include "model/form.hpp"
#include "model/scene_form.hpp"

namespace lagen {

std::vector<std::string> derivation_names()
{
    std::vector<std::string> names = form_names();
    for (const char* more : {"exterior", "cartan", "poisson"}) names.emplace_back(more);
    return names;
}

EquationSet derive(const std::string& form, const Model& model, const System& system, const Report& report,
                   const std::vector<Tree>& brackets)
{
    const WrittenAlgebroid& algebroid = system.written.algebroid;
    if (form == "exterior") return derive_exterior(model, system);
    if (form == "poisson") return derive_poisson(model, system, report.mechanics.regularity, brackets);
    if (form == "cartan") {
        const bool discrete = system.discrete && (system.discrete->written || !system.lagrangian);
        return discrete ? derive_cartan(model, system)
                        : derive_lagrangian_cartan(model, system, report.mechanics.regularity);
    }
    switch (form_named(form).kind) {
    case FormKind::lagrange: return derive_lagrange(model, algebroid, report.mechanics.regularity);
    case FormKind::hamilton: return derive_hamilton(model, algebroid, report.mechanics.regularity);
    case FormKind::pontryagin: return derive_pontryagin(model, algebroid, report.control.maximum);
    case FormKind::discrete: return derive_discrete(model, system);
    }
    throw InternalError("a form without equations");
}

} // namespace lagen
