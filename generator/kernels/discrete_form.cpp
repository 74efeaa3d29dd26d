// SPDX-License-Identifier: GPL-2.0-or-later
/// The discrete Euler-Lagrange equations (mechanics/discrete.hpp) as kernels of a step. The lanes hold x_next - x and
/// W - 1 in the place of x_next and W: an arrow of a short step is close to 1, and nothing is lost of the difference.
/// Of F^+L the part of size 1/h follows from F^-L,
///   F^+L(g)_c = Ad_W^b_c (mu_b + rho_b(L)),     F^+L(g)_i = mu_i + A_i^c mu_c + dL/dx^i + dL/dx_next^i - A_i^c F^+L_c
/// with the last A at x_next, so that momenta gain no rounding error of that size in a step. Forces make the momenta
/// F^-L - f^- and F^+L + f^+ (mechanics/scheme.hpp). On pairs where N does not depend on the arrow, F^-L is affine in
/// it, and a step is explicit.
#include "geometry/cayley.hpp"
#include "geometry/generator_span.hpp"
#include "graph/calculus/differentiate.hpp"
#include "kernels/formulation.hpp"
#include "mechanics/discrete.hpp"
#include "mechanics/hamilton.hpp"
#include "text/comma_list.hpp"

#include <fmt/format.h>

namespace lagen {

namespace {

class DiscreteForm {
  public:
    DiscreteForm(Graph& graph, const Model& model, const System& system, const FormulationRequest& request)
        : graph_(graph), model_(model), system_(system), groupoid_(*system.groupoid), L_(*system.discrete->lagrangian),
          equations_(arrow_equations(graph, system)), span_(graph, groupoid_),
          form_(empty_form(system, FormKind::discrete, {}, request))
    {
    }

    Formulation build()
    {
        declare_lanes();
        add_step();
        add_forward();
        add_arrow_equation();
        add_explicit_step();
        add_algebra();
        add_functions();
        bind_names();
        return std::move(form_);
    }

  private:
    [[nodiscard]] Quantity lane(const std::string& name, const std::string& text, const std::string& unit)
    {
        return {name, text, unit, graph_.input(name)};
    }

    void declare_lanes()
    {
        LaneGroup base{"Base", "base", "Base coordinates of the source, the first lanes of State.", {}};
        LaneGroup arrow{"Arrow", "arrow", "The arrow: x_next - x, then W - 1 by rows.", {}};
        LaneGroup inner{"Inner", "inner", "Inner unknowns of the step, at which L is stationary.", {}};
        LaneGroup momenta{
            form_.form->lane_group, "fibre", "The momenta F^-L of the arrow, the last lanes of State.", {}};
        for (std::size_t i = 0; i < form_.x.size(); ++i) {
            const Symbol& symbol = model_.base.coordinates[i];
            base.lanes.push_back({symbol.name, symbol.text, symbol.unit, form_.x[i]});
        }
        for (std::size_t i = 0; i < groupoid_.horizontal(); ++i) {
            const std::string& here = graph_.input_name(form_.x[i]);
            const std::string& next = graph_.input_name(groupoid_.arrow.next[i]);
            arrow.lanes.push_back(lane(fmt::format("{}_less_{}", next, here), "", model_.base.coordinates[i].unit));
            lanes_.emplace_back(groupoid_.arrow.next[i], graph_.add(form_.x[i], arrow.lanes.back().input));
        }
        for (std::size_t k = 0; k < groupoid_.arrow.W.size(); ++k) {
            const NodeId W = groupoid_.arrow.W[k];
            const bool diagonal = k % (groupoid_.size + 1) == 0;
            arrow.lanes.push_back(lane(graph_.input_name(W) + (diagonal ? "_less_one" : ""), "", ""));
            if (diagonal) lanes_.emplace_back(W, graph_.add(graph_.constant(1), arrow.lanes.back().input));
        }
        for (const NodeId w : system_.discrete->inner) inner.lanes.push_back({graph_.input_name(w), {}, {}, w});
        for (std::size_t a = 0; a < system_.r(); ++a) {
            const Symbol& symbol = model_.fibre.momenta[a];
            momenta.lanes.push_back({symbol.name, symbol.text, symbol.unit, system_.mu[a]});
        }
        for (const LaneGroup* group : {&arrow, &inner, &momenta})
            for (const Quantity& each : group->lanes) form_.lanes.push_back(each.input);
        form_.groups = {std::move(base), std::move(arrow), std::move(inner), std::move(momenta)};
        form_.step = StepNumbers{groupoid_.horizontal(), groupoid_.size, groupoid_.has_cayley_map};
    }

