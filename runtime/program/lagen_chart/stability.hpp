// SPDX-License-Identifier: MIT
/// What becomes of a scene with each step of each method: the program of `lagen chart --stability`. The whole generated
/// main is
///   #include "model.hpp"
///   #include "lagen_chart/stability.hpp"
///   int main(int argc, char** argv) { return lagen::chart_stability<lagen::models::NAME<double>, lagen::A,
///   lagen::B>({"a", "b"}, argc, argv); }
/// Its argument is the file of a StabilityRequest; it answers a StabilityAnswer (stability_request.hpp).
///
/// A column is looked at along its motion by Dop853 with tolerance 1e-9 first, up to the time `reached`: omega is the
/// largest imaginary part of an eigenvalue of the Jacobian along it; scale the largest |f(x, y) - f(x, 0)|, which is
/// the kinetic energy where f is the energy, or |f| where that is 0. Of a run with f_0 at its start
///   error is the largest |f - f_0| / scale,
///   drift how far the least and the largest f of the last third of the steps, the one that moved more, are from those
///   of the first third, over scale and the time between the two.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_chart/answer.hpp"
#include "lagen_chart/fate.hpp"

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

namespace chart {

inline constexpr std::size_t most_reference_steps = 1'000'000;

template <class M>
struct StabilityColumn {
    M model;
    typename M::State start;
    ColumnFigures figures{};
    LinearParts linear{};
};

/// The quantity that is followed.
template <class M>
double followed(const StabilityRequest& request, const M& model, double t, const typename M::State& s)
{
    if (request.follow == Follow::energy) {
        if constexpr (HasEnergy<M>)
            return model.energy(t, s);
        else if constexpr (HasHamiltonian<M>)
            return model.hamiltonian(t, s);
    }
    if constexpr (HasInvariants<M>)
        if (request.follow == Follow::invariant)
            return model.invariants(t, s)[static_cast<Eigen::Index>(request.invariant)];
    return s.template lpNorm<Eigen::Infinity>();
}

/// False where one of them is of another model.
template <class M>
bool fill_columns(const StabilityRequest& request, std::vector<StabilityColumn<M>>& columns)
{
    columns.resize(request.starts.size());
    for (std::size_t k = 0; k < columns.size(); ++k)
        if (!fill(request.starts[k].parameters, request.starts[k].initial, columns[k].model, columns[k].start))
            return false;
    return true;
}

/// Adds the Jacobian there, where the model has one.
template <class M>
void add_jacobian(const M& model, double t, const typename M::State& s, LinearParts& linear)
{
    if constexpr (HasJacobian<M>) {
        std::array<double, M::jacobian_rows.size()> values{};
        model.jacobian_values(t, s, values);
        double* const matrix = &*linear.entries.insert(linear.entries.end(), linear.lanes * linear.lanes, 0.0);
        for (std::size_t k = 0; k < values.size(); ++k)
            matrix[M::jacobian_rows[k] * M::dimension + M::jacobian_columns[k]] = values[k];
    }
}

/// What a column's scale and linear equations are, along its motion.
template <class M>
struct ColumnObserver {
    const StabilityRequest& request;
    StabilityColumn<M>& column;
    double largest = 0; ///< |f|

    void row(double, const typename M::State&) {}
    void operator()(double t, const typename M::State& s)
    {
        typename M::State at_rest = s;
        at_rest.tail(M::dimension - M::base_dimension).setZero();
        const double f = followed(request, column.model, t, s);
        const double difference = std::abs(f - followed(request, column.model, t, at_rest));
        if (difference > column.figures.scale && std::isfinite(difference)) column.figures.scale = difference;
        largest = std::max(largest, std::abs(f));
        if (column.linear.wants_next()) add_jacobian(column.model, t, s, column.linear);
    }
};

template <class M>
void look_at(const StabilityRequest& request, StabilityColumn<M>& column)
{
    ColumnObserver<M> observer{request, column};
    column.linear.lanes = static_cast<std::size_t>(M::dimension);
    if (request.linear) column.linear.most = most_matrices(request.starts.size(), column.linear.lanes);
    const auto run = integrate(column.model, column.start, {request.start, request.end}, Dop853{.tolerance = 1e-9},
                               {.max_steps = most_reference_steps}, observer);
    ColumnFigures& figures = column.figures;
    figures.reached = run.t;
    if (request.follow == Follow::size || !(figures.scale > 0)) figures.scale = observer.largest;
    if (!(figures.scale > 0)) figures.scale = 1;
}

template <class M, class Method>
StabilityCell fate_of(const StabilityRequest& request, const StabilityColumn<M>& column, double step)
{
    Integrator integrator(column.model, column.start, request.start, Method{.step = step});
    const double length = request.end - request.start;
    const bool conserved = request.follow != Follow::size;
    const double from = conserved ? followed(request, column.model, request.start, column.start) : 0;
    FateWatch watch(from, column.figures.scale, length, conserved);
    while (integrator.t() != request.end) {
        const Status status = integrator.step_towards(request.end);
        if (status != Status::ok) {
            watch.stop(status);
            break;
        }
        const double f = followed(request, integrator.model(), integrator.t(), integrator.state());
        if (!watch.see(f, std::abs(integrator.t() - request.start))) break;
    }
    return watch.fate(integrator.t());
}

template <class M, class Method>
MethodFates fates_of(const StabilityRequest& request, const std::vector<StabilityColumn<M>>& columns,
                     std::string_view name)
{
    MethodFates fates{std::string(name), {}, {}};
    for (const StabilityColumn<M>& column : columns)
        for (const double step : request.steps) fates.cells.push_back(fate_of<M, Method>(request, column, step));
    return fates;
}

} // namespace chart

template <class M, class... Methods>
int chart_stability(const std::array<std::string_view, sizeof...(Methods)>& names, int argc, char** argv)
{
    chart::StabilityRequest request;
    std::vector<chart::StabilityColumn<M>> columns;
    if (argc != 2 || !detail::read_packed(argv[1], request) || !chart::fill_columns(request, columns)) return 4;
    chart::StabilityAnswer found;
    for (chart::StabilityColumn<M>& column : columns) {
        chart::look_at(request, column);
        found.columns.push_back(column.figures);
        found.linear.push_back(std::move(column.linear));
    }
    [[maybe_unused]] std::size_t k = 0;
    (found.methods.push_back(chart::fates_of<M, Methods>(request, columns, names[k++])), ...);
    chart::answer(found);
    return std::ferror(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
