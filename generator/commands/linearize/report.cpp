// SPDX-License-Identifier: GPL-2.0-or-later
#include "commands/linearize/report.hpp"

#include "text/comma_list.hpp"
#include "text/record.hpp"

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

} // namespace lagen
