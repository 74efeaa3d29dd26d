// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen linearize`: an equilibrium near the start of a scene, the equations linearised there, and a gain.
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/line/values.hpp"
#include "commands/linearize/plant.hpp"
#include "commands/linearize/report.hpp"
#include "commands/machine/places.hpp"
#include "commands/machine/write_file.hpp"
#include "commands/scene/scene_options.hpp"
#include "linear/linear_system.hpp"
#include "scene/values.hpp"

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace lagen {

namespace {

// The value of --lqr is 'Q=expr;R=expr' over parameters. A number stands for so many times the unit matrix, a vector
// for a diagonal.

struct QuadraticCost {
    linear::Matrix Q, R; ///< shapes (n, n), (m, m)
};

using linear::Matrix;

constexpr double weight_tolerance = 1e-12; ///< of the largest entry

/// The parts NAME=expression between semicolons.
std::map<std::string, Excerpt> parts_of_cost(const std::string& text)
{
    const Excerpt whole = whole_text("<--lqr>", text);
    std::map<std::string, Excerpt> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::size_t equals = std::min(text.find('=', begin), end);
        const Excerpt name = trimmed(whole, begin, equals);
        if (equals == end || (name.text != "Q" && name.text != "R") || parts.contains(name.text))
            throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
        parts.emplace(name.text, trimmed(whole, equals + 1, end));
        begin = end + 1;
    }
    if (parts.size() < 2) throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
    return parts;
}

/// One of the two in numbers.
class WeightReader {
  public:
    WeightReader(const Model& model, const Values& parameters, const char* name, const Excerpt& text)
        : name_(name), where_(text.range(0, text.text.size())), array_(option_array(model, "lqr", text))
    {
        TreeValues value_of;
        for (const Tree& entry : array_.entries) {
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
        const Shape& shape = array_.shape;
        const auto rows = static_cast<Eigen::Index>(shape.rows), columns = static_cast<Eigen::Index>(shape.columns);
        if (shape.rank == Rank::scalar) return entries[0] * Matrix::Identity(n, n);
        if (shape.rank == Rank::vector && rows == n) return entries.asDiagonal();
        if (shape.rank == Rank::matrix && rows == n && columns == n) return entries.reshaped<Eigen::RowMajor>(n, n);
        fail(fmt::format("is {}, where a number, a vector of {} or a {} x {} matrix is required", to_text(shape), n, n,
                         n));
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw ModelError(fmt::format("{} of --lqr {}", name_, what), where_);
    }

    const char* name_;
    SourceRange where_;
    ArrayValue array_;
    std::vector<double> numbers_;
};

/// Throws UsageError where it has other parts, ModelError with the place in the option: no number, vector or matrix of
/// that many rows, not symmetric, Q not semidefinite, R not definite.
QuadraticCost read_cost(const Options& options, const Model& model, const Values& parameters, std::size_t n,
                        std::size_t m)
{
    const std::map<std::string, Excerpt> parts = parts_of_cost(options.get("lqr"));
    return {WeightReader(model, parameters, "Q", parts.at("Q")).read(n, -weight_tolerance, "positive semidefinite"),
            WeightReader(model, parameters, "R", parts.at("R")).read(m, weight_tolerance, "positive definite")};
}

using linear::Matrix;

const CommandSyntax linearize_syntax{
    "linearize",
    "MODEL",
    "Finds an equilibrium near the start of a scene, and linearises the equations of motion there: A and B, "
    "eigenvalues and modes, controllability, and the gain u = u0 - K x of least quadratic cost.",
    {option::scene,
     {"form", "FORM", "lagrange or hamilton; without it that of the scene"},
     option::set,
     option::initial,
     {"lqr", "'Q=..;R=..'", "the gain that makes the integral of x'Qx + u'Ru least: numbers, diagonals or matrices"},
     option::output,
     option::unchecked,
     option::format}};

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

linear::Regulator regulator_of(const LinearReport& report, const QuadraticCost& cost)
{
    const auto found = linear::regulator(report.system, report.modes, cost.Q, cost.R);
    if (const auto* const regulator = std::get_if<linear::Regulator>(&found)) return *regulator;
    using Reason = linear::NoRegulator::Reason;
    const auto& [reason, lambda] = std::get<linear::NoRegulator>(found);
    switch (reason) {
    case Reason::not_reached:
        throw MathematicsError(
            fmt::format("no gain stabilises this equilibrium: the inputs do not reach its mode of eigenvalue {}, which "
                        "does not decay",
                        eigenvalue_text(lambda)),
            "`lagen linearize` without --lqr shows the mode");
    case Reason::not_seen:
        throw MathematicsError(
            fmt::format("no gain of least cost stabilises this equilibrium: Q does not see its mode of eigenvalue {}, "
                        "which neither grows nor decays",
                        eigenvalue_text(lambda)),
            "weigh a coordinate that the mode moves");
    case Reason::not_found: break;
    }
    throw MathematicsError("no gain was found: floating point does not tell the stable half of the Hamiltonian matrix",
                           "choose Q and R nearer to each other");
}

} // namespace

ExitCode run_linearize(Arguments arguments)
{
    const Options options(linearize_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    CheckedModel checked = load(model_path(options.positional()[0]), options.settings(), options.has("unchecked"));
    require_apart(options, checked.model);
    const Scene scene = scene_of(options, checked.model, options.named("initial"));
    warn(warnings_of(checked, scene.form));
    Plant plant = plant_of(checked, scene);
    std::vector<std::string> states, inputs;
    for (const NodeId s : plant.equations.state) states.push_back(plant.graph.input_name(s));
    for (const NodeId u : plant.equations.inputs) inputs.push_back(plant.graph.input_name(u));
    if (options.has("lqr") && inputs.empty())
        throw MathematicsError(fmt::format("--lqr asks for a gain, and model '{}' has no inputs", checked.model.name),
                               "[inputs] u = 0, and u in [forces]");
    std::optional<QuadraticCost> cost;
    if (options.has("lqr")) {
        Values parameters;
        for (const auto& [name, value] : plant.parameters) parameters[name] = value;
        cost = read_cost(options, checked.model, parameters, states.size(), inputs.size());
    }
    Equilibrium found = equilibrium_near(plant.graph, plant.equations, plant.starts);
    const std::size_t n = states.size(), m = inputs.size();
    linear::LinearSystem system =
        linear::linear_system(matrix_of(found.A, n), matrix_of(found.B, m), matrix_of(found.leaf, n));
    const std::vector<linear::MultipleEigenvalue> eigenvalues = eigenvalues_of(found);
    LinearReport report{checked.model.name,
                        scene.name,
                        scene.form,
                        std::move(states),
                        std::move(inputs),
                        std::move(plant.following),
                        plant.starts.front(),
                        std::move(found),
                        std::move(system),
                        {},
                        {}};
    report.modes = linear::modes_of(report.system, eigenvalues);
    if (cost) report.regulator = regulator_of(report, *cost);
    write_file(options.has("output") ? options.get("output") : "-",
               as_json ? linear_json(report) : linear_text(report));
    return ExitCode::done;
}

} // namespace lagen
