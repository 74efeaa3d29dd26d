// SPDX-License-Identifier: GPL-2.0-or-later
/// The record of a model file: names in the order of the file, exact numbers, closed trees, positions.
/// It knows no geometry: the bracket of a `tangent` algebroid is simply absent here.
/// Families are flattened: their entries are symbols of the lists below, in order; `families` joins them.
#pragma once

#include "expression/scope.hpp"
#include "expression/symbol.hpp"

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace lagen {

/// `n = 8` of [sizes], or its value from the command line.
struct Size {
    std::string name;
    long value;
    SourceRange where;
};

enum class Role; // in model/names.hpp

/// A vector or matrix of declared symbols: entries first, first + 1, .. (by rows) of the list of its role.
struct Family {
    std::string name;
    Role role;
    Shape shape;
    std::size_t first;
    SourceRange where;
};

struct Parameter {
    Symbol symbol;
    Tree value;         ///< closed over the other parameters; acyclic
    bool bound = false; ///< a constant of the equations, no parameter of what is generated
};

struct Base {
    std::vector<Symbol> coordinates;           ///< x^i; empty where M is a point
    std::vector<Tree> constraints;             ///< closed trees over x and parameters; M is their common zero set
    std::vector<SourceRange> constraint_texts; ///< where each stands, or the matrix that it is an entry of
    std::vector<NamedTree> casimirs;           ///< claimed rho_a(f) = 0
    std::vector<Tree> found_casimirs;          ///< more of them, where a start is to be moved: what read them adds none
    std::vector<Tree> domain;                  ///< strict comparisons (<, >, !=) that hold on M
};

struct Fibre {
    std::vector<Symbol> coordinates; ///< y^a, one a frame section e_a
    std::vector<Symbol> momenta;     ///< mu_a; default names "p_" + coordinate
};

/// rho(e_section) contains value * d/d(coordinate).
struct AnchorEntry {
    std::size_t section;
    std::size_t coordinate;
    Tree value;
    SourceRange where;
};

/// [e_a, e_b] contains value * e_c, with a and b in the order in which the file has them.
struct BracketEntry {
    std::size_t a, b, c;
    Tree value;
    SourceRange where;
};

/// e'_section = value * e_inner + ..: a row of the matrix A of a frame, e'_a = A_a^b e_b, or of the sections of a
/// nonholonomic distribution.
struct SectionEntry {
    std::size_t section; ///< a, of this block's fibre; of a drift 0
    std::size_t inner;   ///< b, of the inner block's fibre
    Tree value;
    SourceRange where;
};

/// A_i^c: the connection's component on the vertical section `section` along the base coordinate `coordinate`.
struct ConnectionEntry {
    std::size_t coordinate; ///< i
    std::size_t section;    ///< c, of this block's fibre (a vertical one)
    Tree value;
    SourceRange where;
};

enum class AlgebroidKind {
    general,
    tangent,
    lie_algebra,
    action,
    subbundle,
    atiyah,
    frame,
    product,
    prolongation,
    level_set,    ///< TM restricted to the base constraints, in a frame made of them
    nonholonomic, ///< a distribution in the inner algebroid, which need not be one itself
    first_order,  ///< no algebroid: the base alone, whose coordinates have the rates of [rates]
    groupoid      ///< no [algebroid]: that of the model's groupoid
};

/// One [algebroid] or [algebroid.of] table. The outermost block's fibre is the model's; inner blocks have their own.
/// Sections are numbers of this block's `fibre`; base coordinates are numbers of Model::base.coordinates.
struct AlgebroidBlock {
    AlgebroidKind kind = AlgebroidKind::general;
    std::vector<Symbol> fibre;     ///< e_a of this block
    std::vector<std::size_t> base; ///< the coordinates of its own base, in order
    std::string algebra;           ///< a named Lie algebra (lie_algebra, action, atiyah), or empty
    SourceRange algebra_where;
    std::vector<std::size_t> over;          ///< tangent: the base coordinates that move, in order
    std::vector<AnchorEntry> anchor;        ///< general, action; subbundle: spanned_by; level_set: its frame
    std::vector<BracketEntry> bracket;      ///< general, lie_algebra, action; atiyah: of its vertical sections
    std::vector<ArrayValue> representation; ///< action: A_a, rho_a = -(A_a x)^i d/dx^i
    SourceRange representation_where;
    std::vector<ConnectionEntry> connection; ///< atiyah
    std::vector<SectionEntry> sections;      ///< frame, nonholonomic
    std::vector<SectionEntry> drift;         ///< nonholonomic: b = b^a e_a, by `inner`
    std::vector<Tree> constraints;           ///< nonholonomic: over t, x, Y and parameters, each is 0 on b + D
    std::vector<std::size_t> kept;           ///< nonholonomic by constraints alone: the Y that are the fibre
    std::size_t rank = 0;                    ///< groupoid: the number of its sections
    bool dual = false;                       ///< prolongation: bundle = "E*"
    std::vector<AlgebroidBlock> of;          ///< frame, prolongation, nonholonomic: one; product: its factors
    SourceRange where;
};

/// True where the block, or one inside it, is of this kind.
[[nodiscard]] bool contains(const AlgebroidBlock& block, AlgebroidKind kind);

enum class GroupoidKind { pair, group, action, atiyah };

/// [groupoid]: a Lie groupoid over M, whose arrows have the coordinates x (of the source), x_next (of the target; pair
/// and Atiyah groupoids) and W (a matrix of the group; all kinds but pair).
struct GroupoidBlock {
    GroupoidKind kind = GroupoidKind::pair;
    std::string group;                  ///< "SO(3)"; empty where generators are given
    std::vector<ArrayValue> generators; ///< E_c over parameters, all of one size; of a named group its basis
    std::vector<Symbol> next;           ///< x_next, one a base coordinate
    std::vector<Symbol> element;        ///< W[1,1], W[1,2], .. by rows
    std::vector<Tree> action;           ///< (x.W)^i over x, W and parameters, one a base coordinate
    SourceRange where;
    SourceRange group_where; ///< of the name, or of the generators

    [[nodiscard]] bool has_targets() const { return kind == GroupoidKind::pair || kind == GroupoidKind::atiyah; }
    [[nodiscard]] bool has_group() const { return kind != GroupoidKind::pair; }
};

/// [discrete]: a discrete Lagrangian on the groupoid, written out or made from [lagrangian] by a scheme.
struct DiscreteBlock {
    Symbol step;            ///< h: a parameter, or a symbol of its own
    Tree lagrangian;        ///< over t, x, x_next, W, h and parameters; null where a scheme makes it
    std::string scheme;     ///< "midpoint", "gauss:2", ..; empty where L is written out
    std::string retraction; ///< "cayley" or "exp"; empty where the file leaves the choice open
    SourceRange where, scheme_where, retraction_where;
};

enum class Direction { rising, falling, any };

/// `when` crosses zero in `direction`; a run ends at the count-th crossing where `stop`.
struct Event {
    std::string name;
    Tree when; ///< closed over t, x, y, momenta, parameters
    Direction direction = Direction::any;
    bool stop = false;
    long count = 1;
    std::vector<NamedTree> jump; ///< what follows the crossing: values of coordinates, momenta, first-order states
    SourceRange where;
};

/// Where rows are wanted: every `interval`, `count` even ones, at these times, or at each crossing of an event.
struct Sampling {
    enum class Kind { standard, interval, count, at, event } kind = Kind::standard; ///< standard: 201 even ones
    Tree interval;
    std::size_t count = 201;
    std::vector<Tree> at = {};
    std::string event = {};
    SourceRange event_where = {};
};

/// Where "state" stands in `observe`: that many columns from `first` on.
struct StateColumns {
    std::size_t first, count;
    SourceRange where;
};

/// A curve of a picture by its coordinates, which are named as they are written: two in the plane, three in space.
struct PlotCurve {
    std::vector<NamedTree> coordinates;
    SourceRange where;
};

/// [scene.NAME.plot]: what `--plot` draws in the place of time series.
struct Plot {
    std::vector<std::vector<PlotCurve>> panels; ///< the curves of each, all in the plane or all in space
    bool equal = false;                         ///< all axes have one scale
    bool points = false;                        ///< the rows of the scene as points, and nothing between them
    std::optional<bool> sphere; ///< around the origin, in space; absent: where the curves of a panel lie on one
};

/// A CSV file with a column t and others called like inputs, whose values are held between its rows.
struct InputTable {
    std::string path; ///< relative to the model file
    SourceRange where;
};

/// One set-up to simulate; `like` is resolved already. All values are trees over the parameters.
struct Scene {
    std::string name;
    SourceRange where;
    std::vector<NamedTree> initial; ///< base coordinates, and fibre coordinates or momenta
    bool rest = false;              ///< fibre coordinates left out are zero
    bool project = false;           ///< move the start onto the constraints
    Tree start;                     ///< null: 0
    Tree duration;                  ///< null where the scene gives none
    std::vector<NamedTree> parameters;
    std::vector<NamedTree> inputs;         ///< u over t, the state and parameters; those left out have their defaults
    std::optional<InputTable> input_table; ///< in the place of `inputs`
    std::string form;                      ///< empty: the default for the model
    SourceRange form_where, method_where;
    std::string method;     ///< empty: the default for the form
    std::string stepped_by; ///< the method that makes its motion discrete, where the scene alone is not
    Tree step, tolerance, relative, absolute; ///< null where absent
    Tree time_scale; ///< of the steps of a splitting, over everything observable; null where absent
    SourceRange time_scale_where;
    std::vector<Tree> element; ///< W of the first arrow of a discrete scene, by rows; or empty
    SourceRange element_where;
    std::vector<NamedTree> next; ///< the target of the first arrow, by base coordinates
    std::optional<long> steps;   ///< of a discrete scene
    Sampling sampling;
    std::optional<std::vector<NamedTree>> observe; ///< absent: all states
    std::optional<StateColumns> states;            ///< where "state" stands in `observe`
    std::vector<Event> events;
    std::optional<Plot> plot;
};

/// Q_section or sigma^section: an entry of [forces] or of [control] sigma.
struct ComponentEntry {
    std::size_t section;
    Tree value;
    SourceRange where; ///< of the key
};

/// lower <= u^control <= upper; a null bound is none ("-inf", "inf"), and one of the two is there.
struct ControlBound {
    std::size_t control;
    Tree lower, upper; ///< closed over parameters
    SourceRange where;
};

/// [control.boundary]: values at both ends.
struct ControlBoundary {
    std::vector<NamedTree> from, to; ///< base coordinates; one left out of `to` is free
    Tree duration;                   ///< null where it is free or absent
    bool free_duration = false;
    Tree terminal_cost; ///< closed over base coordinates and parameters; null where absent
    SourceRange where;
};

/// An optimal control problem: the section sigma = sigma^a(x, u, t) e_a and the running cost.
struct Control {
    std::vector<Symbol> controls; ///< u^A
    std::vector<ComponentEntry> sigma;
    Tree cost; ///< closed over t, x, u, parameters
    std::vector<ControlBound> bounds;
    std::vector<Tree> guess; ///< of each control, over t, x, mu, parameters; null where none is given; or empty
    std::optional<ControlBoundary> boundary;
    SourceRange where;
};

/// u of [inputs]: what acts from outside. A header has it as a member of `inputs`, a scene says what it is.
struct Input {
    Symbol symbol;
    Tree value; ///< its default, closed over parameters
};

/// z of [states] with z' = rate: it stands beside the algebroid, whose coordinates are none of it.
struct FirstOrderState {
    Symbol symbol;
    Tree rate;     ///< closed over t, x, y, momenta, parameters, inputs and other first-order states
    int start = 0; ///< where a scene does not say
};

/// An entry of [reconstruct]: a matrix g of a named group with g' = g xi, entry by entry among the first-order states.
struct Reconstruction {
    std::string group;                  ///< "SO(3)"
    std::vector<ArrayValue> generators; ///< E_c, numbers; xi = xi^c E_c
    std::size_t first_section;          ///< the section of the fibre that xi^0 is the component on
    std::size_t size;                   ///< g is size x size
    std::size_t first;                  ///< of its entries among the states, by rows
    std::string name;
    SourceRange where; ///< of the group

    [[nodiscard]] bool holds(std::size_t state) const { return state >= first && state < first + size * size; }
};

/// A component of an E-form, value e^{indices[0]} ^ e^{indices[1]} ^ ..; of a form of degree 0 the function itself.
struct FormComponent {
    std::vector<std::size_t> indices; ///< of fibre coordinates, all different
    Tree value;                       ///< closed over base coordinates and parameters
};

/// An expression in forms: what `equals` of [forms] says.
struct FormExpression {
    enum class Kind {
        form,         ///< the form number `form` of the model
        function,     ///< a form of degree 0
        sum,          ///< of all parts
        negative,     ///< of the one part
        wedge,        ///< of all parts; with functions their product
        differential, ///< d of the one part
        contraction,  ///< i(section, part)
    } kind = Kind::function;
    std::size_t form = 0;
    Tree function;             ///< closed over base coordinates and parameters
    std::vector<Tree> section; ///< its components, one a fibre coordinate
    std::vector<FormExpression> parts;
    std::size_t degree = 0;
};

/// An entry of [forms], with what is claimed of it.
struct NamedForm {
    std::string name;
    SourceRange where; ///< of the name
    std::size_t degree = 0;
    std::vector<FormComponent> components;
    bool closed = false;                  ///< claimed: d of it is zero
    std::optional<FormExpression> equals; ///< claimed
};

/// A candidate section alpha of E* for Hamilton and Jacobi's equation: alpha = dS, or by its components over the base.
struct HamiltonJacobi {
    SourceRange where;
    Tree S; ///< null where the components are given
    std::vector<ComponentEntry> alpha;
};

/// A section s = s^a(x) e_a of E whose complete lift is claimed to leave L (H, the discrete L) invariant.
struct Symmetry {
    std::string name;
    SourceRange where;
    std::vector<ComponentEntry> section;
    Tree momentum; ///< p_a s^a, the observable "momentum.NAME"
};

struct Model {
    std::string name; ///< a C++ identifier
    SourceRange name_where;
    std::string title;
    std::shared_ptr<const SourceFile> file;
    std::vector<std::shared_ptr<const SourceFile>> included; ///< files named by `of`, in order of first use, no twice

    std::vector<Size> sizes;
    std::vector<Family> families;
    std::vector<Parameter> parameters;
    Base base;
    Fibre fibre;
    AlgebroidBlock algebroid;
    std::optional<GroupoidBlock> groupoid;
    std::optional<DiscreteBlock> discrete;
    std::vector<Definition> definitions; ///< as written, for documentation
    Tree lagrangian;                     ///< closed over t, x, y (Y), parameters; null where absent
    SourceRange lagrangian_where;
    std::vector<Tree> rates; ///< xdot^i(t, x, z, u) of kind first_order, one a base coordinate; else empty
    Tree hamiltonian;        ///< closed over t, x, momenta, parameters; null where absent
    SourceRange hamiltonian_where;
    std::vector<ComponentEntry> forces; ///< Q_a(t, x, y, z, u): on the right of Lagrange's and of Hamilton's equations
    Tree dissipation;                   ///< Rayleigh's R(t, x, y): Q_a gains -dR/dy^a; null where absent
    std::optional<Control> control;
    std::vector<Input> inputs;
    std::vector<FirstOrderState> states; ///< of [states], then the entries of [reconstruct]
    std::vector<Reconstruction> reconstructions;
    std::optional<std::size_t> jacobi_field; ///< the first of its states, sigma^a, then delta y^a; added by a command
    std::vector<NamedTree> observables;
    std::vector<NamedTree> invariants;
    std::vector<Symmetry> symmetries;
    std::vector<NamedForm> forms;
    std::optional<HamiltonJacobi> hamilton_jacobi;
    std::vector<Symbol> notes; ///< [about] of definitions, Casimirs, observables, invariants and t
    std::vector<Scene> scenes; ///< in the order of the file

    Scope scope;    ///< symbols and definitions: what L may use
    Scope observer; ///< with momenta, controls, inputs, first-order states, energy, hamiltonian, lagrangian,
                    ///< observables and invariants: what expressions from the command line may use
    Scope columns;  ///< the observer's with the coordinates of an arrow: what columns and curves may use
};

/// The functions that runs follow as constant: the invariants, and the momenta of symmetries where nothing pushes and
/// no control acts.
[[nodiscard]] std::vector<NamedTree> conserved_trees(const Model& model);

/// The scene called `name`; with an empty name `default`, else the first. Throws ModelError where there is none.
[[nodiscard]] const Scene& find_scene(const Model& model, const std::string& name);

[[nodiscard]] bool is_nonholonomic(const Model& model);
/// The coordinates that L, forces and R are written in: y, or Y of a nonholonomic model, the fibre coordinates of its
/// ambient algebroid.
[[nodiscard]] const std::vector<Symbol>& ambient_fibre(const Model& model);

/// The cost of a control problem up to now, J' = cost with J = 0 at the start: a first-order state that lagen adds
/// behind those of the model, and that a motion carries only where somebody names it.
inline constexpr const char* total_cost_name = "total_cost";

/// True where state k is that one; one that a model declares itself is not.
[[nodiscard]] inline bool is_total_cost(const Model& model, std::size_t k)
{
    const Symbol& symbol = model.states[k].symbol;
    return model.control && symbol.name == total_cost_name && symbol.where.file == nullptr;
}

/// All parameter names, then base, fibre, controls: the names of symbols that a model declares itself, besides momenta.
[[nodiscard]] std::vector<std::string> symbol_names(const Model& model);

} // namespace lagen
