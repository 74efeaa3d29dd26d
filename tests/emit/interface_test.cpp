// SPDX-License-Identifier: GPL-2.0-or-later
#include "../support/golden.hpp"
#include "emit/print_header.hpp"
#include "hand_built.hpp"

#include <filesystem>

using namespace lagen;
using namespace lagen::testing;

namespace {

/// A pendulum with the derivative of its right-hand side.
KernelModule module_with_jacobian()
{
    KernelModule module = pendulum_module();
    Graph& g = *module.graph;
    const NodeId ratio = g.divide(module.parameters[2].input, module.parameters[1].input);
    module.parameter_conditions = {{"l > 0", module.parameters[1].input}};
    KernelOutput values{"values", {2, 2, 2}, {{0, 1, g.constant(1)}}};
    values.sparse = true;
    values.entries.push_back({1, 0, g.negate(g.multiply(ratio, g.apply(Op::cos, base_of(module)[0].input)))});
    module.kernels.push_back({.name = "jacobian", .inputs = point_inputs(module), .outputs = {values}});
    return module;
}

const char* const program = R"(#include "pendulum.hpp"
#include "product.hpp"

#include "lagen/lanes/pack.hpp"

#include <cstdio>
#include <cstring>

template <class S>
void check()
{
    using M = lagen::models::pendulum<S>;
    static_assert(std::is_same_v<typename M::Scalar, S>);
    static_assert(lagen::RightHandSide<M> && lagen::HasEnergy<M> && lagen::HasJacobian<M>);
    static_assert(!lagen::HasConstraints<M> && !lagen::HasDomain<M> && !lagen::HasEvents<M>);
    static_assert(M::dimension == 2 && M::base_dimension == 1 && M::fibre_dimension == 1);
    static_assert(noexcept(std::declval<const M&>().energy(std::declval<S>(), std::declval<const typename M::State&>())));
}

int main()
{
    check<float>();
    check<double>();
    check<long double>();
    check<lagen::Pack<double, 4>>();
    using Pendulum = lagen::models::pendulum<double>;
    static_assert(std::is_same_v<Pendulum::State, Eigen::Matrix<double, 2, 1>>);
    static_assert(!lagen::RightHandSide<lagen::models::product<double>>);
    Pendulum pendulum;
    pendulum.parameters.g = 2;
    pendulum.parameter(1) = 4;
    Pendulum::State s = Pendulum::state({.th = 0}, {.v = 3});
    Pendulum::State ds;
    lagen::Status status = pendulum.rhs(0, s, ds);
    std::printf("%s %g %g\n", lagen::to_text(status), ds[0], ds[1]);
    status = pendulum.rhs(0, s, s);
    std::printf("%s %g %g\n", lagen::to_text(status), s[0], s[1]);
    const auto jacobian = pendulum.jacobian(0, Pendulum::state({}, {}));
    std::printf("%g %g %g %g\n", jacobian(0, 0), jacobian(0, 1), jacobian(1, 0), jacobian(1, 1));
    pendulum.parameters.m = 0;
    std::printf("%s %s %s\n", lagen::to_text(pendulum.parameter_status()), Pendulum::parameter_names[1], Pendulum::state_names[0]);
    pendulum.parameters.m = 1;
    std::printf("%s", lagen::to_text(pendulum.parameter_status()));
    pendulum.parameters.l = -4;
    std::printf(" %s\n", lagen::to_text(pendulum.parameter_status()));
    using Pack = lagen::Pack<double, 4>;
    lagen::models::pendulum<Pack> lanes;
    std::printf("%d", lagen::StatusOf<Pack>::all_good(lanes.parameter_status()));
    lanes.parameters.l = Pack(-1);
    std::printf(" %d\n", lagen::StatusOf<Pack>::all_good(lanes.parameter_status()));
    std::printf("%s %s %s\n", Pendulum::model_name, Pendulum::model_hash, Pendulum::tip_names[1]);
    lagen::models::product<double> product;
    std::printf("%g\n", product.f(0, product.state({.y = 2})));
}
)";

} // namespace

TEST_CASE("a generated class has the members that its user types", "[emit][compile]")
{
    const std::string where = std::string(LAGEN_BINARY_DIR) + "/compiled/interface";
    std::filesystem::create_directories(where);
    write_text(where + "/pendulum.hpp", print_header(module_with_jacobian()));
    write_text(where + "/product.hpp", print_header(product_module()));
    write_text(where + "/main.cpp", program);
    for (const std::string compiler : {"g++", "clang++"}) {
        if (run_shell(compiler + " --version").status != 0) continue;
        const Shell build =
            run_shell(compiler +
                      " -std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I" LAGEN_SOURCE_DIR
                      "/runtime/include $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) '" +
                      where + "/main.cpp' -o '" + where + "/main'");
        INFO(build.output);
        REQUIRE(build.status == 0);
        CHECK(run_shell("'" + where + "/main'").output == "ok 3 -0\nok 3 -0\n0 1 -0.5 0\nsingular_mass_matrix l th\n"
                                                          "ok left_domain\n1 0\n"
                                                          "pendulum 0123456789abcdef tip y\n0\n");
    }
}
