// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/preparation.hpp"

#include "machine/write_file.hpp"
#include "mechanics/quadrature.hpp"
#include "methods/integrate_compiled.hpp"
#include "model/scene_form.hpp"
#include "text/comma_list.hpp"
#include "text/content_hash.hpp"
#include "text/usage_error.hpp"
#include "verify/self_adjoint.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace lagen {

namespace {

std::string point_text(const NamedPoint& point)
{
    if (point.empty()) return "every point";
    return comma_list(
        point, [](const auto& entry) { return fmt::format("{} = {:.6g}", entry.first, to_double(entry.second)); });
}

/// Kernels of a header that methods over compiled models, events, rows and what is followed along a run do without.
constexpr const char* kernels_no_run_asks_for[] = {
    "input_jacobian", "mass_matrix",     "momentum",       "inverse_dynamics", "velocity",
    "controls",       "lagrangian",      "cost",           "ambient_velocity", "reaction",
    "moving_energy",  "algebra_element", "algebra_action", "algebra_bracket"};

constexpr ProofBudget composition_budget{.terms = 5000, .products = 2'000'000};

/// Throws where the equations are not what the method asks for.
void require_system(const Scene& scene, const MethodEntry& method, const CheckedModel& checked,
                    const KernelModule& module)
{
    std::optional<Obstacle> obstacle = obstacle_of(method, module);
    if (!obstacle) obstacle = obstacle_to_composition(method, checked, scene);
    if (obstacle) refuse(obstacle->text, scene.method_where, obstacle->hint);
}

/// A step where the step is chosen, or a tolerance where it is fixed.
void warn_of_unused(const Scene& scene, const MethodEntry& method)
{
    if (method.adaptive && scene.step && is_option(scene.step->where))
        warn(fmt::format("--step is not used: {} chooses its steps itself", method.name));
    if (!method.adaptive && scene.tolerance && is_option(scene.tolerance->where))
        warn(fmt::format("--tolerance is not used: the steps of {} are fixed", method.name));
}

/// A time scale is for splittings. Where --method takes another one, that of the scene is left out.
void require_splitting(const Scene& scene, const MethodEntry& method)
{
    if (scene.time_scale == nullptr || is_symmetric_splitting(method)) return;
    const bool given = is_option(scene.time_scale_where);
    if (!given && is_option(scene.method_where))
        return warn(
            fmt::format("time_scale of scene '{}' is not used: {} is no symmetric splitting", scene.name, method.name));
    const std::string what = given ? "--time-scale" : fmt::format("'time_scale' of scene '{}'", scene.name);
    refuse(fmt::format("{} makes the steps of a symmetric splitting, and {} is none", what, method.name),
           scene.time_scale_where, "leapfrog_kdk and kahanli8 are");
}

/// The discrete form is stepped by its own equations, and no other one is.
void require_form_of(const Scene& scene, const MethodEntry& method)
{
    const bool discrete = form_named(scene.form).steps;
    if (discrete == (method.kind == MethodKind::discrete)) return;
    refuse(discrete ? fmt::format("the discrete form of scene '{}' is a motion from step to step, and {} integrates "
                                  "rates",
                                  scene.name, method.name)
                    : fmt::format("{} makes the steps of the discrete form, and scene '{}' is run in the form '{}'",
                                  method.name, scene.name, scene.form),
           scene.method_where.file ? scene.method_where : scene.where,
           discrete ? "leave the method out, or take another form: --form lagrange"
                    : "--form discrete, or another method: `lagen methods` lists them");
}

/// Splitting methods need a kinetic and a potential part, or a sum of exact flows.
std::optional<Obstacle> obstacle_to_splitting(const MethodEntry& method, const KernelModule& module)
{
    using Kind = Separation::Kind;
    const Separation found = separation_of(module);
    if (found.kind >= (method.affine ? Kind::affine : Kind::separable)) return std::nullopt;
    if (!method.affine && module.flows.count > 0) return std::nullopt;
    Obstacle obstacle{
        fmt::format("{} splits {}, and in model '{}' {}", method.name, system_of(method), module.model, found.obstacle),
        "gauss4 to gauss16 are symplectic and split nothing"};
    if (found.kind != Kind::no)
        obstacle.hint = "blanesmoan6 and kahanli8 take every x' = f(y)";
    else if (module.flows.count > 0)
        obstacle.hint = "blanesmoan6 and kahanli8 compose its exact flows";
    else if (!module.flows.obstacle.empty())
        obstacle.text += ", and " + module.flows.obstacle;
    else if (form_named(module.form).kind == FormKind::lagrange && module.groups.size() == 2)
        obstacle.hint += "; with --form hamilton it may be a sum of exact flows";
    return obstacle;
}

/// Methods on groups need states that a group moves.
std::optional<Obstacle> obstacle_to_group(const MethodEntry& method, const KernelModule& module)
{
    const GroupMotion& motion = module.motion;
    const auto free = std::ranges::find(motion.moved, false);
    if (!motion.moved.empty() && (method.kind == MethodKind::group || free == motion.moved.end())) return std::nullopt;
    std::string found = motion.obstacle;
    if (!motion.moved.empty()) {
        const auto lane = static_cast<std::size_t>(free - motion.moved.begin());
        found = fmt::format("the group does not move {}", lanes_of(module)[lane].name);
    }
    return Obstacle{
        fmt::format("{} integrates {}, and in model '{}' {}", method.name, system_of(method), module.model, found),
        "a group moves momenta on a Lie algebra (--form hamilton, without forces), base coordinates on which it acts "
        "linearly, and matrices of [reconstruct]"};
}

/// CPU features that the compiled program needs; they are part of the key, since machines may share the cache.
std::string vectors_of(const Driver& driver)
{
    const std::vector<std::string> options = driver.abreast ? vector_options() : std::vector<std::string>();
    return options.empty() ? "" : options.front();
}

/// A record is named by the kernels that its methods ask for. Methods that take every system share a compiled model,
/// and one with more kernels than they ask for serves them: the first name is theirs.
std::vector<std::string> compiled_for(const MethodEntry& method, const Driver& driver)
{
    const std::optional<KernelsAsked> asked = integrates_compiled(method.type);
    const bool takes_all = (method.kind == MethodKind::explicit_stages || method.kind == MethodKind::implicit_stages) &&
                           method.system == SecondOrder::Kind::no;
    if (driver.abreast || !asked || !takes_all) return {method.name};
    if (asked->packs) return {"jacobian and packs"};
    if (asked->jacobian) return {"jacobian", "jacobian and packs"};
    return {"rhs", "jacobian", "jacobian and packs"};
}

/// The files of the records that serve this scene and method, that of its own first.
std::vector<std::string> record_files(const CheckedModel& checked, const Scene& scene, const MethodEntry& method,
                                      const Driver& driver)
{
    ContentHash hash;
    add_model(hash, checked.model);
    if (!add_scene(hash, checked.model, scene) || scene.project)
        return {""}; // a proof finds what a start that is moved keeps
    hash.add(driver.folder).add(vectors_of(driver)).add(checked.unchecked ? "unchecked" : "");
    std::vector<std::string> files;
    for (const std::string& name : compiled_for(method, driver))
        files.push_back(kept_file(ContentHash(hash).add(name)));
    return files;
}

} // namespace

