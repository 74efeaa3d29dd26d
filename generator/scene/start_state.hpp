// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a run starts, in the lanes of the generated state.
#pragma once

#include "graph/unknowns/implicit.hpp"
#include "pipeline.hpp"
#include "scene/evaluate_scene.hpp"

#include <functional>
#include <optional>

namespace lagen {

/// Base lanes, the other lanes of `form`, the first-order states that the scene carries. Lagrange's form with momenta
/// given: y solves p_a(x, y) = mu_a. Hamilton's with fibre coordinates given: mu = dL/dy, or mu solves dH/dmu_a = y^a.
/// By Newton's method from 0, in long double; throws MathematicsError where it does not converge. The discrete form:
/// base, arrow, momenta; of a first arrow the momenta are 0, and of momenta the arrow is 1: the program finds what is
/// missing. `checked` is called
/// where the values given are not the lanes themselves, once; with `true` where it is needed what is decided of the
/// regularity.
class StartState {
  public:
    using Checked = std::function<const CheckedModel&(bool decided)>;
    StartState(Checked checked, std::string form) : checked_(std::move(checked)), form_(std::move(form)) {}
    /// Of a model for which all is decided; it outlives this.
    StartState(const CheckedModel& checked, std::string form)
        : StartState([&checked](bool) -> const CheckedModel& { return checked; }, std::move(form))
    {
    }

    /// Makes ready for scenes that give momenta, or fibre coordinates, if there are `any`; false where nothing is
    /// converted.
    bool prepare(bool has_momenta, bool any);
    /// Whether the conversion, once it is prepared, is one only because of what is decided.
    [[nodiscard]] bool rests_on_decision() const { return conversion_ && conversion_->block; }
    /// The values of one scene after the other; all give fibre coordinates, or all momenta.
    [[nodiscard]] std::vector<long double> operator()(const SceneValues& values);

  private:
    /// From the lanes that are given to those of the form.
    struct Conversion {
        Graph graph;
        std::vector<NodeId> lanes;          ///< functions of what is given, or unknowns
        std::optional<ImplicitBlock> block; ///< of the unknowns
        std::vector<std::string> targets;   ///< names of the inputs that hold what is given
        const char* given;                  ///< for the message
        const char* wanted;
    };
    [[nodiscard]] static Conversion to_velocities(const CheckedModel& checked);
    [[nodiscard]] static Conversion to_momenta(const Checked& checked);
    [[nodiscard]] static Conversion inversion(Graph graph, const Regularity& regularity, std::vector<NodeId> unknowns,
                                              const std::vector<NodeId>& values, NodeId function, const char* given,
                                              const char* wanted);
    [[nodiscard]] std::vector<long double> of_motion(const SceneValues& values);
    [[nodiscard]] std::vector<long double> arrow_lanes(const SceneValues& values) const;
    [[nodiscard]] std::vector<long double> converted(const std::vector<NamedNumber>& given, Values inputs) const;

    Checked checked_;
    std::string form_;
    std::optional<Conversion> conversion_;
};

/// Whether the momenta of the start are those of its arrow.
[[nodiscard]] bool starts_from_arrow(const SceneValues& values);

/// The lanes where a run of `scene` starts. Throws as `start` does, and as finite_numbers of what the scene gives.
[[nodiscard]] std::vector<long double> finite_start(StartState& start, const SceneValues& values, const Scene& scene);

/// The numbers in the order of `named`. Throws ModelError where a double, as the compiled scene has it, cannot hold
/// one.
[[nodiscard]] std::vector<long double> finite_numbers(const std::vector<NamedNumber>& named, const Scene& scene);

} // namespace lagen
