// SPDX-License-Identifier: MIT
/// What becomes of a discrete motion with each step: its program of `lagen chart --stability`. The whole generated main
/// is
///   #include "model.hpp"
///   #include "lagen_chart/discrete_stability.hpp"
///   int main(int argc, char** argv) { return lagen::chart_discrete_stability<lagen::models::NAME<double>>("name",
///   argc, argv); }
/// Its argument is the file of a StabilityRequest with a start for every step of every column; it answers a
/// StabilityAnswer. Runs have as many whole steps as there is room for, one at least. A fold lies between the first two
/// steps of a column that differ in whether the momenta of the start have an arrow (no_solution); there is none where
/// the start itself changes with the step.
///
/// Where no figures are given a column is looked at along its own motion, with a tenth of its shortest step and at most
/// 10^6 steps: the scale is the largest |f - f(1)| with the arrow 1 at the same point, which tends to the kinetic
/// energy where f is the energy; omega the largest |arg lambda|/h of an eigenvalue lambda of the derivative of a step
/// in (x, mu), by differences, of 400 steps at most.
#pragma once

#include "lagen_chart/stability.hpp"

namespace lagen::chart {

inline constexpr std::size_t most_turns = 400;
inline constexpr double short_step = 0.1; ///< of the shortest one
inline constexpr int fold_halvings = 40;

template <class M>
struct DiscreteRequest {
    StabilityRequest common;
    std::vector<StabilityColumn<M>> cells; ///< models with their steps