std::optional<Obstacle> obstacle_of(const MethodEntry& method, const KernelModule& module)
{
    if ((method.kind == MethodKind::discrete) != (module.kind == ModuleKind::step))
        return Obstacle{fmt::format("{} integrates {}, and model '{}' is in the form '{}'", method.name,
                                    method.kind == MethodKind::discrete ? system_of(method) : "rates", module.model,
                                    module.form),
                        "`lagen methods` lists what each method takes"};
    if (method.kind == MethodKind::discrete) return std::nullopt;
    if (method.kind == MethodKind::group || method.kind == MethodKind::poisson)
        return obstacle_to_group(method, module);
    if (method.kind == MethodKind::splitting) return obstacle_to_splitting(method, module);
    using Kind = SecondOrder::Kind;
    const SecondOrder& found = module.second_order;
    if (method.system == Kind::no || found.kind == method.system || found.kind == Kind::velocity_free)
        return std::nullopt;
    return Obstacle{fmt::format("{} integrates {}, and in model '{}' {}", method.name, system_of(method), module.model,
                                found.obstacle),
                    found.kind == Kind::general ? "rkng54 integrates x'' = f(t, x, x')"
                                                : "dop853 and verner87 integrate every system"};
}

std::optional<Obstacle> obstacle_to_composition(const MethodEntry& method, const CheckedModel& checked,
                                                const Scene& scene)
{
    if (!method.composes) return std::nullopt;
    const System& system = checked.system;
    const std::string& scheme = checked.model.discrete->scheme;
    for (const char* name : {"energy", "lagrangian"})
        for (const NamedTree& column : scene.observe.value_or(std::vector<NamedTree>()))
            if (column.name == name || mentions(column.value, name))
                return Obstacle{fmt::format("{} composes steps, and the column '{}' is of the arrow of one step",
                                            method.name, column.name),
                                "observe functions of positions and momenta"};
    if (system.graph.op(system.discrete->step) != Op::input)
        return Obstacle{fmt::format("{} makes steps of several lengths, and in model '{}' the step is fixed",
                                    method.name, system.name),
                        "let the step be a parameter without a binding, or a symbol of its own"};
    if (!scheme.empty() && quadrature_rule(scheme).degree > 1)
        return Obstacle{fmt::format("{} composes steps of order 2, and those of the scheme '{}' have a higher order",
                                    method.name, scheme),
                        "discrete makes its steps; midpoint, trapezoidal and gauss:1 have order 2"};
    Graph graph = system.graph;
    const Decision decision = decide_self_adjoint(graph, system, composition_budget);
    if (decision.status == ProofStatus::proved) return std::nullopt;
    const bool refuted = decision.status == ProofStatus::refuted;
    const bool forced = !system.discrete->work.source.empty();
    return Obstacle{fmt::format("{} composes steps of a symmetric L, L(g, h) = -L(g^-1, -h) up to a constant, {} of "
                                "model '{}' {} not{}",
                                method.name,
                                forced ? "with symmetric forces, f^+(g, h) = -f^-(g^-1, -h), which those"
                                       : "which the discrete Lagrangian",
                                system.name, forced ? "are" : "is",
                                refuted ? fmt::format(": at {} they differ by {:.3g}",
                                                      point_text(decision.witness->point), decision.witness->value)
                                        : fmt::format(" shown to be: {}", decision.evidence)),
                    "the schemes trapezoidal and, by exp, midpoint are symmetric; so is (L(g, h) - L(g^-1, -h))/2"};
}

