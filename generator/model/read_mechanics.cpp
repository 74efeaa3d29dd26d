// SPDX-License-Identifier: GPL-2.0-or-later
/// The blocks that make a mechanical system or a control problem of an algebroid, and what is claimed of it:
/// [lagrangian], [hamiltonian], [forces], [dissipation], [control], [symmetries], [hamilton_jacobi]; and [discrete].
#include "model/algebroid_draft.hpp"
#include "model/complaints.hpp"
#include "model/families.hpp"
#include "model/read_values.hpp"
#include "text/comma_list.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace lagen {

namespace {

constexpr std::size_t most_controls = 1000; // d2H/du2 has a million entries then

/// Every run tracks the energy without being asked, and the other two are there under these names.
void refuse_built_in_invariants(const ModelReader& reader)
{
    if (!reader.at("lagrangian") && !reader.at("hamiltonian") && !reader.at("control")) return;
    for (const auto& [name, value, where] : reader.invariants)
        if (name == "energy" || name == "lagrangian" || name == "hamiltonian")
            throw ModelError(fmt::format("the invariant '{0}' bears the name of the {0} of the model", name), where,
                             "choose another name; every run tracks the energy without being asked");
}

/// "-inf" or "inf" for no bound, as text or as a number of TOML.
bool is_open(const TomlValue& value, bool lower)
{
    const std::string& text = value.text.text;
    if (value.kind != TomlKind::string && (value.kind != TomlKind::decimal || value.finite)) return false;
    return lower ? text == "-inf" : text == "inf" || text == "+inf";
}

std::vector<ControlBound> read_bounds(const ModelReader& reader, const Item& block)
{
    using Bounds = std::pair<Tree, Tree>; // null where there is none
    const auto values = [&](const Item& item, const RunningKey& each) {
        const std::string what = fmt::format("a bound of '{}'", each.key.name);
        std::vector<Tree> ends[2];
        for (const std::size_t end : {0U, 1U}) {
            const TomlValue& value = item.value().items[end];
            const Tree parsed = is_open(value, end == 0) ? nullptr : read_array_expression(value, what);
            ends[end] = parsed
                            ? fit_values(reader.close(parsed, Role::parameter, what), each.key.shape, what, value.where)
                            : std::vector<Tree>(each.key.indices.size());
        }
        std::vector<Bounds> bounds;
        for (std::size_t k = 0; k < ends[0].size(); ++k) bounds.emplace_back(ends[0][k], ends[1][k]);
        return bounds;
    };
    std::vector<ControlBound> out;
    read_table(block, reader.model.control->controls, "control", reader.model.scope, values,
               [&](std::size_t control, const Bounds& bounds, const Item& item) {
                   const auto& [lower, upper] = bounds;
                   if (lower || upper) out.push_back({control, lower, upper, item.where()});
               });
    return out;
}

ControlBoundary read_boundary(const ModelReader& reader, const Item& block)
{
    ControlBoundary boundary;
    boundary.where = block.where();
    const std::vector<Symbol>& base = reader.model.base.coordinates;
    boundary.from = read_given(reader, block.at("from"), base, "base coordinate");
    boundary.to = read_given(reader, block.at("to"), base, "base coordinate");
    if (const Item cost = block.at("terminal_cost")) boundary.terminal_cost = reader.scalar(cost);
    std::vector<std::string> missing;
    for (const Symbol& symbol : base)
        if (std::ranges::find(boundary.from, symbol.name, &NamedTree::name) == boundary.from.end())
            missing.push_back(symbol.name);
    if (!missing.empty())
        throw complain::leaves_out("'from' of [control.boundary]", comma_list(missing), boundary.where,
                                   "only 'to' may leave coordinates free");
    const Item duration = block.at("duration");
    boundary.free_duration = duration && duration.text() == "free" && reader.names.find("free") == nullptr;
    if (duration && !boundary.free_duration) boundary.duration = reader.scalar(duration);
    return boundary;
}

/// p_a s^a
Tree momentum_of(const Model& model, const std::vector<ComponentEntry>& section)
{
    std::vector<Tree> terms;
    for (const ComponentEntry& entry : section)
        terms.push_back(multiply({entry.value, name(model.fibre.momenta[entry.section].name)}));
    return sum_of(terms);
}

/// A parameter that is made of the step: derivatives by the step would pass it over.
void refuse_parameters_of_step(const Model& model)
{
    for (const Parameter& parameter : model.parameters) {
        if (!mentions(parameter.value, model.discrete->step.name)) continue;
        throw ModelError(
            fmt::format("the parameter '{}' is made of the step '{}', which no derivative by the step knows, "
                        "the energy -dL/dh least of all",
                        parameter.symbol.name, model.discrete->step.name),
            parameter.symbol.where,
            fmt::format("make it a definition: [definitions] {} = \"..\"", parameter.symbol.name));
    }
}

} // namespace

