// SPDX-License-Identifier: GPL-2.0-or-later
/// Implicit methods on compiled models beside the classes that they were made of: the bits of runs, memory in steps.
#include "counted_memory.hpp"

#include "heavy_top.hpp"
#include "implicit_models.hpp"

namespace {

/// A class, the same model compiled, and where runs of it start and end.
template <class M>
struct Pair {
    const char* name;
    lagen::CompiledModel compiled;
    typename M::State s;
    double end;

    /// The same run of both: ends, rows and counts; then the memory that steps take.
    void operator()(const char* method_name, const auto& method) const
    {
        const Eigen::VectorXd v = s;
        const std::vector<double> at{0.3 * end, end};
        const auto a = lagen::integrate(M(), s, {0.0, end}, method, {.at = at});
        const auto b = lagen::integrate(compiled, v, {0.0, end}, method, {.at = at});
        bool same = b.status() == a.status() && same_bits(a.state, b.state);
        same = same && a.rhs_calls == b.rhs_calls && a.newton_iterations == b.newton_iterations;
        same = same && a.decompositions == b.decompositions && a.states.size() == b.states.size();
        for (std::size_t k = 0; same && k < a.states.size(); ++k) same = same_bits(a.states[k], b.states[k]);
        bool good = false;
        const std::size_t taken = memory_of_steps(compiled, v, method, good);
        std::printf("%s %s %s %s %zu %s\n", name, method_name, to_text(a.status()), same ? "same" : "other", taken,
                    good ? "ok" : "failed");
    }
};

} // namespace

int main()
{
    using namespace lagen::models;
    const std::string folder = std::filesystem::read_symlink("/proc/self/exe").parent_path().string() + "/";
    const auto load = [&](const char* name) { return lagen::CompiledModel::load(folder + name + ".so").model; };
    using Top = heavy_top<double>;
    const Pair<Top> top{"heavy_top", load("heavy_top"),
                        Top::state({.g1 = 0.1, .g2 = 0.6, .g3 = 0.8}, {.w1 = 0.3, .w2 = -0.2, .w3 = 5}), 3};
    top("gauss2", lagen::Gauss2{.step = 0.01});
    top("gauss4", lagen::Gauss4{.step = 0.01});
    top("gauss8", lagen::Gauss8{.step = 0.03});
    top("gauss12", lagen::Gauss12{.step = 0.05});
    top("radau5", lagen::Radau5{.tolerance = 1e-9});
    const Pair<relaxation<double>> slow{"relaxation", load("relaxation"), relaxation<double>::State(2.0), 2};
    slow("gauss4", lagen::Gauss4{.step = 0.01});
    slow("radau3_fixed", lagen::Radau3Fixed{.step = 0.02});
    slow("radau5", lagen::Radau5{.tolerance = 1e-7});
    const Pair<van_der_pol<double>> pol{"van_der_pol", load("van_der_pol"), {2, 0}, 100};
    pol("gauss6", lagen::Gauss6{.step = 0.05});
    pol("radau5_fixed", lagen::Radau5Fixed{.step = 0.05});
    pol("radau5", lagen::Radau5{.tolerance = 1e-7});
    lattice<double>::State pushed;
    for (int k = 0; k < pushed.size(); ++k) pushed[k] = std::sin(1.0 + 3 * k);
    const Pair<lattice<double>> line{"lattice", load("lattice"), pushed, 2};
    line("gauss4", lagen::Gauss4{.step = 0.05});
    line("gauss8", lagen::Gauss8{.step = 0.05});
    line("radau5", lagen::Radau5{.tolerance = 1e-6});
    const auto decays = load("decay");
    for (const lagen::Status status :
         {lagen::integrate(decays, Eigen::VectorXd::Ones(1), {0.0, 1.0}, lagen::Gauss4{.step = 0.1}).status(),
          lagen::integrate(decays, Eigen::VectorXd::Ones(1), {0.0, 1.0}, lagen::Gauss16{.step = 0.1}).status(),
          lagen::integrate(decays, Eigen::VectorXd::Ones(1), {0.0, 1.0}, lagen::Radau5{}).status()})
        std::printf("without a Jacobian %s\n", lagen::to_text(status));
}