    /// Functions of the arrow's coordinates over the lanes.
    [[nodiscard]] std::vector<NodeId> over_lanes(const std::vector<NodeId>& functions)
    {
        return substitute(graph_, functions, lanes_);
    }

    void add_step()
    {
        form_.constants.push_back(scalar_kernel(form_, "step", system_.discrete->step));
        if (graph_.op(system_.discrete->step) == Op::input)
            form_.parameter_conditions.emplace_back(model_.discrete->step.name + " > 0", system_.discrete->step);
    }

    /// F^-L_a = mu_a + f^-_a
    [[nodiscard]] NodeId free_momentum(std::size_t a)
    {
        const std::vector<NodeId>& work = system_.discrete->work.source;
        return work.empty() ? system_.mu[a] : graph_.add(system_.mu[a], work[a]);
    }

    /// F^-L_b + rho_b(L), of the vertical sections.
    [[nodiscard]] std::vector<NodeId> moved_momenta(const std::vector<NodeId>& slopes)
    {
        std::vector<NodeId> out;
        for (std::size_t b = groupoid_.horizontal(); b < system_.r(); ++b) {
            out.push_back(free_momentum(b));
            for (const ColumnEntry& entry : groupoid_.right[b])
                if (entry.index < groupoid_.n()) // the field is (-rho_b, 0, E_b W)
                    out.back() = graph_.subtract(out.back(), graph_.multiply(entry.value, slopes[entry.index]));
        }
        return out;
    }

    /// Ad_W^b_c lambda_b by W E_c W^-1 = Ad_W^b_c E_b, one system with the matrix W.
    [[nodiscard]] std::vector<NodeId> adjoint(const std::vector<NodeId>& lambda)
    {
        const std::size_t size = groupoid_.size, m = lambda.size();
        if (m == 0) return {};
        std::vector<NodeId> functional(size * size, graph_.constant(0)); // transposed: tr(functional Z) = lambda(Z)
        for (std::size_t k = 0; k < m; ++k) {
            const std::size_t row = groupoid_.rows[k];
            std::vector<NodeId> unit(size * size, graph_.constant(0));
            unit[row] = graph_.constant(1);
            const std::vector<NodeId> components = span_.components(unit);
            NodeId& entry = functional[row % size * size + row / size];
            for (std::size_t b = 0; b < m; ++b) entry = graph_.add(entry, graph_.multiply(lambda[b], components[b]));
        }
        const std::vector<NodeId>& W = groupoid_.arrow.W;
        const std::vector<NodeId> moved =
            element_quotient(graph_, groupoid_, W, matrix_product(graph_, functional, W, size));
        std::vector<NodeId> out;
        for (const std::vector<NodeId>& E : groupoid_.generators) {
            NodeId trace = graph_.constant(0);
            for (std::size_t p = 0; p < size; ++p)
                for (std::size_t q = 0; q < size; ++q)
                    trace = graph_.add(trace, graph_.multiply(moved[p * size + q], E[q * size + p]));
            out.push_back(trace);
        }
        return out;
    }

    /// A_i^c over x_next.
    [[nodiscard]] std::vector<NodeId> connection_behind(std::size_t i)
    {
        std::vector<std::pair<NodeId, NodeId>> moved;
        for (std::size_t k = 0; k < groupoid_.n(); ++k)
            moved.emplace_back(groupoid_.arrow.x[k], groupoid_.arrow.next[k]);
        return substitute(graph_, groupoid_.connection[i], moved);
    }

