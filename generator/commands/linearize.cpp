// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen linearize`: an equilibrium near the start of a scene, the equations linearised there, and a gain.
#include "analysis/equilibrium.hpp"
#include "commands/line/command.hpp"
#include "commands/line/options.hpp"
#include "commands/linearize/plant.hpp"
#include "commands/scene/scene_options.hpp"
#include "linear/linear_system.hpp"
#include "linear/regulator.hpp"
#include "machine/places.hpp"
#include "machine/write_file.hpp"
#include "scene/values.hpp"
#include "text/comma_list.hpp"
#include "text/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

namespace lagen {

namespace {

// The findings of `lagen linearize`, in text and in JSON.

struct LinearReport {
    std::string model, scene, form;
    std::vector<std::string> states, inputs, following;
    MotionPoint start;
    Equilibrium equilibrium;
    linear::LinearSystem system;
    std::vector<linear::Mode> modes; ///< of A, by real, then by imaginary parts
    std::optional<linear::Regulator> regulator;
};

using linear::Eigenvalue;
using linear::Matrix;
using linear::Mode;

constexpr double noticeable = 0.05;        ///< entries of a mode that the text shows, of the largest
constexpr double noticeable_spread = 1e-7; ///< of eigenvalues that are told as one

double positive_zero(double value)
{
    return value == 0 ? 0 : value;
}

std::string short_number(double value)
{
    return fmt::format("{:.6g}", positive_zero(value));
}

/// "-0.5", "0.1 +- 2i": a pair by one of it
std::string eigenvalue_text(Eigenvalue lambda)
{
    if (lambda.imag() == 0) return short_number(lambda.real());
    return fmt::format("{}{:.6g}i", lambda.real() == 0 ? "+-" : short_number(lambda.real()) + " +- ",
                       std::abs(lambda.imag()));
}

std::string assignments(const std::vector<std::string>& names, const std::vector<double>& values)
{
    std::string text;
    for (std::size_t k = 0; k < names.size(); ++k)
        text += fmt::format("{}{} = {:.12g}", k == 0 ? "" : ", ", names[k], positive_zero(values[k]));
    return text;
}

/// Cells in columns, indented; the last one flush left.
std::string table_text(const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> widths;
    for (const auto& row : rows) {
        widths.resize(std::max(widths.size(), row.size()), 0);
        for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
    }
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t k = 0; k < row.size(); ++k) text += fmt::format("  {:>{}}", row[k], widths[k]);
        text += "\n";
    }
    return text;
}

/// By rows, which may be empty: M.rowwise() does not take a matrix without columns.
std::vector<std::vector<double>> rows_of(const Matrix& M)
{
    std::vector<std::vector<double>> rows(static_cast<std::size_t>(M.rows()));
    for (Eigen::Index i = 0; i < M.rows(); ++i)
        for (Eigen::Index j = 0; j < M.cols(); ++j) rows[static_cast<std::size_t>(i)].push_back(M(i, j));
    return rows;
}

std::string matrix_text(const Matrix& M)
{
    std::vector<std::vector<std::string>> rows;
    for (const std::vector<double>& row : rows_of(M)) {
        rows.emplace_back();
        for (const double entry : row) rows.back().push_back(short_number(entry));
    }
    return table_text(rows);
}

/// "w 1, th 0.2 at -90 deg", the largest first.
std::string shape_text(const Eigen::VectorXcd& shape, const std::vector<std::string>& states)
{
    std::vector<std::size_t> order(states.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto at = [&](std::size_t k) { return shape[static_cast<Eigen::Index>(k)]; };
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return std::abs(at(a)) > (1 + 1e-9) * std::abs(at(b)); });
    return comma_list(order, [&](std::size_t k) -> std::string {
        if (!(std::abs(at(k)) >= noticeable)) return "";
        if (at(k).imag() == 0) return fmt::format("{} {:.3g}", states[k], at(k).real());
        return fmt::format("{} {:.3g} at {:.0f} deg", states[k], std::abs(at(k)),
                           std::arg(at(k)) * 180 / 3.14159265358979323846);
    });
}

