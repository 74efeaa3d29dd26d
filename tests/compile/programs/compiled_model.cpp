// SPDX-License-Identifier: GPL-2.0-or-later
/// A compiled model beside the class that it was made of: what loading answers, the bits of runs, memory in steps.
#include "counted_memory.hpp"

#include "heavy_top.hpp"

namespace {

using Top = lagen::models::heavy_top<double>;

/// The same run of both: their ends, rows and counts.
template <class Method>
void compare(const char* name, const Top& top, const lagen::CompiledModel& compiled, const Method& method)
{
    const Top::State s = Top::state({.g1 = 0.1, .g2 = 0.6, .g3 = 0.8}, {.w1 = 0.3, .w2 = -0.2, .w3 = 5});
    const Eigen::VectorXd v = s;
    const std::vector<double> at{0.5, 1.25, 3};
    const auto a = lagen::integrate(top, s, {0.0, 3.0}, method, {.at = at});
    const auto b = lagen::integrate(compiled, v, {0.0, 3.0}, method, {.at = at});
    bool same = a.status() == lagen::Status::ok && b.status() == a.status() && same_bits(a.state, b.state);
    same = same && a.rhs_calls == b.rhs_calls && a.states.size() == 3 && b.states.size() == 3;
    for (std::size_t k = 0; same && k < a.states.size(); ++k) same = same_bits(a.states[k], b.states[k]);
    std::printf("bits %s %s\n", name, same ? "same" : "other");
}

template <class Method>
void count_memory(const char* name, const lagen::CompiledModel& compiled, const Method& method)
{
    const Eigen::VectorXd s = (Eigen::VectorXd(6) << 0.1, 0.6, 0.8, 0.3, -0.2, 5).finished();
    bool good = false;
    const std::size_t taken = memory_of_steps(compiled, s, method, good);
    std::printf("memory %s %zu %s\n", name, taken, good ? "ok" : "failed");
}

} // namespace

int main()
{
    const std::string folder = std::filesystem::read_symlink("/proc/self/exe").parent_path().string() + "/";
    for (const char* file : {"missing.so", "text.so", "cut.so", "other_machine.so", "other_version.so", "heavy_top.so"})
        std::printf("load %s %s\n", file, lagen::to_text(lagen::CompiledModel::load(folder + file).status));
    const auto [status, compiled] = lagen::CompiledModel::load(folder + "heavy_top.so");
    if (status != lagen::LoadStatus::ok) return 1;
    std::printf("model %s %ld %s %s\n", compiled.name(), static_cast<long>(compiled.lanes()), compiled.state_names()[3],
                compiled.parameter_names()[0]);
    const Top top;
    compare("euler", top, compiled, lagen::Euler{.step = 0.01});
    compare("rk4", top, compiled, lagen::Rk4{.step = 0.01});
    compare("tsit5", top, compiled, lagen::Tsit5{.tolerance = 1e-9});
    compare("dop853", top, compiled, lagen::Dop853{.tolerance = 1e-11});
    compare("verner98", top, compiled, lagen::Verner98{.tolerance = 1e-11});
    count_memory("rk4", compiled, lagen::Rk4{.step = 0.01});
    count_memory("dop853", compiled, lagen::Dop853{.tolerance = 1e-11});
    lagen::CompiledModel heavier = compiled;
    heavier.set_parameter(3, 3.5);
    Top other;
    other.parameters.mgl = 3.5;
    compare("parameters", other, heavier, lagen::Dop853{.tolerance = 1e-11});
    std::printf(
        "nystrom refused %s\n",
        lagen::to_text(lagen::integrate(compiled, Eigen::VectorXd::Ones(6), {0.0, 1.0}, lagen::Rkn86{}).status()));
}
