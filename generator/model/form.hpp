// SPDX-License-Identifier: GPL-2.0-or-later
/// The forms of the equations of motion: what is known of each stands in its one row. Where a form has an algorithm of
/// its own (its equations, its kernels) a switch over FormKind without a default chooses it, so that the compiler names
/// what a new form lacks.
#pragma once

#include "model/model.hpp"

namespace lagen {

enum class FormKind { lagrange, hamilton, pontryagin, discrete };

struct EquationForm {
    FormKind kind = FormKind::lagrange;
    const char* name = "";             ///< as on the command line and in a scene
    const char* suffix = "";           ///< of the generated class and its file, behind the model's name
    const char* lane_group = "";       ///< the struct of the state's lanes behind the base coordinates
    const char* lanes = "";            ///< what they are
    bool momenta = false;              ///< are they the momenta? Else the fibre coordinates
    bool steps = false;                ///< a motion from step to step, of which there are no rates
    const char* needs = "";            ///< what a model lacks that has not this form: "no [control]"
    bool (*exists)(const Model&) = {}; ///< does the model have what it needs?
    int rank = 0;                      ///< the form of lowest rank that a model has is its default
};

/// Every form that lagen derives, generates and runs, in the order of the enumeration.
[[nodiscard]] std::span<const EquationForm> form_table();
[[nodiscard]] const EquationForm& entry_of(FormKind kind);
/// Throws InternalError where there is no such form.
[[nodiscard]] const EquationForm& form_named(const std::string& name);
[[nodiscard]] bool is_form(const std::string& name, FormKind kind);

} // namespace lagen
