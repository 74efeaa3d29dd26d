// SPDX-License-Identifier: GPL-2.0-or-later
/// The forms of the equations of motion: what is known of each stands in its one row. Where a form has an algorithm of
/// its own (its equations, its kernels) a switch over FormKind without a default chooses it, so that the compiler names
/// what a new form lacks. Which of them a model has, and what a scene means in one.
#pragma once

#include "model/model.hpp"

namespace lagen {

enum class FormKind { lagrange, hamilton, pontryagin, discrete, first_order };

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

[[nodiscard]] const EquationForm& entry_of(FormKind kind);
/// Throws InternalError where there is no such form.
[[nodiscard]] const EquationForm& form_named(const std::string& name);
[[nodiscard]] bool is_form(const std::string& name, FormKind kind);

/// The first of forms_of(); Lagrange's for a model that has none.
[[nodiscard]] std::string default_form(const Model& model);

/// Every form that lagen derives, generates and runs.
[[nodiscard]] const std::vector<std::string>& form_names();

/// "lagrange, hamilton or pontryagin": every form, for a sentence.
[[nodiscard]] std::string form_list();

/// "pontryagin, lagrange, hamilton": a model's default is the first of them that it has.
[[nodiscard]] std::string default_order();

/// The forms that the model has, the default first.
[[nodiscard]] std::vector<std::string> forms_of(const Model& model);

/// Throws ModelError where `form` is no form, or none of the model's. `what` calls it: "'form' of scene 'default'".
void require_form(const Model& model, const std::string& form, const std::string& what, const SourceRange& where);

/// The form of a scene; where it names none the model's default.
[[nodiscard]] std::string form_of(const Model& model, const Scene& scene);

/// "scene 'a' is discrete", or "scene 'a' is stepped by the method 'variational4'": why it has no curve.
[[nodiscard]] std::string discreteness(const Scene& scene);

/// The columns of a state: base coordinates, then fibre coordinates (lagrange), momenta (hamilton), momenta and
/// controls (pontryagin), or entries of the group element and momenta (discrete).
[[nodiscard]] std::vector<std::string> state_names(const Model& model, const std::string& form);

/// Throws ModelError where a column, a curve, an event, its jump or the time scale of the scene has no value in this
/// form: none has everything to observe that another has.
void require_values_in(const Model& model, const Scene& scene, const std::string& form);

/// Why a jump cannot be made in this form: what it sets, behind "sets ", and the hint.
struct JumpObstacle {
    std::string text, hint;
};
/// Lagrange's form has no momenta to set; Hamilton's takes fibre coordinates where there is an L, which makes momenta
/// of them.
[[nodiscard]] std::optional<JumpObstacle> obstacle_to_jump(const Model& model, const Event& event,
                                                           const std::string& form);

/// True where `tree` has a value in this form: controls have one in Pontryagin's alone, coordinates of an arrow in the
/// discrete one, which has neither velocities nor a Hamiltonian.
[[nodiscard]] bool has_value(const Model& model, const Tree& tree, const std::string& form);

/// The names of what is claimed to be conserved and has no value in this form, and the first-order states where it has
/// none.
[[nodiscard]] std::vector<std::string> names_without_values(const Model& model, const std::string& form);

/// `scene` with another form: "state" in `observe` means the states of that form. Throws MathematicsError where the
/// model does not have it (ModelError where the scene itself names it; nothing for the default of a model that has
/// none), and ModelError where the scene cannot do in this form: Pontryagin's equations start from momenta, no other
/// form has controls to observe, and none but the discrete one starts from an arrow; that one has no events.
[[nodiscard]] Scene in_form(const Model& model, Scene scene, const std::string& form);

/// Numbers of the states of [states], ascending, that forces, invariants or the scene's columns, events and time scale
/// use, and those that these follow from. Without a scene, and where the scene does not choose its columns: all but
/// `total_cost`, which is carried where it is named alone (without a scene in observables, invariants or events), and
/// in Pontryagin's form.
[[nodiscard]] std::vector<std::size_t> carried_states(const Model& model, const std::string& form, const Scene* scene);

/// True where `tree` uses a state that is not among `carried`.
[[nodiscard]] bool uses_other_states(const Model& model, const Tree& tree, const std::vector<std::size_t>& carried);

} // namespace lagen