void declare_control(ModelReader& reader)
{
    const Item block = reader.at("control");
    if (!block) return;
    const Item controls = block.at("controls");
    reader.model.control.emplace().where = block.where();
    declare_symbols(reader, read_names(reader, controls), Role::control);
    const std::size_t count = reader.model.control->controls.size();
    if (count > most_controls)
        throw complain::too_many(controls.title(), count, "names", most_controls, controls.value().where);
}

void declare_total_cost(ModelReader& reader)
{
    if (reader.model.control && reader.names.find(total_cost_name) == nullptr)
        declare_symbols(reader, {Symbol{total_cost_name, {}, {}, {}, {}}}, Role::state);
}

void define_cost(ModelReader& reader)
{
    const Item cost = reader.at("control").at("cost");
    if (!cost || reader.names.find("cost") != nullptr) return;
    reader.observer.define(Definition{"cost", {}, read_expression(cost.value(), cost.title()), cost.where()});
}

void read_control(ModelReader& reader)
{
    const Item block = reader.at("control");
    if (!block) return;
    Control& control = *reader.model.control;
    control.sigma = read_components(reader, block.at("sigma"));
    control.cost = reader.scalar(block.at("cost"));
    for (std::size_t k = 0; k < reader.model.states.size(); ++k)
        if (is_total_cost(reader.model, k)) reader.model.states[k].rate = control.cost;
    control.bounds = read_bounds(reader, block.at("bounds"));
    if (const Item guess = block.at("guess")) {
        control.guess.resize(control.controls.size());
        reader.read_values(guess, control.controls, "control",
                           [&](std::size_t k, const Tree& value, const Item&) { control.guess[k] = value; });
    }
    if (const Item boundary = block.at("boundary")) control.boundary = read_boundary(reader, boundary);
}

void declare_mechanics(ModelReader& reader)
{
    refuse_built_in_invariants(reader);
    const Item L = reader.at("lagrangian").at("L"), R = reader.at("dissipation").at("R");
    if (L) {
        reader.lagrangian = read_expression(L.value(), L.title());
        reader.model.lagrangian_where = L.value().where;
    }
    if (R) reader.dissipation = read_expression(R.value(), R.title());
}

/// Every base coordinate of a system of first order has a rate.
void read_rates(ModelReader& reader)
{
    Model& model = reader.model;
    if (model.algebroid.kind != AlgebroidKind::first_order) return;
    const std::vector<Symbol>& base = model.base.coordinates;
    const Item block = reader.at("rates");
    if (!block)
        throw complain::needs("an algebroid of kind 'first_order'", "[rates]", model.algebroid.where,
                              "[rates] x = \"..\", one a base coordinate");
    model.rates.resize(base.size());
    reader.read_values(block, base, "base coordinate",
                       [&](std::size_t i, const Tree& value, const Item&) { model.rates[i] = value; });
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < base.size(); ++i)
        if (!model.rates[i]) missing.push_back(base[i].name);
    if (!missing.empty()) throw complain::leaves_out("[rates]", comma_list(missing), block.where());
}

