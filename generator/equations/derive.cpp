// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/derive.hpp"

#include "equations/exterior.hpp"
#include "equations/hamilton.hpp"
#include "equations/lagrange.hpp"
#include "equations/pontryagin.hpp"
#include "model/scene_form.hpp"

namespace lagen {

std::vector<std::string> derivation_names()
{
    std::vector<std::string> names = form_names();
    names.emplace_back("exterior");
    return names;
}

EquationSet derive(const std::string& form, const Model& model, const System& system, const Report& report)
{
    if (form == "lagrange") return derive_lagrange(model, system.written.algebroid, report.regularity);
    if (form == "hamilton") return derive_hamilton(model, system.written.algebroid, report.regularity);
    if (form == "pontryagin") return derive_pontryagin(model, system.written.algebroid, report.maximum);
    if (form == "exterior") return derive_exterior(model, system.written.algebroid);
    throw InternalError("there is no derivation called " + form);
}

} // namespace lagen
