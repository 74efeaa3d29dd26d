// SPDX-License-Identifier: MIT
/// What becomes of a scene with each step of each method: the program of `lagen chart --stability`. The whole generated
/// main is
///   #include "model.hpp"
///   #include "lagen_chart/stability.hpp"
///   int main(int argc, char** argv) { return lagen::chart_stability<lagen::models::NAME<double>, lagen::A,
///   lagen::B>({"a", "b"}, argc, argv); }
/// Its argument is a file of lines of words,
///   span START END
///   follow energy | invariant K | size     the quantity f whose change is looked at
///   steps h h ..
///   column P.. | S..                       parameters and start of a column, one such line each
/// It prints `column OMEGA SCALE REACHED` for each column, then for each method `method NAME` and for every column and
/// every step `OUTCOME T ERROR DRIFT STATUS`.
///
/// A column is looked at along its motion by Dop853 with tolerance 1e-9 first, up to the time REACHED: OMEGA is the
/// largest imaginary part of an eigenvalue of the Jacobian along it; SCALE the largest |f(x, y) - f(x, 0)|, which is
/// the kinetic energy where f is the energy, or |f| where that is 0. Of a run with f_0 at its start
///   ERROR is the largest |f - f_0| / SCALE,
///   DRIFT how far the least and the largest f of the last third of the steps, the one that moved more, are from those
///   of the first third, over SCALE and the time between the two.
#pragma once

#include "lagen/integrate.hpp"
#include "lagen_chart/fate.hpp"
#include "lagen_chart/spectrum.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

namespace chart {

inline constexpr std::size_t most_spectra = 4000, most_reference_steps = 1'000'000;

template <class M>
struct StabilityColumn {
    M model;
    typename M::State start;
    double omega = 0, scale = 0, reached = 0;
};

struct StabilityRequest {
    Interval<double> span{0, 0};
    std::string follow;
    std::size_t invariant = 0;
    std::vector<double> steps;
};

/// The quantity that is followed.
template <class M>
double followed(const StabilityRequest& request, const M& model, double t, const typename M::State& s)
{
    if (request.follow == "energy") {
        if constexpr (HasEnergy<M>)
            return model.energy(t, s);
        else if constexpr (HasHamiltonian<M>)
            return model.hamiltonian(t, s);
    }
    if constexpr (HasInvariants<M>)
        if (request.follow == "invariant") return model.invariants(t, s)[static_cast<Eigen::Index>(request.invariant)];
    return s.template lpNorm<Eigen::Infinity>();
}

template <class M>
bool read_column(std::istringstream& words, StabilityColumn<M>& column)
{
    std::vector<double> parameters, start;
    bool behind = false;
    for (std::string word; words >> word;)
        if (word == "|")
            behind = true;
        else
            (behind ? start : parameters).push_back(std::strtod(word.c_str(), nullptr));
    if (start.size() != static_cast<std::size_t>(M::dimension)) return false;
    for (std::size_t i = 0; i < start.size(); ++i) column.start[static_cast<Eigen::Index>(i)] = start[i];
    if constexpr (HasParameters<M>) {
        if (parameters.size() != M::parameter_names.size()) return false;
        for (std::size_t k = 0; k < parameters.size(); ++k) column.model.parameter(k) = parameters[k];
    }
    return true;
}

template <class M>
bool read_stability(const char* path, StabilityRequest& request, std::vector<StabilityColumn<M>>& columns)
{
    std::ifstream file(path);
    if (!file) return false;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "span") {
            words >> request.span.start >> request.span.end;
        } else if (key == "follow") {
            words >> request.follow >> request.invariant;
        } else if (key == "steps") {
            for (std::string word; words >> word;) request.steps.push_back(std::strtod(word.c_str(), nullptr));
        } else if (key == "column") {
            columns.emplace_back();
            if (!read_column(words, columns.back())) return false;
        } else {
            return false;
        }
    }
    return true;
}

