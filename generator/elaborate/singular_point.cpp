// SPDX-License-Identifier: GPL-2.0-or-later
/// Levenberg and Marquardt's method from a fixed list of starts; what it comes near to is rounded to small fractions,
/// and only what vanishes there exactly counts.
#include "elaborate/singular_point.hpp"

#include "expression/linear_algebra.hpp"
#include "graph/calculus/differentiate.hpp"
#include "graph/core/evaluate.hpp"
#include "proof/enclosure.hpp"

#include <algorithm>
#include <cmath>

namespace lagen {

namespace {

constexpr int most_steps = 60;
constexpr std::size_t random_starts = 12;
constexpr long largest_denominator = 24;
constexpr double rounding = 1e-5; ///< how near a fraction must be: double zeros are found to half the digits

std::optional<Rational> near_fraction(double value)
{
    for (long denominator = 1; denominator <= largest_denominator; ++denominator) {
        const double scaled = value * static_cast<double>(denominator);
        if (!(std::abs(scaled) < 1e6) || std::abs(scaled - std::round(scaled)) > rounding) continue;
        Rational result(std::lround(scaled), denominator);
        result.canonicalize();
        return result;
    }
    return std::nullopt;
}

class ZeroSearch {
  public:
    ZeroSearch(Graph& graph, const std::vector<NodeId>& functions, const std::vector<NodeId>& x,
               const std::vector<NodeId>& domain, const std::map<NodeId, Rational>& fixed)
        : graph_(graph), functions_(functions), x_(x), domain_(domain), fixed_(fixed), nodes_(functions)
    {
        for (const NodeId function : functions)
            for (const NodeId slope : gradient(graph, function, x)) nodes_.push_back(slope);
    }

    [[nodiscard]] std::optional<NamedPoint> from(std::vector<double> point) const
    {
        for (int k = 0; k < most_steps && step(point); ++k) {
        }
        proof::ExactInputs inputs = fixed_;
        NamedPoint named;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            const std::optional<Rational> value = near_fraction(point[i]);
            if (!value) return std::nullopt;
            inputs[x_[i]] = *value;
            named.emplace_back(graph_.input_name(x_[i]), *value);
        }
        const auto all_are = [&](const std::vector<NodeId>& nodes, int wanted) {
            const auto values = proof::Evaluation(graph_, nodes).exactly(inputs);
            return values && std::ranges::all_of(*values, [&](const Rational& value) { return value == wanted; });
        };
        return all_are(functions_, 0) && all_are(domain_, 1) ? std::optional(named) : std::nullopt;
    }

  private:
    /// x -= (J^T J + |F| 1)^-1 J^T F; false where it is a zero, or not defined.
    bool step(std::vector<double>& point) const
    {
        std::map<std::string, double> inputs;
        for (const auto& [input, value] : fixed_) inputs[graph_.input_name(input)] = value.get_d();
        for (std::size_t i = 0; i < x_.size(); ++i) inputs[graph_.input_name(x_[i])] = point[i];
        const std::vector<double> values = evaluate<double>(graph_, nodes_, inputs);
        const std::size_t n = x_.size(), count = functions_.size();
        std::vector<double> normal(n * n, 0), right(n, 0);
        double size = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const double* slopes = &values[count + k * n];
            size += std::abs(values[k]);
            for (std::size_t i = 0; i < n; ++i) {
                right[i] += slopes[i] * values[k];
                for (std::size_t j = 0; j < n; ++j) normal[i * n + j] += slopes[i] * slopes[j];
            }
        }
        if (!std::isfinite(size) || size == 0) return false;
        for (std::size_t i = 0; i < n; ++i) normal[i * n + i] += std::min(size, 1.0);
        const std::vector<double> move = substitute(factorise(std::move(normal), n), right);
        for (std::size_t i = 0; i < n; ++i) point[i] -= move[i];
        return std::ranges::all_of(point, [](double value) { return std::isfinite(value); });
    }

    Graph& graph_;
    const std::vector<NodeId>&functions_, &x_, &domain_;
    const std::map<NodeId, Rational>& fixed_;
    std::vector<NodeId> nodes_; ///< the functions, then their gradients by rows
};

} // namespace

std::optional<NamedPoint> common_zero(Graph& graph, const std::vector<NodeId>& functions, const std::vector<NodeId>& x,
                                      const std::vector<NodeId>& domain, const std::map<NodeId, Rational>& fixed)
{
    const ZeroSearch search(graph, functions, x, domain, fixed);
    std::vector<std::vector<double>> starts{std::vector<double>(x.size(), 0)};
    for (std::size_t i = 0; i < x.size(); ++i)
        for (const double value : {1.25, -1.25}) {
            starts.emplace_back(x.size(), 0);
            starts.back()[i] = value;
        }
    long seed = 7919;
    for (std::size_t k = 0; k < random_starts; ++k) {
        starts.emplace_back();
        for (std::size_t i = 0; i < x.size(); ++i) {
            seed = (seed * 48271) % 2147483647; // Lehmer's generator
            starts.back().push_back(static_cast<double>(seed % 4001) / 1000 - 2);
        }
    }
    for (const std::vector<double>& start : starts)
        if (auto point = search.from(start)) return point;
    return std::nullopt;
}

} // namespace lagen
