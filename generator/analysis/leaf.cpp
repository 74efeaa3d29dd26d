// SPDX-License-Identifier: GPL-2.0-or-later
#include "analysis/leaf.hpp"

#include "analysis/find_invariants.hpp"
#include "analysis/generic_points.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "mechanics/nonholonomic.hpp"
#include "text/activity.hpp"
#include "verify/proof_setting.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace lagen {

namespace {

using Fields = std::vector<std::vector<NodeId>>;
using Numbers = std::vector<long double>;

constexpr std::size_t leaf_points = 5;
constexpr long double dependent_fields = 1e-9L;
constexpr long double settled = 1e-15L; ///< of a position, relative to its largest entry: rounding takes over below

/// rho_a, or of a distribution rho(e_alpha) and rho(b), with numbers for parameters.
Fields generators_of(Graph& graph, const System& system)
{
    const std::vector<Column> anchor =
        system.distribution ? constraint_hull(graph, system).frame.anchor : system.algebroid.anchor;
    Fields fields;
    for (const Column& column : anchor) {
        std::vector<NodeId>& field = fields.emplace_back(system.n(), graph.constant(0));
        for (const ColumnEntry& entry : column) field[entry.index] = entry.value;
        field = substitute(graph, field, system.parameter_values);
    }
    return fields;
}

/// [X, Y]^i = X(Y^i) - Y(X^i)
std::vector<NodeId> bracket_of(Graph& graph, const std::vector<NodeId>& x, const std::vector<NodeId>& X,
                               const std::vector<NodeId>& Y)
{
    const std::vector<NodeId> forth = directional(graph, Y, replacements(x, X));
    const std::vector<NodeId> back = directional(graph, X, replacements(x, Y));
    std::vector<NodeId> out;
    for (std::size_t i = 0; i < x.size(); ++i) out.push_back(graph.subtract(forth[i], back[i]));
    return out;
}

/// Appends brackets that no combination of the fields is, until there are none.
void close_under_brackets(Graph& graph, const std::vector<NodeId>& x, Fields& fields, GenericSpan& span)
{
    for (std::size_t j = 1; j < fields.size() && span.size() < x.size(); ++j)
        for (std::size_t i = 0; i < j && span.size() < x.size(); ++i) {
            std::vector<NodeId> bracket = bracket_of(graph, x, fields[i], fields[j]);
            if (span.add(bracket)) fields.push_back(std::move(bracket));
        }
}

/// Gragg's rule with n steps of the time 1.
Numbers by_midpoints(const std::function<Numbers(const Numbers&)>& rate, const Numbers& at, int n)
{
    const long double h = 1.0L / n;
    Numbers before = at, now = at;
    const auto advance = [&](const Numbers& from, const Numbers& slope, long double step) {
        Numbers out = from;
        for (std::size_t k = 0; k < out.size(); ++k) out[k] += step * slope[k];
        return out;
    };
    now = advance(at, rate(at), h);
    for (int k = 1; k < n; ++k) {
        Numbers next = advance(before, rate(now), 2 * h);
        before = std::move(now), now = std::move(next);
    }
    const Numbers last = advance(before, rate(now), h);
    for (std::size_t k = 0; k < now.size(); ++k) now[k] = (now[k] + last[k]) / 2;
    return now;
}

/// By extrapolation in 1/n^2 until roundings make it worse [Gragg 1965]; nothing where that does not settle.
std::optional<Numbers> extrapolated(const std::function<Numbers(const Numbers&)>& rate, const Numbers& at)
{
    constexpr int most_rows = 12;
    std::vector<Numbers> row;
    long double last_change = HUGE_VALL;
    for (int k = 0; k < most_rows; ++k) {
        const auto steps = [](int index) { return 2.0L * (index + 1); };
        std::vector<Numbers> next{by_midpoints(rate, at, 2 * (k + 1))};
        for (int j = 1; j <= k; ++j) {
            const long double ratio = steps(k) / steps(k - j), factor = 1 / (ratio * ratio - 1);
            Numbers& better = next.emplace_back(next.back());
            for (std::size_t i = 0; i < at.size(); ++i)
                better[i] += factor * (better[i] - row[static_cast<std::size_t>(j) - 1][i]);
        }
        long double size = 0, change = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (!std::isfinite(next.back()[i])) return std::nullopt;
            size = std::max(size, std::abs(next.back()[i]));
            if (k > 0) change = std::max(change, std::abs(next.back()[i] - row.back()[i]));
        }
        if (k > 1 && change >= last_change && last_change <= settled * size) return row.back();
        last_change = change;
        row = std::move(next);
    }
    return std::nullopt;
}

} // namespace

