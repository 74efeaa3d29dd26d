// SPDX-License-Identifier: GPL-2.0-or-later
/// E-forms: sections of the exterior powers of E*, w = sum_{a1 < .. < ap} w_{a1..ap} e^{a1} ^ .. ^ e^{ap}, functions on
/// the base among them as forms of degree 0, and Cartan's calculus.
///   d f = rho_a(f) e^a,   d e^c = -1/2 C^c_ab e^a ^ e^b,   d(v ^ w) = dv ^ w + (-1)^|v| v ^ dw
///   (i_s w)(s_2, ..) = w(s, s_2, ..),   L_s = d i_s + i_s d                                [Martinez 2001]
#pragma once

#include "geometry/section.hpp"

namespace lagen {

/// Fibre indices in ascending order, of one component.
using FormIndex = std::vector<std::size_t>;

struct ExteriorForm {
    std::size_t degree = 0;
    std::map<FormIndex, NodeId> components; ///< those that are not zero by structure
};

/// f as a form of degree 0; e^a.
[[nodiscard]] ExteriorForm function_form(NodeId f);
[[nodiscard]] ExteriorForm basis_form(Graph& graph, std::size_t a);

/// v + w and v - w of the same degree, f w.
[[nodiscard]] ExteriorForm sum(Graph& graph, const ExteriorForm& v, const ExteriorForm& w);
[[nodiscard]] ExteriorForm difference(Graph& graph, const ExteriorForm& v, const ExteriorForm& w);
[[nodiscard]] ExteriorForm product(Graph& graph, NodeId f, const ExteriorForm& w);

/// v ^ w
[[nodiscard]] ExteriorForm wedge(Graph& graph, const ExteriorForm& v, const ExteriorForm& w);

/// i_s w; of a form of degree 0 the zero form of degree 0.
[[nodiscard]] ExteriorForm contraction(Graph& graph, const Section& s, const ExteriorForm& w);

/// d of many forms: what vanishes by the structure of rho and C is not visited.
class Differential {
  public:
    /// Keeps references.
    Differential(BaseGradient& partial, const Algebroid& algebroid);
    /// d w; a component is listed where it has a term, and may be the constant 0, where its terms cancel.
    [[nodiscard]] ExteriorForm operator()(const ExteriorForm& w);

  private:
    [[nodiscard]] std::vector<std::size_t> moving(NodeId f);

    BaseGradient& partial_;
    const Algebroid& algebroid_;
    std::vector<std::vector<std::size_t>> movers_;                 ///< by i: the sections a with rho^i_a
    std::vector<std::vector<std::pair<FormIndex, NodeId>>> basis_; ///< by c: d e^c = -C^c_ab e^a ^ e^b, a < b
};

/// d w, of one form.
[[nodiscard]] ExteriorForm differential(BaseGradient& partial, const Algebroid& algebroid, const ExteriorForm& w);

/// L_s w = d i_s w + i_s d w; of a function rho(s) f.
[[nodiscard]] ExteriorForm lie_derivative(BaseGradient& partial, const Algebroid& algebroid, const Section& s,
                                          const ExteriorForm& w);

/// A bundle map Phi: E -> E' over phi: M -> M', x' = phi(x), y'^a = Phi^a_b(x) y^b, between algebroids on one graph.
struct BundleMap {
    std::vector<std::pair<NodeId, NodeId>> base; ///< pairs (x'^i, phi^i(x)), as `substitute` takes them
    std::vector<Column> fibre;                   ///< fibre[b]: Phi^a_b, the image of e_b by a
};

/// Phi^* w = w_{a1..ap}(phi(x)) (Phi^{a1}_b1 e^b1) ^ .. ^ (Phi^{ap}_bp e^bp)
[[nodiscard]] ExteriorForm pull_back(Graph& graph, const BundleMap& map, const ExteriorForm& w);

} // namespace lagen
