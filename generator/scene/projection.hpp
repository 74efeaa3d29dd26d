// SPDX-License-Identifier: GPL-2.0-or-later
/// A morphism in numbers: where it puts the states and arrows of a run of the source, x' = phi(x), y' = Phi(x) y,
/// W' = W'(g), u' = psi(x, u, t). Momenta go the other way: mu = Phi^* mu' at the point x of the source.
#pragma once

#include "mechanics/velocity_map.hpp"
#include "scene/evaluate_scene.hpp"

namespace lagen {

/// What runs of both sides can be compared by, in a form of the equations of motion.
struct ComparedColumn {
    enum class Kind {
        projected, ///< a state of the target, and where the map puts the source
        pulled,    ///< mu_b of the source, and (Phi^* mu')_b
        lifted,    ///< x^i of the source, and what is lifted from the target
    };
    std::string name; ///< in the target, or in the source
    Kind kind = Kind::projected;
    NodeId image; ///< over the row of the source and, unless `projected`, that of the target
};

class Projection {
  public:
    /// `form`: of both runs. `values`: of the scene of the source.
    Projection(SystemMorphism morphism, const std::string& form, const SceneValues& values);

    /// The lifts of the source's base coordinates, by their names in the rows of the target, are compared too.
    void add_lifts(const std::vector<std::string>& names);

    /// Base coordinates, then fibre coordinates, or entries of W', controls and momenta; lifts.
    [[nodiscard]] const std::vector<ComparedColumn>& columns() const { return columns_; }
    /// The value of each column by the names of both rows; what no column asks for may be missing.
    [[nodiscard]] std::vector<long double> operator()(const Values& source, const Values& target) const;

    /// Values of the parameters of the target that the source knows.
    [[nodiscard]] std::vector<NamedNumber> known_parameters() const;
    /// Values of all parameters of the target.
    void set_parameters(const std::vector<NamedNumber>& target);

    /// phi(x), and Phi(x) y.
    [[nodiscard]] std::vector<NamedNumber> base(const Values& x) const;
    [[nodiscard]] std::vector<NamedNumber> fibre(const Values& state) const;
    /// mu' with Phi(x)^* mu' = mu. Throws MathematicsError where there is none, or more than one.
    [[nodiscard]] std::vector<NamedNumber> momenta(const Values& x, const std::vector<long double>& mu) const;
    /// W' by rows; empty where the target has none.
    [[nodiscard]] std::vector<long double> element(const Values& arrow) const;

  private:
    [[nodiscard]] std::vector<long double> at(const std::vector<NodeId>& nodes, Values values) const;

    SystemMorphism morphism_;
    Graph graph_;                    ///< the source's, and what is derived here
    std::vector<NodeId> velocities_; ///< y'^a over x, y
    std::vector<NodeId> matrix_;     ///< d y'^a / d y^b, shape (k', k)
    std::vector<ComparedColumn> columns_;
    std::vector<std::string> of_target_; ///< columns of the target that images use, as inputs with a prime behind
    [[nodiscard]] NodeId in_target(const std::string& name);
    Values parameters_;
};

/// mu' with Phi^a_b mu'_a = mu_b; `matrix`: Phi^a_b by rows, one row a component of mu'. Throws MathematicsError where
/// no mu' has this image, to 1e-10 of the largest |mu_b|, and where more than one has.
[[nodiscard]] std::vector<long double> pushed_covector(const std::vector<long double>& matrix,
                                                       const std::vector<long double>& mu);

} // namespace lagen
