// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/projection.hpp"

#include "graph/core/evaluate.hpp"
#include "linear/linear_system.hpp"
#include "model/scene_form.hpp"

#include <algorithm>

namespace lagen {

namespace {

std::vector<NamedNumber> named(const Graph& graph, const std::vector<NodeId>& inputs,
                               const std::vector<long double>& values)
{
    std::vector<NamedNumber> list;
    for (std::size_t k = 0; k < inputs.size(); ++k) list.emplace_back(graph.input_name(inputs[k]), values[k]);
    return list;
}

} // namespace

std::vector<long double> pushed_covector(const std::vector<long double>& matrix, const std::vector<long double>& mu)
{
    constexpr long double rank_tolerance = 1e-14L, image_tolerance = 1e-10L;
    constexpr const char* hint = "start the scene from fibre coordinates, with --form lagrange";
    using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
    const auto r = static_cast<Eigen::Index>(mu.size());
    const Eigen::Index unknowns = r == 0 ? 0 : static_cast<Eigen::Index>(matrix.size()) / r;
    const Eigen::Map<const Matrix> transposed(matrix.data(), r, unknowns); // rows of Phi are columns here
    const Eigen::Map<const Vector> given(mu.data(), r);
    Vector solution(unknowns);
    if (unknowns > 0) {
        Eigen::FullPivLU<Matrix> factors(transposed);
        factors.setThreshold(rank_tolerance);
        if (factors.rank() < unknowns)
            throw MathematicsError("the momenta of the start are those of more than one start of the target: Phi is "
                                   "not surjective on the fibre there",
                                   hint);
        solution = factors.solve(given);
    }
    const Vector missed = transposed * solution - given;
    if (!(missed.lpNorm<Eigen::Infinity>() <= image_tolerance * given.lpNorm<Eigen::Infinity>()))
        throw MathematicsError("the momenta of the start are not of the form Phi^* mu': no start of the target "
                               "has them",
                               hint);
    return {solution.begin(), solution.end()};
}

Projection::Projection(SystemMorphism morphism, const std::string& form, const SceneValues& values)
    : morphism_(std::move(morphism)), graph_(morphism_.source.graph)
{
    const System &from = morphism_.source, &to = morphism_.target;
    const EquationForm& kind = form_named(form);
    for (const NamedNumber& each : values.parameters) parameters_.insert(each);
    if (values.own_step) parameters_[graph_.input_name(from.discrete->step)] = *values.step;
    matrix_ = morphism_.fibre.empty() && morphism_.of_groupoids ? derived_fibre(graph_, morphism_).matrix
                                                                : fibre_matrix(graph_, morphism_);
    const auto put = [&](const std::vector<NodeId>& inputs, const std::vector<NodeId>& images) {
        for (std::size_t k = 0; k < inputs.size(); ++k)
            columns_.push_back({to.graph.input_name(inputs[k]), ComparedColumn::Kind::projected, images[k]});
    };
    put(to.algebroid.x, morphism_.base);
    if (kind.steps) put(to.groupoid->arrow.W, morphism_.element);
    if (kind.kind == FormKind::pontryagin) put(to.control->u, morphism_.controls);
    const VelocityMap moving = velocity_map(graph_, morphism_, matrix_);
    velocities_ = moving.velocities;
    matrix_ = moving.matrix;
    if (!kind.momenta) {
        put(to.velocities(), velocities_);
        return;
    }
    std::vector<NodeId> mu;
    for (const NodeId each : to.mu) mu.push_back(in_target(to.graph.input_name(each)));
    const std::size_t r = from.velocities().size();
    const std::vector<NodeId> pulled = pulled_covector(graph_, matrix_, r, mu);
    for (std::size_t b = 0; b < r; ++b)
        columns_.push_back({graph_.input_name(from.mu[b]), ComparedColumn::Kind::pulled, pulled[b]});
}

NodeId Projection::in_target(const std::string& name)
{
    of_target_.push_back(name);
    return graph_.input(name + "'");
}

void Projection::add_lifts(const std::vector<std::string>& names)
{
    const std::vector<NodeId>& x = morphism_.source.algebroid.x;
    for (std::size_t i = 0; i < names.size(); ++i)
        columns_.push_back({graph_.input_name(x[i]), ComparedColumn::Kind::lifted, in_target(names[i])});
}

std::vector<long double> Projection::at(const std::vector<NodeId>& nodes, Values values) const
{
    values.insert(parameters_.begin(), parameters_.end());
    return evaluate<long double>(graph_, nodes, values);
}

std::vector<long double> Projection::operator()(const Values& source, const Values& target) const
{
    Values values = source;
    for (const std::string& name : of_target_) values[name + "'"] = target.at(name);
    std::vector<NodeId> nodes;
    for (const ComparedColumn& column : columns_) nodes.push_back(column.image);
    return at(nodes, std::move(values));
}

std::vector<NamedNumber> Projection::known_parameters() const
{
    std::vector<NamedNumber> known;
    for (const NodeId parameter : morphism_.target.parameters) {
        const NodeId value = morphism_.parameters.at(parameter);
        if (std::ranges::find(morphism_.free_parameters, value) != morphism_.free_parameters.end() &&
            !parameters_.contains(graph_.input_name(value)))
            continue;
        known.emplace_back(morphism_.target.graph.input_name(parameter), at({value}, {})[0]);
    }
    return known;
}

void Projection::set_parameters(const std::vector<NamedNumber>& target)
{
    for (const auto& [name, value] : target)
        for (const NodeId parameter : morphism_.target.parameters) {
            if (morphism_.target.graph.input_name(parameter) != name) continue;
            const NodeId image = morphism_.parameters.at(parameter);
            if (std::ranges::find(morphism_.free_parameters, image) != morphism_.free_parameters.end())
                parameters_[graph_.input_name(image)] = value;
        }
}

std::vector<NamedNumber> Projection::base(const Values& x) const
{
    return named(morphism_.target.graph, morphism_.target.algebroid.x, at(morphism_.base, x));
}

std::vector<NamedNumber> Projection::fibre(const Values& state) const
{
    return named(morphism_.target.graph, morphism_.target.velocities(), at(velocities_, state));
}

std::vector<NamedNumber> Projection::momenta(const Values& x, const std::vector<long double>& mu) const
{
    return named(morphism_.target.graph, morphism_.target.mu, pushed_covector(at(matrix_, x), mu));
}

std::vector<long double> Projection::element(const Values& arrow) const
{
    return at(morphism_.element, arrow);
}

} // namespace lagen
