// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/linearize/report.hpp"

#include "emit/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

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

std::string short_number(double value)
{
    return fmt::format("{:.6g}", positive_zero(value));
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
    std::string text;
    for (const std::size_t k : order) {
        if (!(std::abs(at(k)) >= noticeable)) continue;
        const bool real = at(k).imag() == 0;
        text += fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ", states[k], real ? at(k).real() : std::abs(at(k)));
        if (!real) text += fmt::format(" at {:.0f} deg", std::arg(at(k)) * 180 / 3.14159265358979323846);
    }
    return text;
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
    std::string text;
    for (const Eigenvalue& each : eigenvalues)
        if (!(each.imag() < 0)) text += (text.empty() ? "" : ", ") + eigenvalue_text(each);
    return text;
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

void names_json(JsonWriter& json, const char* key, const std::vector<std::string>& names)
{
    json.key(key).begin_array();
    for (const std::string& name : names) json.value(name);
    json.end_array();
}

void number_json(JsonWriter& json, double value)
{
    json.value(positive_zero(value));
}

void matrix_json(JsonWriter& json, const char* key, const Matrix& M)
{
    json.key(key).begin_array();
    for (const std::vector<double>& row : rows_of(M)) {
        json.begin_array();
        for (const double entry : row) number_json(json, entry);
        json.end_array();
    }
    json.end_array();
}

void complex_json(JsonWriter& json, Eigenvalue value)
{
    json.begin_array();
    number_json(json, value.real());
    number_json(json, value.imag());
    json.end_array();
}

void eigenvalues_json(JsonWriter& json, const char* key, const std::vector<Eigenvalue>& eigenvalues)
{
    json.key(key).begin_array();
    for (const Eigenvalue& each : eigenvalues) complex_json(json, each);
    json.end_array();
}

void modes_json(JsonWriter& json, const LinearReport& report)
{
    json.key("modes").begin_array();
    for (const Mode& mode : report.modes) {
        json.begin_object().key("eigenvalue");
        complex_json(json, mode.eigenvalue);
        json.key("multiplicity").value(mode.multiplicity).key("spread").value(mode.spread).key("frequency");
        number_json(json, mode.frequency());
        json.key("damping");
        if (mode.eigenvalue == 0.0)
            json.null();
        else
            number_json(json, mode.damping());
        json.key("eigenvectors").begin_array();
        for (const Eigen::VectorXcd& shape : mode.eigenvectors) {
            json.begin_object();
            for (std::size_t k = 0; k < report.states.size(); ++k) {
                json.key(report.states[k]);
                complex_json(json, shape[static_cast<Eigen::Index>(k)]);
            }
            json.end_object();
        }
        json.end_array().end_object();
    }
    json.end_array();
}

} // namespace

std::string eigenvalue_text(Eigenvalue lambda)
{
    if (lambda.imag() == 0) return short_number(lambda.real());
    return fmt::format("{}{:.6g}i", lambda.real() == 0 ? "+-" : short_number(lambda.real()) + " +- ",
                       std::abs(lambda.imag()));
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
    JsonWriter json;
    json.begin_object().key("model").value(report.model).key("scene").value(report.scene);
    json.key("form").value(report.form);
    names_json(json, "states", report.states);
    names_json(json, "inputs", report.inputs);
    json.key("equilibrium").begin_object();
    for (std::size_t k = 0; k < report.states.size(); ++k) json.key(report.states[k]).value(found.at.state[k]);
    for (std::size_t k = 0; k < report.inputs.size(); ++k) json.key(report.inputs[k]).value(found.at.inputs[k]);
    json.end_object().key("inputs_moved").value(found.moves_inputs);
    json.key("residual").value(found.residual).key("certified").value(found.certified);
    json.key("radius").value(found.radius).key("leaf").value(to_text(found.leaf_kept));
    matrix_json(json, "A", report.system.A);
    matrix_json(json, "B", report.system.B);
    std::vector<Eigenvalue> eigenvalues;
    for (const Mode& mode : report.modes) eigenvalues.insert(eigenvalues.end(), mode.multiplicity, mode.eigenvalue);
    eigenvalues_json(json, "eigenvalues", eigenvalues);
    modes_json(json, report);
    const std::vector<Eigenvalue> missed = unreached(report);
    json.key("controllable");
    if (report.inputs.empty())
        json.null();
    else
        json.value(missed.empty());
    eigenvalues_json(json, "uncontrollable", report.inputs.empty() ? std::vector<Eigenvalue>() : missed);
    if (!report.regulator) return json.key("gain").null().end_object().text() + "\n";
    matrix_json(json, "gain", report.regulator->K);
    eigenvalues_json(json, "closed_loop", report.regulator->closed_loop);
    return json.key("riccati_residual").value(report.regulator->residual).end_object().text() + "\n";
}

} // namespace lagen