Leaves leaves_of(Graph& graph, const System& system)
{
    const std::vector<NodeId>& x = system.algebroid.x;
    Leaves out;
    const auto fixed = [&](const std::vector<NodeId>& nodes) {
        return substitute(graph, nodes, system.parameter_values);
    };
    out.constraints = fixed(system.functions.constraints);
    out.casimirs = fixed(system.functions.casimirs);
    Fields fields = generators_of(graph, system);
    if (x.empty() || depends_on_any(graph, joined_rows(fields), std::vector{system.time})) return out;
    const std::vector<NamedNumbers> points = generic_points(
        graph, setting_at_values(graph, proof_setting(graph, system), system.parameter_values), leaf_points);
    if (points.empty()) return out;
    GenericSpan directions(graph, points), differentials(graph, points);
    for (const std::vector<NodeId>& field : fields) (void)directions.add(field);
    if (system.distribution) close_under_brackets(graph, x, fields, directions);
    out.fields = std::move(fields);
    out.codimension = x.size() - directions.size();
    std::vector<NodeId> known = out.constraints;
    known.insert(known.end(), out.casimirs.begin(), out.casimirs.end());
    for (const NodeId f : known) (void)differentials.add_differential(f, x);
    if (differentials.size() >= out.codimension) return out;
    const Activity activity("searching functions that are constant on leaves");
    for (const NodeId f : find_constants(graph, system, out.fields, known, out.codimension - differentials.size()))
        out.casimirs.push_back(f);
    return out;
}

LeafSteps::LeafSteps(const Graph& graph, std::vector<NodeId> x, Fields fields)
    : graph_(graph), x_(std::move(x)), count_(fields.size()), entries_(joined_rows(fields))
{
}

/// X_a^i at x, shape (any, n) by rows.
Numbers LeafSteps::fields_at(const Numbers& x) const
{
    NamedNumbers inputs;
    for (std::size_t i = 0; i < x_.size(); ++i) inputs[graph_.input_name(x_[i])] = x[i];
    return evaluate<long double>(graph_, entries_, inputs);
}

OrthonormalSpan LeafSteps::tangent(const std::vector<double>& z) const
{
    const std::size_t n = x_.size();
    const Numbers values = fields_at({z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n)});
    OrthonormalSpan span(dependent_fields);
    long double largest = 0;
    for (const long double each : values) largest = std::max(largest, std::abs(each));
    for (std::size_t a = 0; a < count_; ++a) {
        const auto first = values.begin() + static_cast<std::ptrdiff_t>(a * n);
        const Numbers field(first, first + static_cast<std::ptrdiff_t>(n));
        if (length_of(field) > dependent_fields * largest) (void)span.add(field);
    }
    return span;
}

std::vector<std::vector<double>> LeafSteps::normals(const std::vector<double>& z) const
{
    std::vector<std::vector<double>> out;
    for (OrthonormalSpan span = tangent(z); span.size() < x_.size();) {
        const OrthonormalSpan::Vector normal = span.farthest_outside(x_.size());
        span.add(normal);
        out.emplace_back(normal.begin(), normal.end());
    }
    return out;
}

std::vector<double>
LeafSteps::least_squares(const std::vector<double>& z,
                         const std::function<proof::Residual(const std::vector<double>&)>& residual) const
{
    const auto along = [&](const std::vector<double>& point) {
        proof::Residual out = residual(point);
        out.slopes = slopes(out.slopes, point);
        return out;
    };
    const auto found =
        proof::least_squares(z, along, [this](const std::vector<double>& point, const std::vector<double>& step) {
            return moved(point, step);
        });
    return found ? found->z : z;
}

/// Slopes by z, by rows, as slopes by the step.
std::vector<double> LeafSteps::slopes(const std::vector<double>& by_z, const std::vector<double>& z) const
{
    const std::size_t n = x_.size(), all = z.size(), rest = all - n;
    const Numbers X = fields_at({z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n)});
    std::vector<double> out;
    for (std::size_t row = 0; row < by_z.size(); row += all) {
        for (std::size_t a = 0; a < count_; ++a) {
            long double slope = 0;
            for (std::size_t i = 0; i < n; ++i) slope += by_z[row + i] * X[a * n + i];
            out.push_back(static_cast<double>(slope));
        }
        for (std::size_t k = 0; k < rest; ++k) out.push_back(by_z[row + n + k]);
    }
    return out;
}

std::vector<double> LeafSteps::moved(const std::vector<double>& z, const std::vector<double>& step) const
{
    const std::size_t n = x_.size();
    const auto moved_base = along({z.begin(), z.begin() + static_cast<std::ptrdiff_t>(n)}, step);
    std::vector<double> out = z;
    for (std::size_t i = 0; i < n; ++i)
        out[i] = moved_base ? static_cast<double>((*moved_base)[i]) : std::numeric_limits<double>::quiet_NaN();
    for (std::size_t k = n; k < z.size(); ++k) out[k] += step[count_ + k - n];
    return out;
}

/// In pieces in which x moves by less than about half its size.
std::optional<Numbers> LeafSteps::along(Numbers x, const std::vector<double>& c) const
{
    constexpr long double most_pieces = 64;
    const std::size_t n = x.size();
    long double pieces = 1;
    const auto rate = [&](const Numbers& point) {
        const Numbers values = fields_at(point);
        Numbers out(n, 0);
        for (std::size_t a = 0; a < count_; ++a)
            for (std::size_t i = 0; i < n; ++i) out[i] += c[a] / pieces * values[a * n + i];
        return out;
    };
    const long double length = length_of(rate(x)), size = std::max(length_of(x), 1e-3L);
    if (!std::isfinite(length) || length > most_pieces * size) return std::nullopt;
    pieces = std::floor(2 * length / size) + 1;
    for (long double k = 0; k < pieces; ++k) {
        std::optional<Numbers> next = extrapolated(rate, x);
        if (!next) return std::nullopt;
        x = *std::move(next);
    }
    return x;
}

} // namespace lagen