SceneText scene_text(const CheckedModel& checked, const Scene& scene, const MethodEntry& method, const Driver& driver)
{
    GenerateRequest request;
    request.form = scene.form;
    request.scene = &scene;
    request.flows = method.kind == MethodKind::splitting;
    if (is_symmetric_splitting(method)) request.time_scale = scene.time_scale;
    if (method.composes) { // of the product of arrows -dL/dh and L tell nothing
        request.without = {"energy", "lagrangian"};
        request.with = {"hamiltonian"};
    }
    const bool takes_series = method.kind == MethodKind::series;
    if (takes_series) request.with = {"taylor"};
    if (takes_series && !scene.events.empty()) request.with.emplace_back("event_series");
    const std::optional<KernelsAsked> asked = integrates_compiled(method.type);
    bool is_model = !driver.abreast && request.time_scale == nullptr && asked;
    if (is_model) {
        for (const char* kernel : kernels_no_run_asks_for) request.without.emplace_back(kernel);
        if (!asked->jacobian) request.without.emplace_back("jacobian");
    }
    Generated generated = generate(checked, request);
    is_model = is_model && (generated.module.flows.count == 0 || method.affine); // exact flows are functions of a class
    ProgramText text{std::move(generated.header),
                     is_model ? model_text(generated.module.name, asked->packs)
                              : program_text(driver, generated.module.name, method, request.time_scale != nullptr)};
    text.is_model = is_model;
    text.options = rounding_options(); // the same bits in a run and in the rows of a sweep
    if (driver.abreast && goes_abreast(method))
        for (std::string& option : vector_options()) text.options.push_back(std::move(option));
    return {std::move(generated.module), std::move(text)};
}

const MethodEntry& method_of(const Scene& scene)
{
    const bool discrete = form_named(scene.form).steps;
    const std::string name = !scene.method.empty() ? scene.method : discrete ? "discrete" : standard_method;
    const MethodEntry* method = find_method(name);
    if (method == nullptr) refuse(fmt::format("unknown method '{}'", name), scene.method_where, hint_for_method(name));
    require_form_of(scene, *method);
    if (!method->adaptive && !scene.step && !discrete)
        refuse(fmt::format("method '{}' needs a step: give --step, or `step` in scene '{}'", name, scene.name),
               is_option(scene.method_where) ? scene.method_where : scene.where);
    require_splitting(scene, *method);
    warn_of_unused(scene, *method);
    return *method;
}

Preparation::Preparation(CheckedModel& checked, const Scene& scene, const MethodEntry& method, const Driver& driver)
    : checked_(checked), scene_(scene), method_(method), driver_(driver)
{
    const std::vector<std::string> files = record_files(checked, scene, method, driver);
    file_ = files[0];
    for (std::size_t k = 0; k < files.size() && !record_; ++k) record_ = find_record(files[k]);
    if (record_) {
        checked.warnings = record_->warnings;
        return;
    }
    prove(checked);
    elaborated_ = decided_ = true;
}

void Preparation::finish(const std::vector<long double>& parameters, const std::function<void(const RunRecord&)>& look)
{
    if (record_ && is_decided_for(*record_, parameters)) return look(*record_);
    if (record_) prove(checked_);
    elaborated_ = decided_ = true;
    set_parameters(checked_, parameters);
    const SceneText made = scene_text(checked_, scene_, method_, driver_);
    require_system(scene_, method_, checked_, made.module);
    record_ = record_of(checked_, made.module, parameters);
    look(*record_);
    record_->program = compile_programs({made.text})[0];
    keep_record(file_, *record_);
}

const CheckedModel& Preparation::checked(const std::vector<long double>& parameters, bool decided)
{
    if (!elaborated_) {
        checked_.system = elaborate(checked_.model);
        (void)set_parameters(checked_.system, parameters);
    }
    elaborated_ = true;
    if (decided && !decided_) checked_.report.mechanics.regularity = verify_regularity(checked_.system);
    decided_ = decided_ || decided;
    return checked_;
}

} // namespace lagen
