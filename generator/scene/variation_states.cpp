// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/variation_states.hpp"

#include "graph/calculus/differentiate.hpp"
#include "graph/core/lower.hpp"
#include "machine/philox.hpp"
#include "mechanics/variations.hpp"
#include "model/scene_form.hpp"
#include "text/usage_error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lagen {

namespace {

constexpr std::size_t harmonics = 3;

std::string part_name(std::size_t k, const char* part)
{
    return fmt::format("action.{}.{}", k, part);
}

class VariationStates {
  public:
    VariationStates(Model& model, const System& system, Scene& scene)
        : model_(model), system_(system), scene_(scene), graph_(system.graph)
    {
    }

    void add_action(const VariationRequest& request, const SampleTimes& times)
    {
        add("action", name("lagrangian"));
        for (std::size_t k = 1; k <= request.count; ++k) {
            std::vector<NodeId> s, sdot;
            for (std::size_t a = 0; a < system_.r(); ++a) {
                s.push_back(wave(request.seed, k, a, times));
                const std::pair<NodeId, NodeId> seed{system_.time, graph_.constant(1)};
                sdot.push_back(directional(graph_, {&s.back(), 1}, {&seed, 1})[0]);
            }
            const Variation delta = variation(graph_, system_.algebroid, s, sdot);
            const ActionVariations action = action_variations(graph_, system_, delta, s);
            add(part_name(k, "base"), to_tree(graph_, action.base));
            add(part_name(k, "fibre"), to_tree(graph_, action.fibre));
            add(part_name(k, "second"), to_tree(graph_, action.second));
            add(part_name(k, "squares"), to_tree(graph_, scaled_squares(s, sdot, times)));
        }
    }

    void add_field(const std::vector<NamedTree>& start)
    {
        model_.jacobi_field = model_.states.size();
        std::vector<NodeId> sigma, delta;
        std::vector<std::string> names;
        for (const char* letter : {"sigma", "delta"})
            for (const Symbol& symbol : model_.fibre.coordinates) {
                names.push_back(fmt::format("{}.{}", letter, symbol.name));
                (letter[0] == 's' ? sigma : delta).push_back(graph_.input(names.back()));
            }
        // delta y = sigmadot + [y, sigma]
        const std::vector<NodeId> turned = constant_bracket(graph_, system_.algebroid, system_.algebroid.y, sigma);
        for (std::size_t a = 0; a < system_.r(); ++a)
            add(names[a], to_tree(graph_, graph_.subtract(delta[a], turned[a])));
        for (std::size_t a = 0; a < system_.r(); ++a)
            add(names[system_.r() + a], name(jacobi_rate_name(names[system_.r() + a])));
        for (const NamedTree& each : start) {
            if (std::ranges::find(model_.fibre.coordinates, each.name, &Symbol::name) == model_.fibre.coordinates.end())
                refuse(
                    fmt::format("'{}' of --jacobi-field is no fibre coordinate of model '{}'", each.name, model_.name),
                    each.where);
            scene_.initial.push_back({"delta." + each.name, each.value, each.where});
        }
    }

  private:
    void add(const std::string& state_name, Tree rate)
    {
        FirstOrderState state;
        state.symbol.name = state_name;
        state.rate = std::move(rate);
        model_.states.push_back(std::move(state));
        if (scene_.observe) scene_.observe->push_back({state_name, name(state_name), {}});
    }

    /// (end - start) sum of the squares of the terms f of delta L: its integral is at least (integral of |f|)^2 of
    /// each, by Schwarz's inequality, and smooth, where |f| has corners that a step control would stumble over.
    [[nodiscard]] NodeId scaled_squares(const std::vector<NodeId>& s, const std::vector<NodeId>& sdot,
                                        const SampleTimes& times)
    {
        std::vector<NodeId> squares;
        for (const NodeId term : terms_of_first_variation(graph_, system_, s, sdot))
            squares.push_back(graph_.power(term, 2));
        const Rational duration(static_cast<double>(times.end - times.start));
        return graph_.multiply(graph_.constant(duration), graph_.sum(squares));
    }

    /// sum_j c_j sin(j pi (t - start)/(end - start)); zero at both ends.
    [[nodiscard]] NodeId wave(std::uint64_t seed, std::size_t k, std::size_t a, const SampleTimes& times)
    {
        const auto exact = [&](long double value) { return graph_.constant(Rational(static_cast<double>(value))); };
        const NodeId part =
            graph_.divide(graph_.subtract(system_.time, exact(times.start)), exact(times.end - times.start));
        NodeId sum = graph_.constant(0);
        for (std::size_t j = 1; j <= harmonics; ++j) {
            const double c = 2 * uniform_number(seed, k, static_cast<std::uint32_t>(a * harmonics + j)) - 1;
            const NodeId angle =
                graph_.multiply(graph_.multiply(graph_.constant(static_cast<long>(j)), graph_.pi()), part);
            sum = graph_.add(sum, graph_.multiply(graph_.constant(Rational(c)), graph_.apply(Op::sin, angle)));
        }
        return sum;
    }

    Model& model_;
    const System& system_;
    Scene& scene_;
    Graph graph_;
};

} // namespace

void add_variation_states(Model& model, const System& system, Scene& scene, const VariationRequest& request,
                          const SampleTimes& times)
{
    const auto refuse = [&](const char* what, const char* hint) {
        throw MathematicsError(fmt::format("variations are those of the action of a Lagrangian, and {}", what), hint);
    };
    if (!system.lagrangian) refuse("this model has none", "[lagrangian] L");
    if (system.distribution) refuse("the motions of a nonholonomic model are no critical points of it", "");
    if (!system.forces.empty())
        refuse("with forces motions are no critical points of it", "leave out [forces] and [dissipation]");
    if (!is_form(scene.form, FormKind::lagrange))
        refuse(fmt::format("the scene is run in the form '{}'", scene.form).c_str(), "--form lagrange");
    VariationStates states(model, system, scene);
    if (request.count > 0) states.add_action(request, times);
    if (!request.field.empty()) states.add_field(request.field);
}

std::optional<ActionReport> action_report(const RunOutcome& outcome, const VariationRequest& request)
{
    if (request.count == 0 || outcome.status != "ok") return std::nullopt;
    const auto value = [&](const std::string& lane) {
        return outcome.state.at(
            static_cast<std::size_t>(std::ranges::find(outcome.lanes, lane) - outcome.lanes.begin()));
    };
    ActionReport report{value("action"), {}, {}, {}, {}};
    for (std::size_t k = 1; k <= request.count; ++k) {
        report.base.push_back(value(part_name(k, "base")));
        report.fibre.push_back(value(part_name(k, "fibre")));
        report.second.push_back(value(part_name(k, "second")));
        report.squares.push_back(value(part_name(k, "squares")));
    }
    return report;
}

} // namespace lagen
