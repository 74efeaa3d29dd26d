// SPDX-License-Identifier: GPL-2.0-or-later
/// The rows of the format, in the order in which they are documented.
#include "geometry/named_algebra.hpp"
#include "model/schema.hpp"

namespace lagen {

/// Short names for the table alone.
namespace format {

using enum ValueKind;

constexpr Roles constants = Role::parameter;
constexpr Roles point = constants | Role::base;
constexpr Roles velocity = point | Role::time | Role::fibre;
constexpr Roles drifting = point | Role::time | Role::state | Role::input;
constexpr Roles pushing = velocity | Role::state | Role::input;
constexpr Roles phase = point | Role::time | Role::momentum;
constexpr Roles controlled = point | Role::time | Role::control;
constexpr Roles moving = pushing | Role::ambient;
constexpr Roles arrow = point | Role::time | Role::next | Role::element | Role::step;

constexpr SchemaRow row(std::string_view path, ValueKind kind, const char* text, const char* title = "",
                        Roles roles = {})
{
    return {path, kind, text, title, roles};
}

constexpr const char* ends =
    "source = \"from.toml\" and target = \"to.toml\", or compose = [\"first.toml\", \"second.toml\"]";

constexpr SchemaRow rows[] = {
    row("", table, "A model: a Lie algebroid, and mechanics on it", "the model"),
    row("name", text, "name of the generated class, a C++ identifier", "the name"),
    row("title", text, "one line that says what the model is", "the title"),
    row("sizes", table, "integers that ranges and expressions may use"),
    row("sizes.*", expression, "an integer, over other sizes", "the size '{0}'"),
    row("parameters", table, "constants, with the values that they have unless a scene or --set says otherwise"),
    row("parameters.*", array, "a default value; of a family m[1..7] one value, or a list", "the parameter '{0}'",
        constants),
    row("base", table, "the manifold M"),
    row("base.coordinates", strings, "names of the coordinates, x or x[1..n]"),
    row("base.constraints", strings, "functions of which M is the common zero set"),
    row("base.casimirs", table, "functions that no motion changes"),
    row("base.casimirs.*", expression, "a function of the coordinates", "the Casimir '{0}'", point),
    row("base.domain", strings, "strict inequalities that hold on M"),
    row("fibre", table, "the fibre of the algebroid E"),
    row("fibre.coordinates", strings, "names of the coordinates y, one a section of the frame"),
    row("fibre.momenta", strings, "names of the momenta, p_ and the coordinate's unless given"),
    row("algebroid", table, "the Lie algebroid: a kind, and what that kind asks for"),
    row("algebroid.kind", word, "what kind of algebroid it is: general where left out"),
    row("algebroid.over", strings, "base coordinates that move"),
    row("algebroid.algebra", text, "a Lie algebra by its name: so(3), se(2), gl(n), R^n, a sum A + B")
        .like("algebra = \"so(3)\""),
    row("algebroid.anchor", table, "rates of the base coordinates, a line a section or a coordinate")
        .like("[algebroid.anchor] with a line a section"),
    row("algebroid.anchor.*", line, "components of a section, or the rate of a coordinate", "the anchor of '{0}'"),
    row("algebroid.anchor.*.*", array, "a component along a base coordinate", "the anchor entry '{1}' of '{0}'", point),
    row("algebroid.bracket", table, "brackets of sections, a pair of them a line")
        .like("[algebroid.bracket] with a line a pair (empty: abelian)"),
    row("algebroid.bracket.*", table, "the bracket of a pair", "the bracket of '{0}'"),
    row("algebroid.bracket.*.*", expression,
        "its component on a section; of kind general alone it may use base coordinates",
        "the entry '{1}' of the bracket of '{0}'", point),
    row("algebroid.representation", matrices, "a matrix a section, which acts on the base vector", "'representation'",
        constants)
        .like("representation = [A_1, ..], one matrix a section")
        .of("matrices", 1),
    row("algebroid.spanned_by", table, "vector fields that span the subbundle, a line a section")
        .like("spanned_by = { a = { x = \"..\" } }, a line a section"),
    row("algebroid.spanned_by.*", line, "components of a section, or the rate of a coordinate", "the section '{0}'"),
    row("algebroid.spanned_by.*.*", array, "a component along a base coordinate", "the component '{1}' of '{0}'",
        point),
    row("algebroid.connection", table, "the connection, a line a base coordinate"),
    row("algebroid.connection.*", table, "its components along a coordinate", "the connection along '{0}'"),
    row("algebroid.connection.*.*", array, "a component on a vertical section",
        "the connection's component '{1}' of '{0}'", point),
    row("algebroid.sections", table, "sections of the inner algebroid, a line a coordinate of the fibre")
        .like("sections = { a = { b = \"..\" } }, a line a section"),
    row("algebroid.sections.*", table, "components of a section", "the section '{0}'"),
    row("algebroid.sections.*.*", array, "a component on an inner section; of a nonholonomic model it may use the time",
        "the component '{1}' of '{0}'", point),
    row("algebroid.bundle", word, "what is prolonged: E or its dual").one_of("E E* :bundles"),
    row("algebroid.drift", table, "what is added to the distribution of a nonholonomic model"),
    row("algebroid.drift.*", array, "its component on an ambient section", "the component '{0}' of the drift",
        point | Role::time),
    row("algebroid.constraints", strings, "functions, affine in the ambient velocities, that are zero")
        .like("constraints = [\"..\"]; without one the algebroid is that of [algebroid.of]")
        .of("constraints", 1),
    row("algebroid.of", ValueKind::algebroid, "the algebroid inside: a table, or the file of a model")
        .like("of = \"file.toml\", a table [algebroid.of], or of a product of = [\"a.toml\", \"b.toml\"]"),
    row("algebroid.of.fibre", strings, "names of the coordinates of the inner fibre"),
    row("algebroid.of.momenta", strings, "names of the momenta of the inner fibre"),
    row("groupoid", table, "a Lie groupoid whose algebroid is computed").needing("kind"),
    row("groupoid.kind", word, "what kind of groupoid it is").like("kinds: pair, group, action, atiyah"),
    row("groupoid.group", text, "a group by its name: SO(3), SE(2), GL(n), R^n, a sum A + B").like("group = \"SO(3)\""),
    row("groupoid.generators", matrices, "matrices that generate the group", "", constants)
        .like("generators = [[[0, -1], [1, 0]]], one matrix a section")
        .of("matrices", 1, named_algebra_rank_limit),
    row("groupoid.element", text, "name of the matrix of a group element: W where left out"),
    row("groupoid.action", table, "the right action of the element on the base")
        .like("action = { x = \"..\" }, the right action x.W, a line a base coordinate"),
    row("groupoid.action.*", array, "where it takes a coordinate", "the action on '{0}'", point | Role::element),
    row("discrete", table, "a discrete Lagrangian on the groupoid").needing("step L|scheme"),
    row("discrete.step", text, "name of the step").like("step = \"h\" names the step"),
    row("discrete.L", expression, "the discrete Lagrangian, written out", "the discrete Lagrangian", arrow)
        .like("L = \"..\" over x, x_next and the element"),
    row("discrete.scheme", word, "the rule that makes it of the Lagrangian")
        .one_of("midpoint trapezoidal left gauss:1 gauss:2 gauss:3 gauss:4 lobatto:2 lobatto:3 lobatto:4 lobatto:5 "
                ":schemes")
        .like("scheme = \"midpoint\" to make it of [lagrangian]"),
    row("discrete.retraction", word, "the map from the algebra to the group").one_of("cayley exp :retractions"),
    row("definitions", table, "named expressions and functions"),
    row("definitions.*", expression, "an expression", "the definition '{0}'"),
    row("rates", table, "the rates of a system of first order, one a base coordinate")
        .like("[rates] x = \"..\", one a base coordinate"),
    row("rates.*", expression, "the time derivative of a base coordinate", "the rate of '{0}'", drifting)
        .any_function(),
    row("lagrangian", table, "the Lagrangian").needing("L"),
    row("lagrangian.L", expression, "a function on E", "the Lagrangian", velocity).like("[lagrangian] L = \"..\""),
    row("hamiltonian", table, "the Hamiltonian").needing("H"),
    row("hamiltonian.H", expression, "a function on the dual of E", "the Hamiltonian", phase)
        .like("[hamiltonian] H = \"..\""),
    row("forces", table, "generalized forces on the right of the equations"),
    row("forces.*", array, "the force on a fibre coordinate", "the force on '{0}'", pushing).any_function(),
    row("dissipation", table, "Rayleigh's dissipation").needing("R"),
    row("dissipation.R", expression, "Rayleigh's function, whose -dR/dy is a force", "the Rayleigh function", velocity)
        .like("[dissipation] R = \"..\""),
    row("control", table, "an optimal control problem").needing("controls sigma cost"),
    row("control.controls", strings, "names of the controls").like("controls = [\"u1\", \"u2\"]").of("controls", 1),
    row("control.sigma", table, "the section of E that the motion follows")
        .like("sigma = { a = \"..\" } for sigma = sigma^a e_a"),
    row("control.sigma.*", array, "its component on a section", "sigma along '{0}'", controlled | Role::input),
    row("control.cost", expression, "the running cost", "the cost", controlled)
        .like("cost = \"u^2/2\"; cost = 1 asks for the least time"),
    row("control.bounds", table, "intervals of the controls"),
    row("control.bounds.*", interval, "lower and upper bound, -inf or inf for none", "the interval of '{0}'", constants)
        .like("write u = [lower, upper]")
        .of("bounds (a lower and an upper one)", 2, 2),
    row("control.guess", table, "where the search for the controls begins"),
    row("control.guess.*", array, "a guess of a control", "the guess of '{0}'", phase).any_function(),
    row("control.boundary", table, "the ends of the motion"),
    row("control.boundary.from", table, "the start, every base coordinate"),
    row("control.boundary.from.*", array, "the value at the start",
        "the value of '{0}' in 'from' of [control.boundary]", constants),
    row("control.boundary.to", table, "the end; a coordinate left out is free"),
    row("control.boundary.to.*", array, "the value at the end", "the value of '{0}' in 'to' of [control.boundary]",
        constants),
    row("control.boundary.to_element", later, "the group part of the end"),
    row("control.boundary.duration", expression, "the time that the motion takes, or free", "", constants),
    row("control.boundary.terminal_cost", expression, "a cost of the end", "the terminal cost", point),
    row("inputs", table, "what acts from outside"),
    row("inputs.*", array, "the default of an input", "the default of the input '{0}'", constants),
    row("states", table, "first-order states beside the algebroid"),
    row("states.*", array, "the rate of a state", "the rate of the state '{0}'", moving | Role::momentum)
        .any_function(),
    row("reconstruct", table, "matrices of a group that follow the motion"),
    row("reconstruct.*", text, "the group", "the group of '{0}'"),
    row("observables", table, "functions to look at"),
    row("observables.*", expression, "a function of everything that moves", "the observable '{0}'", any_role)
        .any_function(),
    row("invariants", table, "functions that are claimed to be conserved"),
    row("invariants.*", expression, "a function of everything that moves", "the invariant '{0}'", any_role),
    row("symmetries", table, "sections that are claimed to leave the Lagrangian invariant"),
    row("symmetries.*", table, "a section", "the symmetry '{0}'"),
    row("symmetries.*.*", array, "its component on a section of the frame",
        "the component of the symmetry '{0}' on '{1}'", point),
    row("forms", table, "E-forms")
        .like("for example A = { degree = 1, a = \"x\" }, F = { degree = 2, \"a,b\" = \"x\" }"),
    row("forms.*", table, "a form: its degree, components, claims", "the form '{0}'")
        .needing("degree")
        .like("for example A = { degree = 1, a = \"x\" }, F = { degree = 2, \"a,b\" = \"x\" }"),
    row("forms.*.degree", count, "the degree, at most the rank", "the degree of the form '{0}'")
        .within(0, 1'000'000)
        .like("for example A = { degree = 1, a = \"x\" }, F = { degree = 2, \"a,b\" = \"x\" }"),
    row("forms.*.closed", flag, "a claim: its differential is zero"),
    row("forms.*.equals", expression, "a claim: an expression in forms, with d, wedge, i"),
    row("forms.*.*", expression, "a component; of degree 0 the value", "the component '{1}' of the form '{0}'", point),
    row("hamilton_jacobi", table, "a candidate solution of the Hamilton-Jacobi equation")
        .needing("S|alpha")
        .like("S = \"a*x\", or alpha = { v_x = \"a\" }"),
    row("hamilton_jacobi.S", expression, "a function on M, alpha = dS", "S of [hamilton_jacobi]", point)
        .like("S = \"a*x\""),
    row("hamilton_jacobi.alpha", table, "a section of the dual of E").like("alpha = { v_x = \"a\" }"),
    row("hamilton_jacobi.alpha.*", array, "its component on a section", "the component of alpha on '{0}'", point),
    row("about", table, "what names mean, for headers, plots and LaTeX"),
    row("about.*", table, "one name", "'{0}' of [about]")
        .like("write x = { text = \"..\", unit = \"..\", latex = \"..\" }"),
    row("about.*.text", text, "what it is", "the text of '{0}'"),
    row("about.*.unit", text, "its unit", "the unit of '{0}'"),
    row("about.*.latex", text, "its formula in LaTeX", "the latex of '{0}'"),
    row("scene", table, "set-ups to simulate", "[scene]").of("scenes", 0, 200), // they are copied along 'like'
    row("scene.*", table, "one of them", "scene '{0}'")
        .needing("sample|samples|at? tolerance|relative? tolerance|absolute?"),
    row("scene.*.like", text, "the scene that it starts from as a copy"),
    row("scene.*.form", word, "the form of the equations")
        .one_of("lagrange hamilton pontryagin discrete first_order :forms"),
    row("scene.*.method", text, "the method that integrates them, see lagen methods"),
    row("scene.*.rest", flag, "fibre coordinates left out are zero"),
    row("scene.*.project", flag, "move the start onto the constraints"),
    row("scene.*.start", expression, "the time of the start: 0 where left out", "", constants),
    row("scene.*.duration", expression, "how long it runs", "", constants),
    row("scene.*.step", expression, "the step of methods with fixed steps", "", constants),
    row("scene.*.tolerance", expression, "the tolerance, relative and absolute", "", constants),
    row("scene.*.relative", expression, "the relative tolerance", "", constants),
    row("scene.*.absolute", expression, "the absolute tolerance", "", constants),
    row("scene.*.time_scale", expression, "a scale of the steps of a splitting", "", any_role),
    row("scene.*.sample", expression, "a row each so often, or at each event of this name", "", constants),
    row("scene.*.samples", count, "the number of rows").within(2, 10'000'000),
    row("scene.*.at", times, "the times of the rows", "", constants).of("times", 0, 100'000),
    row("scene.*.initial", table, "the start"),
    row("scene.*.initial.*", array, "the initial value of a coordinate, momentum or state",
        "the initial value of '{1}'", constants),
    row("scene.*.parameters", table, "values of parameters in this scene"),
    row("scene.*.parameters.*", array, "the value of a parameter", "the value of parameter '{1}'", constants),
    row("scene.*.inputs", file, "inputs as functions, or a table of their values")
        .like("inputs = { u = \"..\" }, or the name of a CSV file"),
    row("scene.*.inputs.*", array, "an input over the time and the state", "the input '{1}' of scene '{0}'",
        velocity | Role::ambient | Role::state)
        .any_function(),
    row("scene.*.element", array, "the group part of the first arrow", "", constants),
    row("scene.*.next", table, "the target of the first arrow"),
    row("scene.*.next.*", array, "the next value of a base coordinate", "the next value of '{1}'", constants),
    row("scene.*.steps", count, "the number of steps of a discrete scene").within(1, 1'000'000'000),
    row("scene.*.observe", strings, "the columns: names, expressions, or state for all states"),
    row("scene.*.events", table, "crossings of zero that are looked for").of("events", 0, 1000),
    row("scene.*.events.*", table, "one of them", "event '{1}' of scene '{0}'").needing("when"),
    row("scene.*.events.*.when", expression, "the function that crosses zero", "", any_role)
        .any_function()
        .like("when = \"an expression that crosses zero\""),
    row("scene.*.events.*.direction", word, "the direction of the crossing").one_of("rising falling any :directions"),
    row("scene.*.events.*.stop", flag, "the run ends there"),
    row("scene.*.events.*.count", count, "at which crossing it does").within(1, 1'000'000'000),
    row("scene.*.events.*.jump", table, "what the crossing changes"),
    row("scene.*.events.*.jump.*", array, "the value behind the crossing",
        "'{2}' in the jump of event '{1}' of scene '{0}'", any_role)
        .any_function(),
    row("scene.*.plot", table, "the picture of --plot", "[scene.{0}.plot]").like("curves = [\"t:x\", \"x:y\"]"),
    row("scene.*.plot.like", text, "the scene whose picture it starts from as a copy"),
    row("scene.*.plot.curves", panels, "curves by their coordinates, t:x or x:y or x:y:z, a list of them a panel")
        .like("one entry is written [\"..\"], several [\"..\", \"..\"]"),
    row("scene.*.plot.equal", flag, "all axes have one scale"),
    row("scene.*.plot.points", flag, "the rows as points, with nothing between them"),
    row("scene.*.plot.sphere", flag, "a sphere around the origin"),
    row("morphism", table, "in the place of a model: a map between two models")
        .needing("compose|source? compose|target? compose|base? compose|fibre? compose|parameters? compose|controls? "
                 "compose|element?"),
    row("morphism.source", text, "the file of the model where it starts").like(ends),
    row("morphism.target", text, "the file of the model where it ends").like(ends),
    row("morphism.compose", strings, "files of morphisms that follow each other")
        .like("compose = [\"first.toml\", \"second.toml\"]")
        .of("morphism files", 2),
    row("morphism.equals", text, "the file of a morphism that is claimed to be the same map"),
    row("morphism.base", table, "coordinates of the target over those of the source"),
    row("morphism.base.*", array, "a base coordinate of the target", "the value of '{0}'"),
    row("morphism.fibre", table, "fibre coordinates of the target, linear in those of the source"),
    row("morphism.fibre.*", array, "a fibre coordinate of the target", "the value of '{0}'"),
    row("morphism.parameters", table, "parameters of the target over those of the source"),
    row("morphism.parameters.*", array, "a parameter of the target", "the value of '{0}'"),
    row("morphism.controls", table, "controls of the target over those of the source"),
    row("morphism.controls.*", array, "a control of the target", "the value of '{0}'"),
    row("morphism.element", array, "the group element of the target over arrows of the source", "the element"),
    row("compose", strings, "files of morphisms that follow each other", "'compose' of [morphism]")
        .like("compose = [\"first.toml\", \"second.toml\"]")
        .of("morphism files", 2),
};

constexpr KindRow kinds[] = {
    {"algebroid", "general", "anchor bracket", ""},
    {"algebroid", "tangent", "over", ""},
    {"algebroid", "lie_algebra", "algebra bracket", "algebra|bracket"},
    {"algebroid", "action", "algebra bracket anchor representation", "algebra|bracket anchor|representation"},
    {"algebroid", "subbundle", "spanned_by", "spanned_by"},
    {"algebroid", "atiyah", "algebra bracket connection", "algebra|bracket"},
    {"algebroid", "frame", "of sections", "of sections"},
    {"algebroid", "product", "of", "of"},
    {"algebroid", "prolongation", "of bundle", "of"},
    {"algebroid", "level_set", "", ""},
    {"algebroid", "nonholonomic", "of sections drift constraints", "of sections/constraints"},
    {"algebroid", "first_order", "", ""},
    {"groupoid", "pair", "", ""},
    {"groupoid", "group", "group generators element", "group|generators"},
    {"groupoid", "action", "group generators element action", "group|generators action"},
    {"groupoid", "atiyah", "group generators element", "group|generators"},
};

} // namespace format

std::span<const SchemaRow> schema_rows()
{
    return format::rows;
}

std::span<const KindRow> kind_rows()
{
    return format::kinds;
}

} // namespace lagen