    [[nodiscard]] std::vector<NodeId> momenta_behind()
    {
        const std::size_t horizontal = groupoid_.horizontal();
        const std::vector<NodeId> slopes = gradient(graph_, L_, groupoid_.coordinates());
        const std::vector<NodeId> vertical = adjoint(moved_momenta(slopes));
        std::vector<NodeId> behind;
        for (std::size_t i = 0; i < horizontal; ++i) {
            const NodeId x = groupoid_.arrow.x[i], next = groupoid_.arrow.next[i], one = graph_.constant(1);
            const std::vector<std::pair<NodeId, NodeId>> both{{x, one}, {next, one}};
            const NodeId along = directional(graph_, std::vector<NodeId>{L_}, both)[0];
            NodeId mu = graph_.add(free_momentum(i), along);
            if (!groupoid_.connection.empty()) {
                const std::vector<NodeId>& here = groupoid_.connection[i];
                const std::vector<NodeId> there = connection_behind(i);
                for (std::size_t c = 0; c < vertical.size(); ++c) {
                    mu = graph_.add(mu, graph_.multiply(here[c], free_momentum(horizontal + c)));
                    mu = graph_.subtract(mu, graph_.multiply(there[c], vertical[c]));
                }
            }
            behind.push_back(mu);
        }
        behind.insert(behind.end(), vertical.begin(), vertical.end());
        const std::vector<NodeId>& work = system_.discrete->work.target;
        for (std::size_t a = 0; a < work.size(); ++a) behind[a] = graph_.add(behind[a], work[a]);
        return behind;
    }

    void add_forward()
    {
        Kernel kernel =
            table_kernel(form_, "forward", column("x", over_lanes(target(graph_, groupoid_, groupoid_.arrow))));
        kernel.outputs.push_back(column("mu", over_lanes(momenta_behind())));
        form_.kernels.push_back(std::move(kernel));
    }

    void add_arrow_equation()
    {
        std::vector<NodeId> residual;
        for (std::size_t a = 0; a < system_.r(); ++a)
            residual.push_back(graph_.subtract(system_.mu[a], equations_.momenta[a]));
        for (const NodeId slope : equations_.stationary) residual.push_back(graph_.negate(slope));
        const std::size_t unknowns = equations_.unknowns();
        Kernel kernel = table_kernel(form_, "arrow_equation", column("R", over_lanes(residual)));
        kernel.outputs.push_back(matrix(graph_, "N", unknowns, unknowns, over_lanes(equations_.matrix)));
        kernel.documentation.emplace_back("N_ab = <-e_b(F^-L_a) is Newton's matrix. Inner unknowns w add R = -dL/dw.");
        if (system_.discrete->logarithm)
            kernel.documentation.emplace_back("The first of them are xi with exp(xi) = W; theirs is R = -f(xi, W), "
                                              "f^c E_c = cay^-1(exp(-xi) W).");
        form_.kernels.push_back(std::move(kernel));
    }

    /// The state behind a step: N d = mu - F^-L(x, x), all of it at x_next, t + h and the momenta F^+L.
    void add_explicit_step()
    {
        const std::vector<NodeId>&x = groupoid_.arrow.x, &next = groupoid_.arrow.next;
        if (groupoid_.size > 0 || next.size() < groupoid_.n() || !equations_.stationary.empty() ||
            depends_on_any(graph_, equations_.matrix, next))
            return;
        std::vector<std::pair<NodeId, NodeId>> stays,
            moves{{system_.time, graph_.add(system_.time, system_.discrete->step)}};
        std::vector<NodeId> behind = gradient(graph_, L_, next);
        const std::vector<NodeId>& work = system_.discrete->work.target;
        for (std::size_t a = 0; a < work.size(); ++a) behind[a] = graph_.add(behind[a], work[a]);
        const std::vector<NodeId> target = over_lanes(next), momenta = over_lanes(behind);
        for (std::size_t i = 0; i < next.size(); ++i) {
            stays.emplace_back(next[i], x[i]);
            moves.emplace_back(x[i], target[i]);
            moves.emplace_back(system_.mu[i], momenta[i]);
        }
        std::vector<NodeId> right = substitute(graph_, equations_.momenta, stays);
        for (std::size_t a = 0; a < right.size(); ++a) right[a] = graph_.subtract(system_.mu[a], right[a]);
        const std::vector<NodeId> arrow = graph_.solve(equations_.matrix, right, MatrixStructure::general);
        std::vector<NodeId> state = target;
        for (const NodeId d : substitute(graph_, arrow, moves)) state.push_back(d);
        state.insert(state.end(), momenta.begin(), momenta.end());
        form_.kernels.push_back(table_kernel(form_, "explicit_step", column("s1", state)));
    }

