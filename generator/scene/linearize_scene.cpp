// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/linearize_scene.hpp"

#include "analysis/leaf.hpp"
#include "geometry/rational_near.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "graph/core/lower.hpp"
#include "graph/unknowns/solve_unknowns.hpp"
#include "kernels/formulation.hpp"
#include "model/scene_form.hpp"
#include "scene/evaluate_scene.hpp"
#include "scene/start_state.hpp"
#include "text/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

using linear::Matrix;

/// The equations over the state and the inputs, and where the scene starts.
struct Plant {
    Graph graph;
    MotionEquations equations;
    std::vector<MotionPoint> starts; ///< that of the scene, and the same without velocities or momenta
    std::vector<NamedNumber> parameters;
    std::vector<std::string> following;
};

constexpr long double level_rounding = 1e-15L; ///< of the level of a function at a start in doubles, relative

void require_rates(const Scene& scene)
{
    const FormKind kind = form_named(scene.form).kind;
    if (kind == FormKind::lagrange || kind == FormKind::hamilton) return;
    throw MathematicsError(fmt::format("scene '{}' is run in the form '{}': Lagrange's and Hamilton's equations are "
                                       "linearised",
                                       scene.name, scene.form),
                           kind == FormKind::pontryagin
                               ? "[inputs] in the place of [control], for an input that is given"
                               : "--form lagrange, where the model has [lagrangian]");
}

class PlantMaker {
  public:
    PlantMaker(CheckedModel& checked, const Scene& scene)
        : checked_(checked), model_(checked.model), system_(checked.system), scene_(scene),
          values_(evaluate_scene(checked.model, scene))
    {
        const std::vector<long double> parameters = finite_numbers(values_.parameters, scene);
        set_parameters(checked, parameters);
        set_parameters(checked.system, parameters);
    }

    Plant make()
    {
        out_.graph = system_.graph;
        FormulationRequest request;
        request.states = carried_states(model_, scene_.form, &scene_);
        const Formulation form =
            formulation(out_.graph, model_, system_, checked_.report, form_named(scene_.form).kind, request);
        out_.equations.state = state_of(form);
        out_.equations.inputs = system_.inputs;
        out_.equations.rates = form.derivative;
        out_.equations.implicit = form.implicit;
        set_starts(form);
        leave_out_matrices();
        set_leaf();
        out_.equations.domain = system_.domain;
        out_.parameters = values_.parameters;
        insert_parameters();
        require_autonomous();
        return std::move(out_);
    }