    [[nodiscard]] std::size_t steps() const { return common.steps.size(); }
};

/// f; of `size` the largest entry of (x, mu).
template <class M>
double followed_step(const StabilityRequest& request, const M& model, double t, const typename M::State& s)
{
    using Lanes = detail::ArrowLanes<M>;
    if (request.follow != Follow::size) return followed(request, model, t, s);
    double most = 0;
    for (int i = 0; i < Lanes::n; ++i) most = std::max(most, std::abs(s[i]));
    for (int a = Lanes::momenta; a < M::dimension; ++a) most = std::max(most, std::abs(s[a]));
    return most;
}

/// Adds the derivative of a step in (x, mu), by differences; nothing where a step beside it has no arrow.
template <class M>
void add_step(const M& model, double t, const typename M::State& s, LinearParts& linear)
{
    using Lanes = detail::ArrowLanes<M>;
    constexpr int n = Lanes::n, size = n + Lanes::rank;
    std::vector<double> columns;
    ArrowSolver<M> solver;
    for (int j = 0; j < size; ++j) {
        const int lane = j < n ? j : Lanes::momenta + j - n;
        const double away = 1e-5 * std::max(1.0, std::abs(s[lane]));
        Eigen::Matrix<double, n, 1> x[2];
        Eigen::Matrix<double, Lanes::rank, 1> mu[2];
        for (const int side : {0, 1}) {
            typename M::State z = s;
            z[lane] += side == 0 ? away : -away;
            if (solver.solve(model, t, z) != Status::ok) return;
            model.forward(t, z, x[side], mu[side]);
        }
        for (int i = 0; i < n; ++i) columns.push_back((x[0][i] - x[1][i]) / (2 * away));
        for (int a = 0; a < Lanes::rank; ++a) columns.push_back((mu[0][a] - mu[1][a]) / (2 * away));
    }
    linear.entries.insert(linear.entries.end(), columns.begin(), columns.end());
}

/// Of the column that begins with cell `first`.
template <class M>
void look_along(const DiscreteRequest<M>& request, std::size_t first, StabilityAnswer& found)
{
    std::size_t shortest = first;
    for (std::size_t i = first; i < first + request.steps(); ++i)
        if (request.cells[i].model.step() < request.cells[shortest].model.step()) shortest = i;
    StabilityColumn<M> column = request.cells[shortest];
    const double length = request.common.end - request.common.start;
    const double step = std::max(short_step * column.model.step(), length / double(most_reference_steps));
    column.model.parameter(request.common.step) = step;
    column.linear.lanes = static_cast<std::size_t>(detail::ArrowLanes<M>::n + detail::ArrowLanes<M>::rank);
    column.linear.most =
        std::min(most_turns, most_matrices(request.cells.size() / request.steps(), column.linear.lanes));
    column.linear.step = step;
    Integrator run(column.model, column.start, request.common.start, Discrete{});
    double largest = 0, scale = 0;
    for (int k = 0; run.status() == Status::ok && run.t() + step <= request.common.end; ++k) {
        const double f = followed_step(request.common, column.model, run.t(), run.state());
        typename M::State unit = run.state();
        using Lanes = detail::ArrowLanes<M>;
        for (int lane = Lanes::next; lane < Lanes::momenta; ++lane) unit[lane] = 0;
        unit = at_arrow(column.model, run.t(), unit);
        const double difference = std::abs(f - followed_step(request.common, column.model, run.t(), unit));
        if (std::isfinite(difference)) scale = std::max(scale, difference);
        largest = std::max(largest, std::abs(f));
        if (column.linear.wants_next()) add_step(column.model, run.t(), run.state(), column.linear);
        if (run.step() != Status::ok) break;
    }
    if (request.common.follow == Follow::size || !(scale > 0)) scale = largest > 0 ? largest : 1;
    found.columns.push_back({0, scale, run.t()});
    found.linear.push_back(std::move(column.linear));
}

template <class M>
StabilityCell discrete_fate(const DiscreteRequest<M>& request, const StabilityColumn<M>& cell, double scale)
{
    const StabilityRequest& common = request.common;
    Integrator run(cell.model, cell.start, common.start, Discrete{});
    const bool conserved = common.follow != Follow::size;
    const double length = common.end - common.start;
    const double from = conserved ? followed_step(common, cell.model, common.start, run.state()) : 0;
    FateWatch watch(from, scale, length, conserved);
    const double count = std::max(1.0, std::floor(length / cell.model.step() * (1 + 1e-9)));
    if (run.status() != Status::ok) watch.stop(run.status());
    for (double k = 0; run.status() == Status::ok && k < count; ++k) {
        if (const Status status = run.step(); status != Status::ok) {
            watch.stop(status);
            break;
        }
        if (!watch.see(followed_step(common, cell.model, run.t(), run.state()), run.t() - common.start)) break;
    }
    return watch.fate(run.t());
}

/// Whether the momenta of the start have no arrow.
template <class M>
bool is_behind_fold(const StabilityColumn<M>& cell, double t)
{
    return Integrator(cell.model, cell.start, t, Discrete{}).status() == Status::no_solution;
}

template <class M>
double first_fold(const DiscreteRequest<M>& request, std::size_t first)
{
    const double t = request.common.start;
    for (std::size_t i = first; i + 1 < first + request.steps(); ++i) {
        StabilityColumn<M> cell = request.cells[i];
        const StabilityColumn<M>& next = request.cells[i + 1];
        if (is_behind_fold(cell, t) || !is_behind_fold(next, t)) continue;
        if (cell.start != next.start) return 0;
        double good = cell.model.step(), bad = next.model.step();
        for (int k = 0; k < fold_halvings; ++k) {
            const double middle = (good + bad) / 2;
            cell.model.parameter(request.common.step) = middle;
            (is_behind_fold(cell, t) ? bad : good) = middle;
        }
        return good;
    }
    return 0;
}

} // namespace lagen::chart

namespace lagen {

template <DiscreteMotion M>
int chart_discrete_stability(const char* name, int argc, char** argv)
{
    chart::DiscreteRequest<M> request;
    chart::StabilityAnswer found;
    if (argc != 2 || !detail::read_packed(argv[1], request.common) ||
        !chart::fill_columns(request.common, request.cells) || request.steps() == 0)
        return 4;
    const std::size_t steps = request.steps(), columns = request.cells.size() / steps;
    found.columns = request.common.figures;
    for (std::size_t j = found.columns.size(); j < columns; ++j) chart::look_along(request, j * steps, found);
    chart::MethodFates fates{name, {}, {}};
    for (std::size_t k = 0; k < columns * steps; ++k)
        fates.cells.push_back(chart::discrete_fate(request, request.cells[k], found.columns[k / steps].scale));
    for (std::size_t j = 0; j < columns; ++j) fates.folds.push_back(chart::first_fold(request, j * steps));
    found.methods.push_back(std::move(fates));
    chart::answer(found);
    return std::ferror(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
