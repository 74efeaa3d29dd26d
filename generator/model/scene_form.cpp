// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/scene_form.hpp"

#include "expression/find_part.hpp"
#include "model/complaints.hpp"
#include "model/read_curve.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <set>

namespace lagen {

namespace {

constexpr EquationForm form_rows[] = {
    {FormKind::lagrange, "lagrange", "", "Fibre", "fibre coordinates", false, false, "no [lagrangian]",
     [](const Model& model) { return model.lagrangian != nullptr; }, 1},
    {FormKind::hamilton, "hamilton", "_hamilton", "Momenta", "momenta", true, false,
     "neither [hamiltonian] nor [lagrangian]",
     [](const Model& model) { return model.lagrangian != nullptr || model.hamiltonian != nullptr; }, 2},
    {FormKind::pontryagin, "pontryagin", "_pontryagin", "Momenta", "momenta", true, false, "no [control]",
     [](const Model& model) { return model.control.has_value(); }, 0},
    {FormKind::discrete, "discrete", "_discrete", "Momenta", "momenta", true, true, "no [discrete]",
     [](const Model& model) { return model.discrete.has_value(); }, -1},
    {FormKind::first_order, "first_order", "", "Base", "base coordinates", false, false, "no [rates]",
     [](const Model& model) { return model.algebroid.kind == AlgebroidKind::first_order; }, 0},
};

static_assert(std::size(form_rows) == static_cast<std::size_t>(FormKind::first_order) + 1);
static_assert([] {
    for (std::size_t k = 0; k < std::size(form_rows); ++k)
        if (form_rows[k].kind != static_cast<FormKind>(k)) return false;
    return true;
}()); // in the order of the enumeration

/// The names of the forms that a model has, the default first; of all without one.
std::vector<std::string> names_by_rank(const Model* model)
{
    std::vector<EquationForm> rows(std::begin(form_rows), std::end(form_rows));
    std::ranges::sort(rows, {}, &EquationForm::rank);
    std::vector<std::string> names;
    for (const EquationForm& form : rows)
        if (model == nullptr || form.exists(*model)) names.emplace_back(form.name);
    return names;
}

std::string form_hint(const std::vector<std::string>& forms)
{
    return forms.empty() ? "equations of motion need [lagrangian], [hamiltonian] or [control]"
                         : fmt::format("forms of this model: {}", comma_list(forms));
}

/// Names that have no value in a form, and why.
struct ForeignNames {
    const char* what; ///< "the control"
    std::set<std::string> names;
    std::string hint;
};

std::vector<ForeignNames> foreign_names(const Model& model, const std::string& form)
{
    std::vector<ForeignNames> out;
    const auto names = [](const std::vector<Symbol>& symbols) {
        const std::vector<std::string> all = names_of(symbols);
        return std::set<std::string>(all.begin(), all.end());
    };
    if (model.control && !is_form(form, FormKind::pontryagin))
        out.push_back({"the control", names(model.control->controls),
                       fmt::format("controls are there in Pontryagin's form: form = \"{}\"",
                                   entry_of(FormKind::pontryagin).name)});
    for (std::size_t k = 0; k < model.states.size(); ++k)
        if (is_total_cost(model, k) && !is_form(form, FormKind::pontryagin))
            out.push_back({"the integral", {total_cost_name}, out.back().hint});
    if (is_form(form, FormKind::discrete)) {
        const char* hint = "a discrete motion has points, arrows and momenta";
        out.push_back({"the velocity", names(model.fibre.coordinates), hint});
        out.push_back({"the function", {"hamiltonian"}, hint});
    } else if (model.groupoid) {
        const std::string hint = "arrows of the groupoid are there in discrete scenes";
        out.push_back({"the entry of the group element", names(model.groupoid->element), hint});
        out.push_back({"the coordinate of the target", names(model.groupoid->next), hint});
    }
    if (form_named(form).steps && !model.states.empty())
        out.push_back({"the first-order state", names(symbols_of(model, Role::state)),
                       "first-order states move in continuous time: give the scene another form"});
    if (form_named(form).steps && !model.inputs.empty())
        out.push_back({"the input", names(symbols_of(model, Role::input)),
                       "inputs act in continuous time: give the scene another form"});
    return out;
}

/// Refuses foreign names in trees that may share their parts.
class ForeignSearch {
  public:
    ForeignSearch(const Model& model, const std::string& form) : foreign_(foreign_names(model, form)) {}