  private:
    void set_starts(const Formulation& form)
    {
        StartState start(checked_, scene_.form);
        const std::vector<long double> numbers = start(values_);
        std::vector<double> state(numbers.begin(), numbers.end());
        const std::map<std::string, double> known = add_start(form, state);
        std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(form.x.size()), form.lanes.size(), 0.0);
        add_start(form, state);
        Lowering lower(out_.graph, form.binding);
        for (const Input& input : model_.inputs) {
            const auto given = std::ranges::find(scene_.inputs, input.symbol.name, &NamedTree::name);
            const Tree& tree = given != scene_.inputs.end() ? given->value : input.value;
            const NodeId node[] = {lower(tree)};
            const double value = evaluate<double>(out_.graph, node, known)[0];
            if (!std::isfinite(value))
                throw MathematicsError(fmt::format("the input '{}' is no finite number at the start of scene '{}'",
                                                   input.symbol.name, scene_.name));
            for (MotionPoint& each : out_.starts) each.inputs.push_back(value);
            keep_rest(input, tree, node[0], value);
        }
    }

    /// An input of parameters alone is exactly what they make it: u + m g/2 - value stands for u, which is `value`.
    void keep_rest(const Input& input, const Tree& tree, NodeId node, double value)
    {
        std::map<std::string, Rational> known;
        for (const auto& [parameter, constant] : system_.parameter_values)
            known[out_.graph.input_name(parameter)] = out_.graph.value(constant);
        const std::vector<std::string> names = names_in(tree);
        if (!std::ranges::all_of(names, [&](const std::string& name) { return known.contains(name); })) return;
        const std::vector<Rational> exact = evaluate_exactly(out_.graph, std::vector{node}, known);
        if (exact.empty() || exact[0] == Rational(value)) return;
        const NodeId u = out_.graph.input(input.symbol.name);
        rests_.emplace_back(u, out_.graph.add(u, out_.graph.constant(exact[0] - Rational(value))));
    }

    /// Without inputs; by names what is known there.
    std::map<std::string, double> add_start(const Formulation& form, const std::vector<double>& state)
    {
        std::map<std::string, double> known{{"t", static_cast<double>(values_.start)}};
        for (const auto& [name, value] : values_.parameters) known[name] = static_cast<double>(value);
        for (std::size_t k = 0; k < state.size(); ++k) known[out_.graph.input_name(out_.equations.state[k])] = state[k];
        solve_unknowns<double>(out_.graph, form.implicit, known);
        MotionPoint& out = out_.starts.emplace_back(MotionPoint{state, {}, {}});
        for (const ImplicitBlock& block : form.implicit)
            for (const NodeId z : block.unknowns) out.unknowns.push_back(known.at(out_.graph.input_name(z)));
        return known;
    }

    /// Nine entries with R' = R xi are no nine coordinates.
    void leave_out_matrices()
    {
        std::vector<NodeId>&state = out_.equations.state, &rates = out_.equations.rates;
        for (const Reconstruction& g : model_.reconstructions) {
            const auto first = std::ranges::find(state, system_.states[g.first]);
            if (first == state.end()) continue;
            const auto place = first - state.begin(), size = static_cast<std::ptrdiff_t>(g.size * g.size);
            const std::vector<NodeId> entries(first, first + size);
            rates.erase(rates.begin() + place, rates.begin() + place + size);
            if (depends_on_any(out_.graph, rates, entries))
                throw MathematicsError(
                    fmt::format("the motion depends on the matrix '{}' of [reconstruct], whose {} entries are no "
                                "coordinates of a group",
                                g.name, g.size * g.size),
                    "an action algebroid has the columns of the matrix that act as base coordinates");
            state.erase(first, first + size);
            for (MotionPoint& start : out_.starts)
                start.state.erase(start.state.begin() + place, start.state.begin() + place + size);
            out_.following.push_back(g.name);
        }
    }

    /// Levels that are a short fraction but for rounding are that.
    void set_leaf()
    {
        const Leaves leaves = leaves_of(out_.graph, system_);
        out_.equations.constraints = leaves.constraints;
        out_.equations.base = system_.algebroid.x;
        out_.equations.fields = leaves.fields;
        std::map<std::string, long double> start;
        for (std::size_t k = 0; k < out_.equations.state.size(); ++k)
            start[out_.graph.input_name(out_.equations.state[k])] = out_.starts.front().state[k];
        const std::vector<long double> levels = evaluate<long double>(out_.graph, leaves.casimirs, start);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const Rational level =
                rational_near(levels[k], level_rounding).value_or(Rational(static_cast<double>(levels[k])));
            out_.equations.casimirs.push_back(out_.graph.subtract(leaves.casimirs[k], out_.graph.constant(level)));
        }
    }

    void insert_parameters()
    {
        const auto insert = [this](std::vector<NodeId>& nodes) {
            nodes = substitute(out_.graph, substitute(out_.graph, nodes, system_.parameter_values), rests_);
        };
        insert(out_.equations.rates);
        insert(out_.equations.constraints);
        insert(out_.equations.casimirs);
        insert(out_.equations.domain);
        for (ImplicitBlock& block : out_.equations.implicit) insert(block.residuals);
    }

    void require_autonomous() const
    {
        std::vector<NodeId> nodes = out_.equations.rates;
        for (const ImplicitBlock& block : out_.equations.implicit)
            nodes.insert(nodes.end(), block.residuals.begin(), block.residuals.end());
        if (depends_on_any(out_.graph, nodes, std::vector<NodeId>{system_.time}))
            throw MathematicsError(
                fmt::format("the equations of model '{}' depend on the time t, and have no equilibria", model_.name),
                "what acts from outside may be an input: [inputs]");
    }

    CheckedModel& checked_;
    const Model& model_;
    const System& system_;
    const Scene& scene_;
    SceneValues values_;
    Plant out_;
    Replacements rests_; ///< of inputs that are no floating-point numbers
};

constexpr double weight_tolerance = 1e-12; ///< of the largest entry

/// One of the two in numbers.
class WeightReader {
  public:
    WeightReader(const Values& parameters, const char* name, const CostWeight& weight) : name_(name), weight_(weight)
    {
        TreeValues value_of;
        for (const Tree& entry : weight.value.entries) {
            numbers_.push_back(static_cast<double>(value_of(entry, parameters)));
            if (!std::isfinite(numbers_.back())) fail("has an entry that is no finite number");
        }
    }

    /// Symmetric, with eigenvalues of at least `least` times the largest.
    [[nodiscard]] Matrix read(std::size_t n, double least, const char* definite) const
    {
        const Matrix M = matrix(static_cast<Eigen::Index>(n));
        const double size = M.cwiseAbs().maxCoeff();
        for (Eigen::Index i = 0; i < M.rows(); ++i)
            for (Eigen::Index j = 0; j < i; ++j)
                if (std::abs(M(i, j) - M(j, i)) > weight_tolerance * size)
                    fail(fmt::format("is not symmetric: its entry [{0},{1}] is {2:.6g}, and [{1},{0}] is {3:.6g}",
                                     i + 1, j + 1, M(i, j), M(j, i)));
        const double smallest = Eigen::SelfAdjointEigenSolver<Matrix>(M).eigenvalues().minCoeff();
        if (!(smallest >= least * size) || (least > 0 && size == 0))
            fail(fmt::format("is not {}: its least eigenvalue is {:.6g}", definite, smallest));
        return M;
    }