void read_mechanics(ModelReader& reader)
{
    Model& model = reader.model;
    read_rates(reader);
    constexpr Roles velocity = Role::time | Role::parameter | Role::base | Role::fibre;
    if (reader.lagrangian) model.lagrangian = reader.scalar(reader.lagrangian, velocity, "the Lagrangian");
    if (const Item H = reader.at("hamiltonian").at("H")) {
        model.hamiltonian = reader.scalar(H);
        model.hamiltonian_where = H.value().where;
    }
    if (reader.dissipation) model.dissipation = reader.scalar(reader.dissipation, velocity, "the Rayleigh function");
    model.forces = read_components(reader, reader.at("forces"));
    for (const ComponentEntry& force : reader.inherited_forces)
        model.forces.push_back({force.section, reader.mechanical.close(force.value, true), force.where});
    require_rules(reader, Known::functions);
    const Item candidate = reader.at("hamilton_jacobi");
    if (!candidate) return;
    HamiltonJacobi& claim = model.hamilton_jacobi.emplace();
    claim.where = candidate.where();
    if (const Item S = candidate.at("S")) claim.S = reader.scalar(S);
    claim.alpha = read_components(reader, candidate.at("alpha"));
}

void read_symmetries(ModelReader& reader)
{
    Model& model = reader.model;
    for (const Item& item : reader.at("symmetries").items()) {
        require_identifier(item.name(), item.where(), "a name");
        Symmetry symmetry{item.name(), item.where(), read_components(reader, item), nullptr};
        symmetry.momentum = momentum_of(model, symmetry.section);
        model.observables.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
        model.symmetries.push_back(std::move(symmetry));
    }
}

std::vector<NamedTree> conserved_trees(const Model& model)
{
    std::vector<NamedTree> trees = model.invariants;
    if (!model.forces.empty() || model.dissipation || model.control) return trees;
    for (const Symmetry& symmetry : model.symmetries)
        trees.push_back({"momentum." + symmetry.name, symmetry.momentum, symmetry.where});
    return trees;
}

void declare_discrete(ModelReader& reader)
{
    const Item block = reader.at("discrete");
    if (!block) return;
    Model& model = reader.model;
    if (!model.groupoid) model.groupoid.emplace().where = block.where(); // of pairs: a rule says so
    DiscreteBlock& discrete = model.discrete.emplace();
    discrete.where = block.where();
    const Item step = block.at("step"), scheme = block.at("scheme"), retraction = block.at("retraction");
    // h is a parameter of the model, or a symbol of its own.
    discrete.step = Symbol{step.text(), step.value().where, {}, {}, {}};
    const Names::Entry* known = reader.names.find(step.text());
    if (known == nullptr || known->role != Role::parameter)
        reader.names.declare(step.text(), Role::step, discrete.step.where);
    if (scheme) {
        discrete.scheme = scheme.text();
        discrete.scheme_where = scheme.value().where;
    }
    if (!retraction) return;
    discrete.retraction = retraction.text();
    discrete.retraction_where = retraction.value().where;
}

void read_discrete(ModelReader& reader)
{
    if (!reader.model.discrete) return;
    DiscreteBlock& block = *reader.model.discrete;
    if (!block.scheme.empty() && !reader.model.lagrangian)
        throw complain::needs(fmt::format("the scheme '{}'", block.scheme),
                              "[lagrangian], of which it makes a discrete one", block.scheme_where,
                              "give [lagrangian] L, or the discrete Lagrangian itself: L = \"..\"");
    refuse_parameters_of_step(reader.model);
    const Item L = reader.at("discrete").at("L");
    if (!L) return;
    const Tree tree = read_expression(L.value(), L.title());
    const ArrayValue closed = reader.close(tree, L.row().roles, L.title());
    if (closed.shape.rank != Rank::scalar)
        throw complain::is_not(L.title(), to_text(closed.shape), "a scalar", tree->where,
                               "a norm is written norm(x), a trace trace(W)");
    block.lagrangian = closed.entries[0];
}

} // namespace lagen