    /// A foreign name in `root` and what it is one of; null where there is none, or none in parts that were not looked
    /// through before.
    std::pair<const ForeignNames*, std::string> operator()(const Tree& root)
    {
        if (foreign_.empty()) return {};
        const ForeignNames* kind = nullptr;
        const Tree found = search_(root, [&](const Tree& part) {
            const auto has = [&](const ForeignNames& each) { return each.names.contains(part->name); };
            const auto place = std::ranges::find_if(foreign_, has);
            if (part->kind == TreeKind::name && place != foreign_.end()) kind = &*place;
            return kind != nullptr;
        });
        return {kind, found == nullptr ? "" : found->name};
    }

    /// Throws ModelError where there is one; `what` depends on it.
    void refuse_in(const Tree& tree, const std::string& what, const std::string& form, const SourceRange& where)
    {
        const auto [foreign, name] = (*this)(tree);
        if (foreign == nullptr) return;
        throw ModelError(
            fmt::format("{} depends on {} '{}', which the form '{}' does not have", what, foreign->what, name, form),
            where, foreign->hint);
    }

  private:
    std::vector<ForeignNames> foreign_;
    PartSearch search_;
};

/// Calls visit(tree, what, where) for each function of the motion that a scene looks at; `what` calls it in messages.
template <class Visit>
void for_each_function(const Scene& scene, Visit visit)
{
    const auto named = [&](const char* what, const NamedTree& each) {
        visit(each.value, fmt::format(fmt::runtime(what), each.name), each.where);
    };
    if (scene.observe)
        for (const NamedTree& column : *scene.observe) named("the column '{}'", column);
    for (const NamedTree& coordinate : plot_coordinates(scene)) named("the curve of '{}'", coordinate);
    for (const Event& event : scene.events) {
        visit(event.when, fmt::format("event '{}'", event.name), event.where);
        for (const NamedTree& each : event.jump)
            visit(each.value, fmt::format("'{}' in the jump of event '{}'", each.name, event.name), each.where);
    }
    if (scene.time_scale != nullptr) visit(scene.time_scale, "the time scale", scene.time_scale_where);
}

/// Neither velocities nor momenta follow from an arrow without the discrete Lagrangian.
void require_start_of_motion(const Scene& scene, const std::string& form)
{
    if (scene.element.empty() && scene.next.empty()) return;
    throw ModelError(fmt::format("scene '{}' starts from an arrow of the groupoid, where the form '{}' starts from "
                                 "fibre coordinates or momenta",
                                 scene.name, form),
                     scene.where, "give another scene 'initial' values of them");
}

/// A discrete motion has points at its steps alone.
void require_no_events(const Scene& scene)
{
    if (scene.events.empty()) return;
    throw ModelError(fmt::format("{} and has the event '{}', but a discrete motion has no values between its steps in "
                                 "which it could be found",
                                 discreteness(scene), scene.events.front().name),
                     scene.events.front().where, "observe its function, and look for the change of sign in the rows");
}

/// Inputs act in continuous time; those of Pontryagin's equations are functions of time, which no costate answers.
void require_inputs_in(const Model& model, const Scene& scene, const std::string& form)
{
    if (scene.inputs.empty() && !scene.input_table) return;
    const SourceRange& where = scene.input_table ? scene.input_table->where : scene.inputs.front().where;
    if (form_named(form).steps)
        throw ModelError(fmt::format("{} and gives inputs, which act in continuous time", discreteness(scene)), where,
                         scene.stepped_by.empty() ? "give the scene another form"
                                                  : "take another method: `lagen methods` lists them");
    if (!is_form(form, FormKind::pontryagin)) return;
    if (scene.input_table)
        throw ModelError(fmt::format("scene '{}' gives a table of inputs, and in the form '{}' they are functions of t",
                                     scene.name, form),
                         where, "inputs = { u = \"..\" }");
    const std::vector<Symbol> parameters = symbols_of(model, Role::parameter);
    for (const NamedTree& input : scene.inputs)
        for (const std::string& used : names_in(input.value))
            if (used != "t" && index_of(parameters, used) == parameters.size())
                throw ModelError(fmt::format("the input '{}' of scene '{}' depends on '{}', and in the form '{}' "
                                             "inputs are functions of t and parameters",
                                             input.name, scene.name, used, form),
                                 input.where, "what answers the state there is a control");
}

/// A costate follows from no velocity: sigma gives y for each (x, u), and u is what is sought.
void require_momenta(const Model& model, const Scene& scene)
{
    if (first_of(scene.initial, model.fibre.coordinates) == nullptr) return;
    throw ModelError(
        fmt::format("scene '{}' starts from fibre coordinates, where Pontryagin's equations start from momenta",
                    scene.name),
        scene.where, fmt::format("give 'initial' the momenta {}", comma_list(declared_names(model.fibre.momenta))));
}

/// Puts the states of `form` where "state" stood; columns that are there already are not repeated.
void replace_states(const Model& model, Scene& scene, const std::string& form)
{
    if (!scene.observe || !scene.states) return;
    const auto [first, count, where] = *scene.states;
    std::vector<NamedTree>& columns = *scene.observe;
    const auto begin = columns.begin() + static_cast<std::ptrdiff_t>(first);
    columns.erase(begin, begin + static_cast<std::ptrdiff_t>(count));
    std::set<std::string> before, after;
    for (std::size_t k = 0; k < first; ++k) before.insert(columns[k].name);
    std::vector<NamedTree> states;
    for (const std::string& each : state_names(model, form)) {
        if (before.contains(each)) continue;
        states.push_back({each, name(each, where), where});
        after.insert(each);
    }
    std::erase_if(columns, [&](const NamedTree& column) { return after.contains(column.name); });
    scene.states->count = states.size();
    columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(first), states.begin(), states.end());
}

/// The trees that are evaluated along every motion of the scene; without a scene those of a header.
std::vector<Tree> evaluated_trees(const Model& model, const Scene* scene)
{
    std::vector<Tree> trees;
    const auto append = [&](const std::vector<NamedTree>& named) {
        for (const NamedTree& each : named) trees.push_back(each.value);
    };
    for (const ComponentEntry& force : model.forces) trees.push_back(force.value);
    append(model.invariants);
    if (scene != nullptr) {
        for_each_function(*scene,
                          [&](const Tree& tree, const std::string&, const SourceRange&) { trees.push_back(tree); });
        append(scene->inputs);
        return trees;
    }
    append(model.observables);
    for (const Scene& each : model.scenes)
        for (const Event& event : each.events) {
            trees.push_back(event.when);
            append(event.jump);
        }
    return trees;
}

/// A state alone, or all entries of a matrix: it stays on its group as a whole.
std::vector<std::size_t> together(const Model& model, std::size_t state)
{
    for (const Reconstruction& g : model.reconstructions) {
        if (!g.holds(state)) continue;
        std::vector<std::size_t> entries(g.size * g.size);
        std::iota(entries.begin(), entries.end(), g.first);
        return entries;
    }
    return {state};
}

} // namespace