/// Largest imaginary part of an eigenvalue of the Jacobian; 0 where there is none.
template <class M>
double fastest_oscillation(const M& model, double t, const typename M::State& s)
{
    if constexpr (HasJacobian<M>) {
        std::array<double, M::jacobian_rows.size()> values{};
        model.jacobian_values(t, s, values);
        SquareMatrix jacobian(M::dimension);
        for (std::size_t k = 0; k < values.size(); ++k)
            jacobian(M::jacobian_rows[k], M::jacobian_columns[k]) = values[k];
        double largest = 0;
        for (const std::complex<double>& value : eigenvalues(jacobian)) largest = std::max(largest, value.imag());
        return largest;
    }
    return 0;
}

/// What a column's scale and frequency are, along its motion.
template <class M>
struct ColumnObserver {
    const StabilityRequest& request;
    StabilityColumn<M>& column;
    double largest = 0; ///< |f|
    std::size_t seen = 0;

    void row(double, const typename M::State&) {}
    void operator()(double t, const typename M::State& s)
    {
        typename M::State at_rest = s;
        at_rest.tail(M::dimension - M::base_dimension).setZero();
        const double f = followed(request, column.model, t, s);
        const double difference = std::abs(f - followed(request, column.model, t, at_rest));
        if (difference > column.scale && std::isfinite(difference)) column.scale = difference;
        largest = std::max(largest, std::abs(f));
        if (++seen <= most_spectra) column.omega = std::max(column.omega, fastest_oscillation(column.model, t, s));
    }
};

template <class M>
void look_at(const StabilityRequest& request, StabilityColumn<M>& column)
{
    ColumnObserver<M> observer{request, column};
    const auto run = integrate(column.model, column.start, request.span, Dop853{.tolerance = 1e-9},
                               {.max_steps = most_reference_steps}, observer);
    column.reached = run.t;
    if (request.follow == "size" || !(column.scale > 0)) column.scale = observer.largest;
    if (!(column.scale > 0)) column.scale = 1;
}

template <class M, class Method>
Fate fate_of(const StabilityRequest& request, const StabilityColumn<M>& column, double step)
{
    Integrator integrator(column.model, column.start, request.span.start, Method{.step = step});
    const double length = request.span.end - request.span.start;
    const bool conserved = request.follow != "size";
    const double from = conserved ? followed(request, column.model, request.span.start, column.start) : 0;
    FateWatch watch(from, column.scale, length, conserved);
    while (integrator.t() != request.span.end) {
        const Status status = integrator.step_towards(request.span.end);
        if (status != Status::ok) {
            watch.stop(status);
            break;
        }
        const double f = followed(request, integrator.model(), integrator.t(), integrator.state());
        if (!watch.see(f, std::abs(integrator.t() - request.span.start))) break;
    }
    return watch.fate(integrator.t());
}

template <class M, class Method>
void print_fates(const StabilityRequest& request, const std::vector<StabilityColumn<M>>& columns, std::string_view name)
{
    std::printf("method %s\n", std::string(name).c_str());
    for (const StabilityColumn<M>& column : columns)
        for (const double step : request.steps) print_fate(fate_of<M, Method>(request, column, step));
}

} // namespace chart

template <class M, class... Methods>
int chart_stability(const std::array<std::string_view, sizeof...(Methods)>& names, int argc, char** argv)
{
    chart::StabilityRequest request;
    std::vector<chart::StabilityColumn<M>> columns;
    if (argc != 2 || !chart::read_stability(argv[1], request, columns)) return 4;
    for (chart::StabilityColumn<M>& column : columns) {
        chart::look_at(request, column);
        std::printf("column %.17g %.17g %.17g\n", column.omega, column.scale, column.reached);
    }
    [[maybe_unused]] std::size_t k = 0;
    (chart::print_fates<M, Methods>(request, columns, names[k++]), ...);
    return std::fflush(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