/// How often, and how far apart its eigenvalues are, where a reader would see it.
std::string times_text(const Mode& mode, double size)
{
    const bool shows = mode.spread > noticeable_spread * (mode.eigenvalue == 0.0 ? size : mode.frequency());
    return std::to_string(mode.multiplicity) + (shows ? fmt::format(" within {:.1g}", mode.spread) : "");
}

/// A pair once, by the one above the real axis.
std::string modes_text(const LinearReport& report)
{
    std::vector<std::vector<std::string>> rows{{"eigenvalue", "times", "frequency", "damping"}};
    if (!report.inputs.empty()) rows[0].emplace_back("reached");
    std::vector<std::string> shapes{"mode"};
    for (const Mode& mode : report.modes) {
        const Eigenvalue lambda = mode.eigenvalue;
        if (lambda.imag() < 0) continue;
        for (const auto& shape : mode.eigenvectors) {
            const bool first = &shape == &mode.eigenvectors.front(), resting = lambda == 0.0;
            rows.push_back({first ? eigenvalue_text(lambda) : "", first ? times_text(mode, report.system.size()) : "",
                            first ? short_number(mode.frequency()) : "",
                            first && !resting ? short_number(mode.damping()) : ""});
            if (!report.inputs.empty()) rows.back().emplace_back(!first ? "" : mode.reached ? "yes" : "no");
            shapes.push_back(shape_text(shape, report.states));
        }
    }
    std::string text, lines = table_text(rows);
    std::size_t begin = 0;
    for (const std::string& shape : shapes) {
        const std::size_t end = lines.find('\n', begin);
        text += fmt::format("{}  {}\n", lines.substr(begin, end - begin), shape);
        begin = end + 1;
    }
    return text;
}

/// A pair once.
std::string eigenvalues_text(const std::vector<Eigenvalue>& eigenvalues)
{
    return comma_list(eigenvalues,
                      [](const Eigenvalue& each) { return each.imag() < 0 ? std::string() : eigenvalue_text(each); });
}

std::vector<Eigenvalue> unreached(const LinearReport& report)
{
    std::vector<Eigenvalue> out;
    for (const Mode& mode : report.modes)
        if (!mode.reached) out.push_back(mode.eigenvalue);
    return out;
}

std::string certificate_text(const Equilibrium& found)
{
    if (!found.certified) return fmt::format("not certified; rates of {:.1g} at most are left", found.residual);
    if (found.radius == 0) return "certified: at exactly these numbers";
    return fmt::format("certified: within {:.1g} of these numbers", found.radius);
}

std::string equilibrium_text(const LinearReport& report)
{
    const Equilibrium& found = report.equilibrium;
    std::string text = fmt::format("{}, scene {}, {} form: an equilibrium, {}\n  {}\n", report.model, report.scene,
                                   report.form, certificate_text(found), assignments(report.states, found.at.state));
    if (!report.inputs.empty())
        text += fmt::format("  {}: {}\n", assignments(report.inputs, found.at.inputs),
                            found.moves_inputs ? "none was found with the inputs that the scene gives at its start; "
                                                 "they move with the state, by steps of least length"
                                               : "as the scene gives at its start");
    double square = 0;
    const auto add = [&](const std::vector<double>& a, const std::vector<double>& b) {
        for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
    };
    add(found.at.state, report.start.state);
    add(found.at.inputs, report.start.inputs);
    text += fmt::format("  {:.6g} from the start\n", std::sqrt(square));
    if (found.leaf_kept == LeafKept::in_floating_point)
        text += "  on the leaf of the start in floating point: not all functions that are constant on it were found\n";
    if (found.leaf_kept == LeafKept::approached)
        text += "  on a smaller leaf than the start, which motions from there only tend to\n";
    for (const std::string& name : report.following)
        text += fmt::format("  {} follows the motion, and is left out\n", name);
    return text;
}

std::string gain_text(const LinearReport& report)
{
    const linear::Regulator& regulator = *report.regulator;
    return fmt::format("\nK of u = u0 - K (s - s0), rows {}, columns {}\n{}  eigenvalues of A - B K: {}\n  residual of "
                       "Riccati's equation, relative to its terms: {:.1g}\n",
                       fmt::join(report.inputs, ", "), fmt::join(report.states, ", "), matrix_text(regulator.K),
                       eigenvalues_text(regulator.closed_loop), regulator.residual);
}

