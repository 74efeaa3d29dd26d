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
/// every step `OUTCOME T ERROR DRIFT`.
///
/// A column is looked at along its motion by Dop853 with tolerance 1e-9 first, up to the time REACHED: OMEGA is the
/// largest imaginary part of an eigenvalue of the Jacobian along it; SCALE the largest |f(x, y) - f(x, 0)|, which is
/// the kinetic energy where f is the energy, or |f| where that is 0. Of a run with f_0 at its start
///   ERROR is the largest |f - f_0| / SCALE,
///   DRIFT how far the least and the largest f of the last third of the steps, the one that moved more, are from those
///   of the first third, over SCALE and the time between the two.
#pragma once

#include "lagen/integrate.hpp"

#include <Eigen/Eigenvalues>

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

inline constexpr double blown_up_from = 100; ///< times the scale
inline constexpr double swing_window = 10;   ///< times the scale: what swings farther drifts
inline constexpr double least_drift = 1e-3;  ///< times the scale, from the first third to the last
inline constexpr double drift_over_width =
    0.5; ///< a drift moves f by more than this part of its width in the first third
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
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(M::dimension, M::dimension);
        for (std::size_t k = 0; k < values.size(); ++k)
            jacobian(M::jacobian_rows[k], M::jacobian_columns[k]) = values[k];
        if (!jacobian.allFinite()) return 0;
        const Eigen::EigenSolver<Eigen::MatrixXd> solver(jacobian, false);
        if (solver.info() == Eigen::Success) return solver.eigenvalues().imag().maxCoeff();
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

/// Least and largest value of a part of a run.
struct Range {
    double least = std::numeric_limits<double>::infinity(), largest = -std::numeric_limits<double>::infinity();

    void see(double value)
    {
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    [[nodiscard]] double width() const { return largest - least; }
};

struct Fate {
    const char* outcome = "bounded";
    double t = 0, error = 0, drift = 0;
};

inline const char* outcome_of(Status status)
{
    switch (status) {
    case Status::ok: return "bounded";
    case Status::branch_lost:
    case Status::newton_diverged: return "newton_diverged";
    case Status::non_finite:
    case Status::step_too_small:
    case Status::invalid_input: return "blown_up";
    default: return "left_domain"; // the equations have no right-hand side there, whatever the reason
    }
}

/// Whether f, which began at `from`, drifts; `moved` is how far its least or its largest value went, over the scale.
inline bool goes_away(const std::array<Range, 3>& parts, double from, double scale, double& moved)
{
    const auto& [first, middle, last] = parts;
    const double low = last.least - first.least, high = last.largest - first.largest;
    const bool upper = std::abs(high) > std::abs(low);
    moved = std::abs(upper ? high : low) / scale;
    const double half_way = upper ? middle.largest - first.largest : middle.least - first.least;
    const double other_half = (upper ? high : low) - half_way;
    const bool steadily = half_way * other_half >= 0; // what swings slowly turns back
    const auto is_drift = [&](double distance, double width) {
        return distance > least_drift * scale && distance > drift_over_width * width;
    };
    const double away = std::max({0.0, last.least - from, from - last.largest}); // f never comes back to its start
    return (steadily && is_drift(moved * scale, std::min(first.width(), last.width()))) || is_drift(away, last.width());
}

template <class M, class Method>
Fate fate_of(const StabilityRequest& request, const StabilityColumn<M>& column, double step)
{
    Integrator integrator(column.model, column.start, request.span.start, Method{.step = step});
    const double length = request.span.end - request.span.start;
    const bool conserved = request.follow != "size";
    const double from = conserved ? followed(request, column.model, request.span.start, column.start) : 0;
    const double third = std::abs(length) / 3;
    Fate fate;
    std::array<Range, 3> parts;
    parts[0].see(from);
    while (integrator.t() != request.span.end) {
        const Status status = integrator.step_towards(request.span.end);
        if (status != Status::ok) {
            fate.outcome = outcome_of(status);
            break;
        }
        const double f = followed(request, integrator.model(), integrator.t(), integrator.state());
        const double error = std::abs(f - from) / column.scale, passed = std::abs(integrator.t() - request.span.start);
        if (error > fate.error) fate.error = error;
        if (!(error <= blown_up_from)) {
            fate.outcome = "blown_up";
            break;
        }
        parts[std::min<std::size_t>(2, static_cast<std::size_t>(passed / third))].see(f);
    }
    fate.t = integrator.t();
    if (std::string_view(fate.outcome) != "bounded" || !conserved) return fate;
    if (fate.error > swing_window || goes_away(parts, from, column.scale, fate.drift)) fate.outcome = "drifting";
    fate.drift /= 2 * third;
    return fate;
}

template <class M, class Method>
void print_fates(const StabilityRequest& request, const std::vector<StabilityColumn<M>>& columns, std::string_view name)
{
    std::printf("method %s\n", std::string(name).c_str());
    for (const StabilityColumn<M>& column : columns)
        for (const double step : request.steps) {
            const Fate fate = fate_of<M, Method>(request, column, step);
            std::printf("%s %.17g %.6g %.6g\n", fate.outcome, fate.t, fate.error, fate.drift);
        }
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
    std::size_t k = 0;
    (chart::print_fates<M, Methods>(request, columns, names[k++]), ...);
    return std::fflush(stdout) == 0 ? 0 : 5;
}

} // namespace lagen