    /// The entries of a direction d or of a matrix A as inputs.
    [[nodiscard]] KernelInput input(const std::string& name, std::size_t rows, std::size_t columns)
    {
        KernelInput made{name, ArrayRole::value, {columns > 1 ? 2 : 1, rows, columns}, {}};
        for (std::size_t k = 0; k < rows * columns; ++k) {
            const std::string entry = columns > 1 ? fmt::format("{}_{}_{}", name, k / columns + 1, k % columns + 1)
                                                  : fmt::format("{}_{}", name, k + 1);
            made.entries.push_back({entry, {}, {}, graph_.input("entry " + entry)});
        }
        return made;
    }

    /// d^c - A_i^c(x_next) d^i over the generators, and back.
    void add_algebra()
    {
        const std::size_t size = groupoid_.size, horizontal = groupoid_.horizontal(), r = system_.r();
        if (size == 0) return;
        KernelInput d = input("d", r, 1);
        std::vector<NodeId> along;
        for (std::size_t c = horizontal; c < r; ++c) along.push_back(d.entries[c].input);
        for (std::size_t i = 0; i < horizontal && !groupoid_.connection.empty(); ++i) {
            const std::vector<NodeId> there = connection_behind(i);
            for (std::size_t c = 0; c < along.size(); ++c)
                along[c] = graph_.subtract(along[c], graph_.multiply(there[c], d.entries[i].input));
        }
        const std::vector<NodeId> sum = span_.matrix(along);
        if (groupoid_.has_cayley_map)
            add_cayley(std::move(d), sum);
        else
            add_matrices(std::move(d), sum);
        form_.kernels.push_back(
            table_kernel(form_, "element", matrix(graph_, "W", size, size, over_lanes(groupoid_.arrow.W))));
    }

    /// Zeros of the horizontal sections, then the components of A.
    [[nodiscard]] std::vector<NodeId> coordinates_of(const std::vector<NodeId>& A)
    {
        std::vector<NodeId> coordinates(groupoid_.horizontal(), graph_.constant(0));
        for (const NodeId component : span_.components(A)) coordinates.push_back(component);
        return coordinates;
    }

    /// cay(A) - 1 = (1 - A/2)^-1 A, and of V = W - 1 the A with cay(A) = W, (1 + V/2)^-1 V.
    void add_cayley(KernelInput d, const std::vector<NodeId>& A)
    {
        const std::size_t size = groupoid_.size;
        const std::vector<NodeId> step = cayley_less_one(graph_, A, size);
        Kernel kernel = table_kernel(form_, "cayley_step", matrix(graph_, "V", size, size, over_lanes(step)));
        kernel.inputs.push_back(std::move(d));
        form_.kernels.push_back(std::move(kernel));
        const std::vector<NodeId> V = less_one(graph_, over_lanes(groupoid_.arrow.W), size);
        const std::vector<NodeId> back = cayley_inverse(graph_, V, size);
        form_.kernels.push_back(table_kernel(form_, "cayley_coordinates", column("d", coordinates_of(back))));
    }