const char* to_text(LeafKept kept)
{
    switch (kept) {
    case LeafKept::by_functions: return "kept";
    case LeafKept::in_floating_point: return "kept in floating point";
    case LeafKept::approached: break;
    }
    return "approached";
}

Record matrix_record(const Matrix& M)
{
    return list_of(rows_of(M), [](const auto& row) { return list_of(row, positive_zero); });
}

Record complex_record(Eigenvalue value)
{
    return {positive_zero(value.real()), positive_zero(value.imag())};
}

Record record_of(const Mode& mode, const std::vector<std::string>& states)
{
    const auto shape_record = [&](const Eigen::VectorXcd& shape) {
        Record entries = Record::object();
        for (std::size_t k = 0; k < states.size(); ++k)
            entries[states[k]] = complex_record(shape[static_cast<Eigen::Index>(k)]);
        return entries;
    };
    return {{"eigenvalue", complex_record(mode.eigenvalue)},
            {"multiplicity", mode.multiplicity},
            {"spread", mode.spread},
            {"frequency", positive_zero(mode.frequency())},
            {"damping", mode.eigenvalue == 0.0 ? Record() : Record(positive_zero(mode.damping()))},
            {"eigenvectors", list_of(mode.eigenvectors, shape_record)}};
}

std::string linear_text(const LinearReport& report)
{
    const std::string states = fmt::format("{}", fmt::join(report.states, ", "));
    std::string text = equilibrium_text(report);
    text += fmt::format("\nA, rows and columns {}\n{}", states, matrix_text(report.system.A));
    if (!report.inputs.empty())
        text += fmt::format("\nB, rows {}, columns {}\n{}", states, fmt::join(report.inputs, ", "),
                            matrix_text(report.system.B));
    text += "\n" + modes_text(report);
    const Eigen::Index leaf = report.system.leaf.cols(), n = report.system.leaf.rows();
    if (leaf < n)
        text += fmt::format("  {} of these eigenvalues {} of directions off the leaf that motions keep, which base "
                            "constraints and Casimirs make\n",
                            n - leaf, n - leaf == 1 ? "is" : "are");
    if (!report.inputs.empty()) {
        const std::vector<Eigenvalue> missed = unreached(report);
        text += missed.empty()
                    ? "  controllable: the inputs reach every mode\n"
                    : fmt::format("  not controllable: the inputs do not reach {}\n", eigenvalues_text(missed));
    }
    return report.regulator ? text + gain_text(report) : text;
}

std::string linear_json(const LinearReport& report)
{
    const Equilibrium& found = report.equilibrium;
    const bool driven = !report.inputs.empty();
    std::vector<Eigenvalue> eigenvalues;
    for (const Mode& mode : report.modes) eigenvalues.insert(eigenvalues.end(), mode.multiplicity, mode.eigenvalue);
    const std::vector<Eigenvalue> missed = driven ? unreached(report) : std::vector<Eigenvalue>();
    Record at = Record::object();
    for (std::size_t k = 0; k < report.states.size(); ++k) at[report.states[k]] = found.at.state[k];
    for (std::size_t k = 0; k < report.inputs.size(); ++k) at[report.inputs[k]] = found.at.inputs[k];
    Record record = {{"model", report.model},
                     {"scene", report.scene},
                     {"form", report.form},
                     {"states", report.states},
                     {"inputs", report.inputs},
                     {"equilibrium", at},
                     {"inputs_moved", found.moves_inputs},
                     {"residual", found.residual},
                     {"certified", found.certified},
                     {"radius", found.radius},
                     {"leaf", to_text(found.leaf_kept)},
                     {"A", matrix_record(report.system.A)},
                     {"B", matrix_record(report.system.B)},
                     {"eigenvalues", list_of(eigenvalues, complex_record)},
                     {"modes", list_of(report.modes, [&](const Mode& mode) { return record_of(mode, report.states); })},
                     {"controllable", driven ? Record(missed.empty()) : Record()},
                     {"uncontrollable", list_of(missed, complex_record)},
                     {"gain", nullptr}};
    if (report.regulator)
        record.update({{"gain", matrix_record(report.regulator->K)},
                       {"closed_loop", list_of(report.regulator->closed_loop, complex_record)},
                       {"riccati_residual", report.regulator->residual}});
    return to_json(record) + "\n";
}

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
