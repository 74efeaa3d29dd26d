// SPDX-License-Identifier: GPL-2.0-or-later
#include "elaborate/require_values.hpp"

#include "model/read_curve.hpp"
#include "proof/constant_values.hpp"

namespace lagen {

namespace {

/// Looks at trees that may be absent, and at the values of entries.
class ModelValues {
  public:
    void add(const Tree& tree)
    {
        if (tree) values_.require(tree);
    }
    void add(const std::vector<Tree>& trees)
    {
        for (const Tree& tree : trees) add(tree);
    }
    template <class Entry>
    void add(const std::vector<Entry>& entries)
    {
        for (const Entry& entry : entries) add(entry.value);
    }
    void add(const AlgebroidBlock& block)
    {
        add(block.anchor);
        add(block.bracket);
        add(block.connection);
        add(block.sections);
        add(block.drift);
        add(block.constraints);
        for (const ArrayValue& matrix : block.representation) add(matrix.entries);
        for (const AlgebroidBlock& inner : block.of) add(inner);
    }
    void add(const GroupoidBlock& block)
    {
        for (const ArrayValue& matrix : block.generators) add(matrix.entries);
        add(block.action);
    }
    void add(const FormExpression& expression)
    {
        add(expression.function);
        add(expression.section);
        for (const FormExpression& part : expression.parts) add(part);
    }
    void add(const Control& control)
    {
        add(control.guess);
        add(control.sigma);
        add(control.cost);
        for (const ControlBound& bound : control.bounds) add(std::vector{bound.lower, bound.upper});
        if (!control.boundary) return;
        add(control.boundary->from);
        add(control.boundary->to);
        add(std::vector{control.boundary->duration, control.boundary->terminal_cost});
    }
    void add(const Scene& scene)
    {
        add(scene.parameters);
        add(scene.initial);
        add(scene.inputs);
        add(scene.element);
        add(scene.next);
        add(std::vector{scene.start, scene.duration, scene.step, scene.tolerance, scene.relative, scene.absolute,
                        scene.time_scale, scene.sampling.interval});
        add(scene.sampling.at);
        if (scene.observe) add(*scene.observe);
        add(plot_coordinates(scene));
        for (const Event& event : scene.events) {
            add(event.when);
            add(event.jump);
        }
    }

  private:
    ConstantValues values_;
};

} // namespace

void require_values(const std::vector<NamedTree>& claims)
{
    ModelValues values;
    values.add(claims);
}

void require_values(const Model& model)
{
    ModelValues values;
    for (const Parameter& parameter : model.parameters) values.add(parameter.value);
    values.add(model.base.constraints);
    values.add(model.base.casimirs);
    values.add(model.base.domain);
    values.add(model.algebroid);
    values.add(std::vector{model.lagrangian, model.hamiltonian, model.dissipation});
    values.add(model.forces);
    values.add(model.inputs);
    if (model.control) values.add(*model.control);
    if (model.groupoid) values.add(*model.groupoid);
    if (model.discrete) values.add(model.discrete->lagrangian);
    values.add(model.observables);
    values.add(model.invariants);
    for (const NamedForm& form : model.forms) {
        values.add(form.components);
        if (form.equals) values.add(*form.equals);
    }
    for (const Scene& scene : model.scenes) values.add(scene);
}

} // namespace lagen
