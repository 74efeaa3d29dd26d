// SPDX-License-Identifier: GPL-2.0-or-later
/// Groups that move states: the rates of every model are those of its element of the algebra, and the group acts as its
/// bracket says.
#include "models.hpp"

#include "support/tolerances.hpp"

#include <random>

using namespace lagen;
using namespace lagen::testing;

namespace {

/// A kernel with `values` in the place of its input called `name`.
std::vector<double> with_input(const KernelModule& module, const std::string& kernel, Values point,
                               const std::vector<std::pair<std::string, std::vector<double>>>& arguments)
{
    for (const KernelInput& input : find_kernel(module, kernel).inputs)
        for (const auto& [name, values] : arguments)
            if (input.name == name)
                for (std::size_t k = 0; k < values.size(); ++k)
                    point[module.graph->input_name(input.entries[k].input)] = values[k];
    return values_of(module, kernel, point);
}

/// A(xi) at the lanes s.
std::vector<double> action(const KernelModule& module, Values point, const std::vector<double>& s,
                           const std::vector<double>& xi)
{
    std::size_t k = 0;
    for (const Quantity& lane : lanes_of(module)) point[lane.name] = s[k++];
    return with_input(module, "algebra_action", point, {{"xi", xi}});
}

std::string moved_lanes(const KernelModule& module)
{
    std::string text;
    std::size_t k = 0;
    for (const Quantity& lane : lanes_of(module))
        if (!module.motion.moved.empty() && module.motion.moved[k++]) text += (text.empty() ? "" : " ") + lane.name;
    return text;
}

std::string moved_in(const std::string& text, const std::string& form)
{
    KernelRequest request;
    request.form = form;
    const KernelModule module = kernels_of(read_model_text("test.toml", text), request);
    return module.motion.moved.empty() ? module.motion.obstacle : moved_lanes(module);
}

} // namespace

TEST_CASE("the lanes that a group moves have the rates of its algebra, in every form of every model", "[kernels]")
{
    std::size_t compared = 0;
    for (const std::string& file : model_files())
        for (const KernelModule& module : kernels_of_file(file)) {
            if (module.kind == ModuleKind::step) continue;
            INFO(module.name);
            CHECK(module.motion.moved.empty() != module.motion.obstacle.empty());
            if (module.motion.moved.empty()) continue;
            ++compared;
            const Values point = random_point(module, 3);
            const std::vector<double> xi = values_of(module, "algebra_element", point);
            const std::vector<double> moved = with_input(module, "algebra_action", point, {{"xi", xi}});
            const std::vector<double> rhs = values_of(module, "rhs", point);
            REQUIRE(moved.size() == rhs.size());
            for (std::size_t k = 0; k < rhs.size(); ++k)
                if (module.motion.moved[k])
                    CHECK(std::abs(moved[k] - rhs[k]) <= tolerance::roundoff(4096) * (1 + std::abs(rhs[k])));
                else
                    CHECK(moved[k] == 0);
        }
    CHECK(compared >= 16);
}

TEST_CASE("the commutator of what two elements do is what their bracket does, up to the sign", "[kernels]")
{
    std::mt19937 random(7);
    const auto some = [&](std::size_t count) {
        std::vector<double> values;
        for (std::size_t k = 0; k < count; ++k) values.push_back(static_cast<double>(random()) / 4294967295.0 - 0.5);
        return values;
    };
    std::size_t noncommuting = 0;
    for (const std::string& file : model_files())
        for (const KernelModule& module : kernels_of_file(file)) {
            if (module.motion.moved.empty()) continue;
            INFO(module.name);
            const Values point = random_point(module, 4);
            const std::size_t n = module.motion.dimension;
            const std::vector<double> u = some(n), v = some(n), s = some(lanes_of(module).size());
            const std::vector<double> bracket = with_input(module, "algebra_bracket", point, {{"xi", u}, {"eta", v}});
            const std::vector<double> uv = action(module, point, action(module, point, s, v), u);
            const std::vector<double> vu = action(module, point, action(module, point, s, u), v);
            const std::vector<double> expected = action(module, point, s, bracket);
            double size = 0;
            for (std::size_t k = 0; k < s.size(); ++k) {
                CHECK(std::abs(uv[k] - vu[k] + expected[k]) <= tolerance::roundoff(4096));
                size += std::abs(expected[k]);
            }
            if (size > 0.01) ++noncommuting;
        }
    CHECK(noncommuting >= 10);
}

TEST_CASE("a group moves momenta, base coordinates and matrices where that is linear, and nothing else", "[kernels]")
{
    const std::string body = "[fibre]\ncoordinates = ['w1', 'w2', 'w3']\n[algebroid]\nkind = 'lie_algebra'\n"
                             "algebra = 'so(3)'\n[lagrangian]\nL = 'w1^2 + 2*w2^2 + 3*w3^2'\n";
    CHECK(moved_in(body, "lagrange") == "the group moves no lane");
    CHECK(moved_in(body, "hamilton") == "p_w1 p_w2 p_w3");
    CHECK(moved_in(body + "[forces]\nw1 = '-w1'\n", "hamilton") == "the group moves no lane");
    CHECK(moved_in(body + "[reconstruct]\nR = 'SO(3)'\n", "lagrange") ==
          "R[1,1] R[1,2] R[1,3] R[2,1] R[2,2] R[2,3] R[3,1] R[3,2] R[3,3]");
    const auto on_a_line = [](const std::string& anchor, const std::string& more = "") {
        return "[base]\ncoordinates = ['x', 'z']\n[fibre]\ncoordinates = ['a', 'b']\n[algebroid]\n[algebroid.anchor]\n"
               "a = " +
               anchor + "\n[lagrangian]\nL = 'a^2 + b^2 - x*z'\n" + more;
    };
    CHECK(moved_in(on_a_line("{ x = '2*x + z' }"), "lagrange") == "x z");
    CHECK(moved_in(on_a_line("{ x = '2*x + z' }"), "hamilton") == "x z p_a p_b");
    CHECK(moved_in(on_a_line("{ x = '2*x + z' }", "[dissipation]\nR = 'a^2'\n"), "hamilton") == "x z");
    CHECK(moved_in(on_a_line("{ x = 'x*z' }"), "lagrange") == "x' is not linear in the lanes that the group moves");
    CHECK(moved_in(on_a_line("{ x = '1 + x' }"), "hamilton") == "x' is not linear in the lanes that the group moves");
    CHECK(moved_in(on_a_line("{ x = 'x', z = '1' }"), "hamilton") == "x");
    CHECK(moved_in(on_a_line("{ x = 'z', z = '1' }"), "lagrange") ==
          "z' is not linear in the lanes that the group moves");
    CHECK(moved_in(on_a_line("{ x = 'x' }", "[algebroid.bracket]\n'a,b' = { b = 'z' }\n"), "lagrange") ==
          "brackets of sections depend on z");
}
