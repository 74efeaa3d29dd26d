// SPDX-License-Identifier: GPL-2.0-or-later
/// A stability chart: what becomes of a scene with each step of each method, over a parameter or an initial value too.
/// What the words mean, and how it is found, stands in runtime/program/lagen_chart/stability.hpp.
#pragma once

#include "commands/chart/chart.hpp"
#include "lagen_chart/stability_request.hpp"
#include "model/model.hpp"
#include "scene/values.hpp"

#include <optional>
#include <string>
#include <vector>

namespace lagen {

using chart::ColumnFigures;
using chart::StabilityCell;

// `--over step=a:b:n[,p=a:b:n]`: what a stability chart is drawn over.

struct StabilityAxis {
    std::string name; ///< "step", a parameter, or "initial.x"
    std::vector<double> values;
    std::string heading{}; ///< the name in files
};

/// x of "initial.x"; nothing of another name.
[[nodiscard]] std::optional<std::string> initial_name(const std::string& name);

/// One axis or two, the first of steps. Throws UsageError where it is not such a list, ModelError where an end is no
/// number, or the scene has no parameter and no initial value of that name.
[[nodiscard]] std::vector<StabilityAxis> stability_axes(const std::string& over, const Model& model,
                                                        const Scene& scene);

/// A column of the chart gives these values to parameters and to the start.
struct ColumnPlace {
    Values parameters, initial;
};
/// By the values of the second axis; one column that sets nothing where there is none.
[[nodiscard]] std::vector<ColumnPlace> column_places(const std::vector<StabilityAxis>& axes);

struct ChartedMethod : chart::MethodFates {
    /// The step at which h omega is the end of the method's interval, a column each; nothing where it has none.
    std::vector<std::optional<double>> limits{};
};

struct StabilityChart {
    std::string model, title, scene, form;
    double start = 0, end = 0;
    std::string followed; ///< "energy", "hamiltonian", "invariant NAME"; empty where nothing is conserved
    std::vector<StabilityAxis> axes;
    std::vector<ColumnFigures> columns; ///< a value of the second axis each; one where there is none
    std::vector<ChartedMethod> methods;
    std::vector<LeftOutMethod> left_out;

    /// Of step i and column j.
    [[nodiscard]] const StabilityCell& cell(const ChartedMethod& method, std::size_t i, std::size_t j) const
    {
        return method.cells[j * axes[0].values.size() + i];
    }
};

/// The outcomes, the best first, and when each is given.
struct OutcomeEntry {
    const char* name;
    const char* colour;
    const char* criterion;
};
inline constexpr std::array<OutcomeEntry, 5> outcome_table{{
    {"bounded", "#56b4e9", "none of the others: what is followed may swing, but stays where it swings"},
    {"drifting", "#e69f00",
     "from each third of the time to the next the least or the largest value goes on in one direction, in all by more "
     "than 1e-3 of the scale and half of the width of its swing; or the last third is as far from the first value; or "
     "the value is away from it by more than 10 times the scale"},
    {"newton_diverged", "#009e73",
     "a step of an implicit method or a discrete motion has no solution that is found; `status` tells why: "
     "newton_diverged, no_solution or branch_lost"},
    {"blown_up", "#d55e00", "a number is not finite, or what is followed moves by more than 100 times the scale"},
    {"left_domain", "#999999",
     "a step ends where the model's equations do: outside the domain, or where they are singular"},
}};

/// Generates, compiles and runs the grid, one program for each kind of method and each discrete motion. In a form of
/// rates variational methods stand beside those that integrate them; in the discrete form the motion of [discrete] is
/// alone. Methods that take a tolerance are left out. Throws UsageError where one of the request takes no step or does
/// not apply.
[[nodiscard]] StabilityChart make_stability_chart(CheckedModel& checked, const ChartRequest& request,
                                                  std::vector<StabilityAxis> axes);

/// The object of stability.json.
[[nodiscard]] std::string stability_json(const StabilityChart& chart);
/// RFC 4180: a line a method, step and column.
[[nodiscard]] std::string stability_csv(const StabilityChart& chart);
/// For standard output: how many points of each outcome every method has, and the longest step up to which all are
/// bounded.
[[nodiscard]] std::string stability_text(const StabilityChart& chart);

/// A panel a method, or a row of one panel where there is one axis.
void draw_stability(const StabilityChart& chart, const std::string& path);

} // namespace lagen