  private:
    [[nodiscard]] Matrix matrix(Eigen::Index n) const
    {
        const Eigen::Map<const Eigen::VectorXd> entries(numbers_.data(), static_cast<Eigen::Index>(numbers_.size()));
        const Shape& shape = weight_.value.shape;
        const auto rows = static_cast<Eigen::Index>(shape.rows), columns = static_cast<Eigen::Index>(shape.columns);
        if (shape.rank == Rank::scalar) return entries[0] * Matrix::Identity(n, n);
        if (shape.rank == Rank::vector && rows == n) return entries.asDiagonal();
        if (shape.rank == Rank::matrix && rows == n && columns == n) return entries.reshaped<Eigen::RowMajor>(n, n);
        fail(fmt::format("is {}, where a number, a vector of {} or a {} x {} matrix is required", to_text(shape), n, n,
                         n));
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw ModelError(fmt::format("{} of --lqr {}", name_, what), weight_.where);
    }

    const char* name_;
    const CostWeight& weight_;
    std::vector<double> numbers_;
};

Matrix matrix_of(const std::vector<std::vector<double>>& rows, std::size_t columns)
{
    Matrix out(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns));
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < columns; ++j)
            out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j];
    return out;
}

std::vector<linear::MultipleEigenvalue> eigenvalues_of(const Equilibrium& found)
{
    std::vector<linear::MultipleEigenvalue> out;
    std::size_t count = 0;
    for (const proof::Eigenvalue& each : found.eigenvalues) {
        out.push_back({{each.real, each.imaginary}, each.multiplicity, each.spread});
        count += each.multiplicity;
    }
    if (count != found.at.state.size()) throw InternalError("eigenvalues that are not as many as the states");
    return out;
}

linear::Regulator regulator_of(const LinearisedScene& scene, const Matrix& Q, const Matrix& R)
{
    const auto found = linear::regulator(scene.system, scene.modes, Q, R);
    if (const auto* const regulator = std::get_if<linear::Regulator>(&found)) return *regulator;
    using Reason = linear::NoRegulator::Reason;
    const auto& [reason, lambda] = std::get<linear::NoRegulator>(found);
    switch (reason) {
    case Reason::not_reached:
        throw MathematicsError(
            fmt::format("no gain stabilises this equilibrium: the inputs do not reach its mode of eigenvalue {}, which "
                        "does not decay",
                        complex_text(lambda.real(), lambda.imag())),
            "`lagen linearize` without --lqr shows the mode");
    case Reason::not_seen:
        throw MathematicsError(
            fmt::format("no gain of least cost stabilises this equilibrium: Q does not see its mode of eigenvalue {}, "
                        "which neither grows nor decays",
                        complex_text(lambda.real(), lambda.imag())),
            "weigh a coordinate that the mode moves");
    case Reason::not_found: break;
    }
    throw MathematicsError("no gain was found: floating point does not tell the stable half of the Hamiltonian matrix",
                           "choose Q and R nearer to each other");
}

} // namespace

LinearisedScene linearize_scene(CheckedModel& checked, const Scene& scene, const std::optional<QuadraticCost>& cost)
{
    require_rates(scene);
    Plant plant = PlantMaker(checked, scene).make();
    LinearisedScene out;
    out.model = checked.model.name;
    out.scene = scene.name;
    out.form = scene.form;
    out.following = std::move(plant.following);
    out.start = plant.starts.front();
    for (const NodeId s : plant.equations.state) out.states.push_back(plant.graph.input_name(s));
    for (const NodeId u : plant.equations.inputs) out.inputs.push_back(plant.graph.input_name(u));
    const std::size_t n = out.states.size(), m = out.inputs.size();
    if (cost && m == 0)
        throw MathematicsError(fmt::format("--lqr asks for a gain, and model '{}' has no inputs", checked.model.name),
                               "[inputs] u = 0, and u in [forces]");
    Matrix Q, R;
    if (cost) {
        const Values parameters(plant.parameters.begin(), plant.parameters.end());
        Q = WeightReader(parameters, "Q", cost->Q).read(n, -weight_tolerance, "positive semidefinite");
        R = WeightReader(parameters, "R", cost->R).read(m, weight_tolerance, "positive definite");
    }
    out.equilibrium = equilibrium_near(plant.graph, plant.equations, plant.starts);
    const Equilibrium& found = out.equilibrium;
    out.system = linear::linear_system(matrix_of(found.A, n), matrix_of(found.B, m), matrix_of(found.leaf, n));
    out.modes = linear::modes_of(out.system, eigenvalues_of(found));
    if (cost) out.regulator = regulator_of(out, Q, R);
    return out;
}

} // namespace lagen