    /// A, and the components of a matrix, for exp.
    void add_matrices(KernelInput d, const std::vector<NodeId>& A)
    {
        const std::size_t size = groupoid_.size;
        Kernel kernel = table_kernel(form_, "algebra_matrix", matrix(graph_, "A", size, size, over_lanes(A)));
        kernel.inputs.push_back(std::move(d));
        form_.kernels.push_back(std::move(kernel));
        KernelInput given = input("A", size, size);
        std::vector<NodeId> entries;
        for (const Quantity& entry : given.entries) entries.push_back(entry.input);
        Kernel back = table_kernel(form_, "in_algebra", column("d", coordinates_of(entries)));
        back.inputs.push_back(std::move(given));
        form_.constants.push_back(std::move(back));
    }

    void add_functions()
    {
        form_.kernels.push_back(table_kernel(form_, "momentum", column("p", over_lanes(equations_.momenta))));
        const NodeId L = over_lanes({L_})[0];
        form_.binding["lagrangian"] = L;
        if (const NodeId step = system_.discrete->step; graph_.op(step) == Op::input) {
            const NodeId energy = graph_.negate(gradient(graph_, L, std::vector<NodeId>{step})[0]);
            form_.binding["energy"] = energy;
            form_.kernels.push_back(scalar_kernel(form_, "energy", energy));
        }
        form_.kernels.push_back(scalar_kernel(form_, "lagrangian", L));
    }

    void bind_names()
    {
        form_.binding[model_.discrete->step.name] = system_.discrete->step;
        bind_system(graph_, system_, form_);
        for (const auto* nodes : {&groupoid_.arrow.next, &groupoid_.arrow.W})
            for (const NodeId node : *nodes) form_.binding[graph_.input_name(node)] = over_lanes({node})[0];
        for (const NodeId mu : system_.mu) form_.binding[graph_.input_name(mu)] = mu;
    }

    Graph& graph_;
    const Model& model_;
    const System& system_;
    const Groupoid& groupoid_;
    NodeId L_;
    ArrowEquations equations_;
    GeneratorSpan span_;
    Formulation form_;
    std::vector<std::pair<NodeId, NodeId>> lanes_; ///< x_next and W by the lanes
};

} // namespace

namespace {

/// "k_w1 = 1, k_w2 = x"
std::string vector_text(const std::vector<std::pair<std::string, Tree>>& vector)
{
    return comma_list(vector,
                      [](const auto& entry) { return fmt::format("k_{} = {}", entry.first, to_text(entry.second)); });
}

void require_regular(const System& system, const Regularity& regularity)
{
    if (regularity.kind != Regularity::Kind::degenerate) return;
    throw MathematicsError(
        fmt::format("the discrete Lagrangian of model '{}' is degenerate: N_ab = <-e_b(F^-L_a) has rank {}, and the "
                    "discrete form needs rank {}",
                    system.name, regularity.rank, system.r()),
        regularity.kernel.empty()
            ? "the arrow of a step cannot be solved for; let L depend on the arrow in every direction"
            : fmt::format(
                  "the arrow of a step cannot be solved for: the momenta F^-L do not change along the kernel vector {}",
                  vector_text(regularity.kernel[0])));
}

} // namespace

Formulation discrete_form(Graph& graph, const Model& model, const System& system, const Report& report,
                          const FormulationRequest& request)
{
    if (!system.discrete)
        throw MathematicsError(fmt::format("model '{}' has no [discrete], which the discrete form needs", model.name));
    if (!system.discrete->lagrangian)
        throw MathematicsError(fmt::format("the scheme '{}' makes no discrete Lagrangian of model '{}': {}",
                                           model.discrete->scheme, model.name, system.discrete->obstacle),
                               system.discrete->hint.empty() ? "write it out: [discrete] L = \"..\""
                                                             : system.discrete->hint);
    require_regular(system, report.mechanics.discrete);
    Formulation form = DiscreteForm(graph, model, system, request).build();
    const Regularity& regularity = report.mechanics.regularity;
    if (request.hamiltonian && system.lagrangian && regularity.kind == Regularity::Kind::regular)
        if (const auto H = closed_hamiltonian(graph, system, regularity.newton_start))
            form.kernels.push_back(scalar_kernel(form, "hamiltonian", H->value));
    return form;
}

} // namespace lagen
