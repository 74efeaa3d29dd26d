// SPDX-License-Identifier: GPL-2.0-or-later
#include "equations/derive.hpp"

#include "equations/hamilton.hpp"
#include "equations/lagrange.hpp"
#include "equations/pontryagin.hpp"

namespace lagen {

EquationSet derive(const std::string& form, const Model& model, const VerifiedAlgebroid& verified)
{
    if (form == "lagrange") return derive_lagrange(model, verified.algebroid, verified.regularity);
    if (form == "hamilton") return derive_hamilton(model, verified.algebroid, verified.regularity);
    if (form == "pontryagin") return derive_pontryagin(model, verified.algebroid, verified.maximum);
    throw InternalError("there is no derivation called " + form);
}

} // namespace lagen