const EquationForm& entry_of(FormKind kind)
{
    return form_rows[static_cast<std::size_t>(kind)];
}

const EquationForm& form_named(const std::string& name)
{
    const auto* const row =
        std::ranges::find_if(form_rows, [&](const EquationForm& form) { return name == form.name; });
    if (row == std::end(form_rows)) throw InternalError("there is no form called " + name);
    return *row;
}

bool is_form(const std::string& name, FormKind kind)
{
    return name == entry_of(kind).name;
}

std::string default_form(const Model& model)
{
    const std::vector<std::string> forms = forms_of(model);
    return forms.empty() ? entry_of(FormKind::lagrange).name : forms.front();
}

const std::vector<std::string>& form_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const EquationForm& form : form_rows) all.emplace_back(form.name);
        return all;
    }();
    return names;
}

std::string form_list()
{
    const std::vector<std::string>& names = form_names();
    return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

std::string default_order()
{
    return comma_list(names_by_rank(nullptr));
}

std::vector<std::string> forms_of(const Model& model)
{
    return names_by_rank(&model);
}

void require_form(const Model& model, const std::string& form, const std::string& what, const SourceRange& where)
{
    const std::vector<std::string>& known = form_names();
    if (std::ranges::find(known, form) == known.end()) throw complain::unknown_word(what, form, where, known, "forms");
    const std::vector<std::string> forms = forms_of(model);
    if (std::ranges::find(forms, form) == forms.end())
        throw ModelError(fmt::format("{} is '{}', but the model has {}", what, form, form_named(form).needs), where,
                         form_hint(forms));
}

std::string form_of(const Model& model, const Scene& scene)
{
    return scene.form.empty() ? default_form(model) : scene.form;
}

std::string discreteness(const Scene& scene)
{
    return scene.stepped_by.empty()
               ? fmt::format("scene '{}' is discrete", scene.name)
               : fmt::format("scene '{}' is stepped by the method '{}'", scene.name, scene.stepped_by);
}

std::vector<std::string> state_names(const Model& model, const std::string& form)
{
    std::vector<std::string> names = names_of(model.base.coordinates);
    const auto append = [&](const std::vector<Symbol>& symbols) {
        for (const Symbol& symbol : symbols) names.push_back(symbol.name);
    };
    if (is_form(form, FormKind::discrete) && model.groupoid) append(model.groupoid->element);
    append(form_named(form).momenta ? model.fibre.momenta : model.fibre.coordinates);
    for (std::size_t k = 0; k < model.states.size() && !form_named(form).steps; ++k)
        if (!is_total_cost(model, k)) names.push_back(model.states[k].symbol.name);
    if (is_form(form, FormKind::pontryagin) && model.control) append(model.control->controls);
    return names;
}

std::optional<JumpObstacle> obstacle_to_jump(const Model& model, const Event& event, const std::string& form)
{
    const bool momenta = form_named(form).momenta;
    if (const NamedTree* momentum = first_of(event.jump, model.fibre.momenta); momentum != nullptr && !momenta)
        return JumpObstacle{
            fmt::format("the momentum '{}', and the form '{}' has fibre coordinates", momentum->name, form),
            "set those, or run another form: form = \"hamilton\""};
    if (const NamedTree* velocity = first_of(event.jump, model.fibre.coordinates);
        velocity != nullptr && momenta && !model.lagrangian)
        return JumpObstacle{fmt::format("the fibre coordinate '{}', and the form '{}' of a model without [lagrangian] "
                                        "has momenta alone",
                                        velocity->name, form),
                            "set momenta"};
    return std::nullopt;
}

void require_values_in(const Model& model, const Scene& scene, const std::string& form)
{
    ForeignSearch foreign_in(model, form);
    for_each_function(scene, [&](const Tree& tree, const std::string& what, const SourceRange& where) {
        foreign_in.refuse_in(tree, fmt::format("{} of scene '{}'", what, scene.name), form, where);
    });
    for (const Event& event : scene.events)
        if (const std::optional<JumpObstacle> obstacle = obstacle_to_jump(model, event, form))
            throw ModelError(
                fmt::format("the jump of event '{}' of scene '{}' sets {}", event.name, scene.name, obstacle->text),
                event.where, obstacle->hint);
}

bool has_value(const Model& model, const Tree& tree, const std::string& form)
{
    return ForeignSearch(model, form)(tree).first == nullptr;
}

std::vector<std::string> names_without_values(const Model& model, const std::string& form)
{
    std::vector<std::string> names;
    for (const NamedTree& claim : conserved_trees(model))
        if (!has_value(model, claim.value, form)) names.push_back(claim.name);
    if (!form_named(form).steps) return names;
    for (std::size_t k = 0; k < model.states.size(); ++k)
        if (const std::string name = family_name(model.states[k].symbol.name);
            !is_total_cost(model, k) && (names.empty() || names.back() != name))
            names.push_back(name);
    return names;
}

Scene in_form(const Model& model, Scene scene, const std::string& form)
{
    if (form == scene.form)
        require_form(model, form, fmt::format("'form' of scene '{}'", scene.name), scene.form_where);
    const std::vector<std::string> forms = forms_of(model);
    if (form != form_of(model, scene) && std::ranges::find(forms, form) == forms.end())
        throw MathematicsError(
            fmt::format("the form asked for is '{}', but the model has {}", form, form_named(form).needs),
            form_hint(forms));
    scene.form = form;
    replace_states(model, scene, form);
    if (form_named(form).steps)
        require_no_events(scene);
    else
        require_start_of_motion(scene, form);
    require_inputs_in(model, scene, form);
    if (is_form(form, FormKind::pontryagin)) require_momenta(model, scene);
    require_values_in(model, scene, form);
    return scene;
}

std::vector<std::size_t> carried_states(const Model& model, const std::string& form, const Scene* scene)
{
    std::vector<std::size_t> carried;
    if (form_named(form).steps) return carried;
    const bool chosen = scene != nullptr && scene->observe;
    for (std::size_t k = 0; k < model.states.size() && !chosen; ++k)
        if (!is_total_cost(model, k)) carried.push_back(k);
    if (carried.size() == model.states.size()) return carried;
    const std::vector<Symbol> symbols = symbols_of(model, Role::state);
    std::vector<Tree> open = evaluated_trees(model, scene);
    while (!open.empty()) {
        const Tree tree = std::move(open.back());
        open.pop_back();
        for (const std::string& name : names_in(tree)) {
            const std::size_t used = index_of(symbols, name);
            if (used == symbols.size() || std::ranges::find(carried, used) != carried.end()) continue;
            if (is_total_cost(model, used) && !is_form(form, FormKind::pontryagin)) continue;
            for (const std::size_t k : together(model, used)) {
                carried.push_back(k);
                open.push_back(model.states[k].rate);
            }
        }
    }
    std::ranges::sort(carried);
    return carried;
}

bool uses_other_states(const Model& model, const Tree& tree, const std::vector<std::size_t>& carried)
{
    if (carried.size() == model.states.size()) return false;
    const std::vector<Symbol> symbols = symbols_of(model, Role::state);
    return std::ranges::any_of(names_in(tree), [&](const std::string& name) {
        const std::size_t k = index_of(symbols, name);
        return k < symbols.size() && std::ranges::find(carried, k) == carried.end();
    });
}

} // namespace lagen
