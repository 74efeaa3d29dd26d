// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen linearize`: an equilibrium near the start of a scene, the equations linearised there, and a gain.
#include "commands/line/command.hpp"
#include "commands/line/scene_options.hpp"
#include "machine/write_file.hpp"
#include "scene/linearize_scene.hpp"
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

using linear::Eigenvalue;
using linear::Matrix;
using linear::Mode;

constexpr double noticeable = 0.05;        ///< entries of a mode that the text shows, of the largest
constexpr double noticeable_spread = 1e-7; ///< of eigenvalues that are told as one

double positive_zero(double value)
{
    return value == 0 ? 0 : value;
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
        for (const double entry : row) rows.back().push_back(value_text(entry, ".6g"));
    }
    return in_columns(rows);
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
std::string modes_text(const LinearisedScene& report)
{
    const bool driven = !report.inputs.empty();
    std::vector<std::vector<std::string>> rows{{"eigenvalue", "times", "frequency", "damping"}};
    if (driven) rows[0].emplace_back("reached");
    rows[0].emplace_back("mode");
    for (const Mode& mode : report.modes) {
        const Eigenvalue lambda = mode.eigenvalue;
        if (lambda.imag() < 0) continue;
        std::vector<std::string> cells{complex_text(lambda.real(), lambda.imag()),
                                       times_text(mode, report.system.size()), value_text(mode.frequency(), ".6g"),
                                       lambda == 0.0 ? "" : value_text(mode.damping(), ".6g")};
        if (driven) cells.emplace_back(mode.reached ? "yes" : "no");
        for (const auto& shape : mode.eigenvectors) {
            rows.push_back(std::move(cells));
            rows.back().push_back(shape_text(shape, report.states));
            cells.assign(rows[0].size() - 1, ""); // of the next ones the shape alone
        }
    }
    return in_columns(rows, driven ? ">>>>><" : ">>>><");
}

/// A pair once.
std::string eigenvalues_text(const std::vector<Eigenvalue>& eigenvalues)
{
    return comma_list(eigenvalues, [](const Eigenvalue& each) {
        return each.imag() < 0 ? std::string() : complex_text(each.real(), each.imag());
    });
}

std::vector<Eigenvalue> unreached(const LinearisedScene& report)
{
    std::vector<Eigenvalue> out;
    for (const Mode& mode : report.modes)
        if (!mode.reached) out.push_back(mode.eigenvalue);
    return out;
}

/// By their names.
Record values_of(const std::vector<std::string>& names, const std::vector<double>& values)
{
    Record record = Record::object();
    for (std::size_t k = 0; k < names.size(); ++k) record[names[k]] = values[k];
    return record;
}

std::string certificate_text(const Equilibrium& found)
{
    if (!found.certified) return fmt::format("not certified; rates of {:.1g} at most are left", found.residual);
    if (found.radius == 0) return "certified: at exactly these numbers";
    return fmt::format("certified: within {:.1g} of these numbers", found.radius);
}

std::string equilibrium_text(const LinearisedScene& report)
{
    const Equilibrium& found = report.equilibrium;
    std::string text =
        fmt::format("{}, scene {}, {} form: an equilibrium, {}\n  {}\n", report.model, report.scene, report.form,
                    certificate_text(found), value_text(values_of(report.states, found.at.state)));
    if (!report.inputs.empty())
        text += fmt::format("  {}: {}\n", value_text(values_of(report.inputs, found.at.inputs)),
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

std::string gain_text(const LinearisedScene& report)
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

std::string linear_text(const LinearisedScene& report)
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

std::string linear_json(const LinearisedScene& report)
{
    const Equilibrium& found = report.equilibrium;
    const bool driven = !report.inputs.empty();
    std::vector<Eigenvalue> eigenvalues;
    for (const Mode& mode : report.modes) eigenvalues.insert(eigenvalues.end(), mode.multiplicity, mode.eigenvalue);
    const std::vector<Eigenvalue> missed = driven ? unreached(report) : std::vector<Eigenvalue>();
    Record at = values_of(report.states, found.at.state);
    at.update(values_of(report.inputs, found.at.inputs));
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

/// The value of --lqr, 'Q=expr;R=expr' over parameters.
QuadraticCost read_cost(const Options& options, const Model& model)
{
    const std::string text = options.get("lqr");
    const Excerpt whole = whole_text("<--lqr>", text);
    std::map<std::string, CostWeight> parts;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::size_t equals = std::min(text.find('=', begin), end);
        const std::string name = trimmed(whole, begin, equals).text;
        if (equals == end || (name != "Q" && name != "R") || parts.contains(name))
            throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
        const Excerpt value = trimmed(whole, equals + 1, end);
        parts[name] = {option_array(model, "lqr", value), value.range(0, value.text.size())};
        begin = end + 1;
    }
    if (parts.size() < 2) throw UsageError(fmt::format("--lqr needs 'Q=..;R=..', found '{}'", text));
    return {parts["Q"], parts["R"]};
}

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

} // namespace

ExitCode run_linearize(Arguments arguments)
{
    const Options options(linearize_syntax, arguments);
    if (options.help()) return ExitCode::done;
    const bool as_json = options.as_json();
    if (options.has("output")) require_writable(options.get("output"));
    CheckedModel checked = loaded(options);
    const Scene scene = scene_of(options, checked.model, options.named("initial"));
    warn(warnings_of(checked, scene.form));
    std::optional<QuadraticCost> cost;
    if (options.has("lqr")) cost = read_cost(options, checked.model);
    const LinearisedScene report = linearize_scene(checked, scene, cost);
    write_file(options.output(), as_json ? linear_json(report) : linear_text(report));
    return ExitCode::done;
}

} // namespace lagen
