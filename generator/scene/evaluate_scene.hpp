// SPDX-License-Identifier: GPL-2.0-or-later
/// A scene in numbers: what a run starts from.
#pragma once

#include "model/model.hpp"
#include "scene/project_start.hpp"
#include "scene/values.hpp"
#include "text/diagnostic.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

using NamedNumber = std::pair<std::string, long double>;

struct SceneValues {
    std::vector<NamedNumber>
        parameters; ///< every parameter that is not bound, in order of declaration, with the scene's values
    std::vector<NamedNumber> base;     ///< every base coordinate, in order; on the constraints
    std::vector<NamedNumber> fibre;    ///< every fibre coordinate, in order; empty where the scene gives momenta
    std::vector<NamedNumber> momenta;  ///< every momentum, in order; empty where the scene gives fibre coordinates
    std::vector<NamedNumber> states;   ///< the first-order states that the scene carries; 0 where it does not say
    std::vector<NamedNumber> casimirs; ///< the declared Casimirs at the start
    std::vector<NamedNumber> element;  ///< of a discrete scene the group part of the first arrow, by rows; or empty
    std::vector<NamedNumber> next;     ///< and its target, by base coordinates; or empty
    std::vector<NamedNumber> inputs;   ///< defaults of all inputs, where the scene gives a table
    long double start = 0;
    std::optional<long double> duration, step;
    bool discrete = false;     ///< a discrete motion, by `step`
    bool own_step = false;     ///< which is a parameter of the discrete form beside those of the model
    std::optional<long> steps; ///< of a discrete scene
    std::optional<long double> relative, absolute; ///< `tolerance` fills both
    std::optional<long double> interval;           ///< of `sample`
    std::vector<long double> at;                   ///< of `at`
};

/// A scene cannot start from its numbers. `status` says so in a word, as runs do: non_finite, invalid_input,
/// left_domain or off_constraint.
class StartError : public ModelError {
  public:
    StartError(const char* status, std::string message, SourceRange where, std::string hint = {})
        : ModelError(std::move(message), std::move(where), std::move(hint)), status_(status)
    {
    }
    [[nodiscard]] const char* status() const noexcept { return status_; }

  private:
    const char* status_;
};

/// Evaluates every tree of the scene in long double. Throws StartError: a value that is not finite, a step, tolerance
/// or sampling interval that is not positive, a start outside the domain, and a start off a constraint h by more than
/// 1e-10 relative to its terms, |h| > 1e-10 max(sum |terms of h|, sum_i |x^i dh/dx^i|), a first arrow whose element is
/// not in the group to 1e-10, and one whose target is outside. With `project` the start is first moved by Newton steps
/// of least length, dx = -J^T (J J^T)^-1 h, in the base coordinates.
[[nodiscard]] SceneValues evaluate_scene(const Model& model, const Scene& scene);

/// The same again and again, with other numbers for some parameters and initial values. `model` outlives it.
class SceneEvaluator {
  public:
    SceneEvaluator(const Model& model, const Scene& scene);

    /// Numbers by name stand in the place of what model and scene say.
    [[nodiscard]] SceneValues operator()(const Values& parameters, const Values& initial);
    /// Every parameter, in order of declaration.
    [[nodiscard]] std::vector<NamedNumber> parameters(const Values& given);

  private:
    long double finite(const Tree& tree, const Values& values, const char* what, const std::string& name,
                       const SourceRange& where);
    Values parameter_values(const Values& given);
    Values values_in_order(const Values& given);
    void read_step(const Values& parameters, SceneValues& out);
    std::optional<long double> optional_value(const Tree& tree, const Values& values, const char* what, bool positive);
    void read_times(const Values& values, SceneValues& out);
    void require_constraints(Values& values);
    void require_domain(const Values& values);
    void read_arrow(const Values& parameters, SceneValues& out);
    void require_in_group(const Values& parameters, const std::vector<NamedNumber>& element);
    void read_states(Values& values, SceneValues& out);
    void require_bounds(const Values& parameters);

    const Model& model_;
    Scene scene_;
    std::vector<std::size_t> carried_; ///< numbers of the first-order states that the scene carries
    TreeValues value_of_;
    std::optional<ConstraintFunctions> constraints_;
    std::vector<NamedTree> parameters_; ///< in the order in which they can be computed
};

} // namespace lagen
