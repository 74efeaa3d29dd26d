// SPDX-License-Identifier: GPL-2.0-or-later
#include "emit/print_header.hpp"

#include "../support/golden.hpp"
#include "hand_built.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

using namespace lagen;
using namespace lagen::testing;

TEST_CASE("a module without mechanics becomes a header", "[emit]")
{
    check_golden("product.hpp", print_header(product_module()));
}

TEST_CASE("the header of a pendulum reads as if written by hand", "[emit]")
{
    check_golden("pendulum.hpp", print_header(pendulum_module()));
}

TEST_CASE("a definite matrix is factorised in the order of least fill", "[emit]")
{
    // an arrow that points up: elimination from the front would fill the whole matrix
    const std::vector<std::vector<bool>> arrow{
        {true, true, true, true}, {true, true, false, false}, {true, false, true, false}, {true, false, false, true}};
    check_golden("arrowhead.hpp", print_header(solve_module("arrowhead", arrow, MatrixStructure::positive_definite)));
}

TEST_CASE("a matrix of unknown definiteness goes to pivoted LU, one of order two to the closed form", "[emit]")
{
    const std::vector<std::vector<bool>> full(3, std::vector<bool>(3, true));
    check_golden("pivoted.hpp", print_header(solve_module("pivoted", full, MatrixStructure::symmetric)));
    const std::vector<std::vector<bool>> two(2, std::vector<bool>(2, true));
    check_golden("closed_form.hpp", print_header(solve_module("closed_form", two, MatrixStructure::general)));
}

TEST_CASE("text of the user cannot break out of a comment or a string", "[emit]")
{
    KernelModule module = product_module();
    module.title = "evil\n#error one\r\\";
    base_of(module)[0].text = "*/ int x; \?\?/ \\";
    base_of(module)[0].unit = "m\n";
    module.kernels[0].outputs[0].entry_names = {"a\"b\\n"};
    const std::string text = print_header(module);
    CHECK(text.find("\n#error") == std::string::npos);
    CHECK(text.find('\\' + std::string("\n")) == std::string::npos);
    CHECK(text.find("\?\?/") == std::string::npos);
    CHECK(text.find("/// product: evil #error one /\n") != std::string::npos);
    CHECK(text.find("S x = S(0); ///< * / int x; ? ?/ / [m]\n") != std::string::npos);
    CHECK(text.find("f_names = {\"a\\\"b\\\\n\"};") != std::string::npos);
}

TEST_CASE("Stumpff functions of one argument are one call, and their header is included where they are", "[emit]")
{
    KernelModule module = empty_module("turning");
    Graph& g = *module.graph;
    base_of(module) = {declare(g, "x"), declare(g, "stumpff")};
    const NodeId z = g.multiply(base_of(module)[0].input, base_of(module)[1].input);
    module.kernels = {vector_kernel(module, "f", {g.stumpff(1, z), g.stumpff(3, z)}),
                      scalar_kernel(module, "h", g.stumpff(2, z))};
    const std::string text = print_header(module);
    CHECK(text.find("#include \"lagen/stumpff.hpp\"\n") != std::string::npos);
    CHECK(text.find("const S w0 = x * stumpff_;\n        const auto w1 = stumpff_orders<1, 3, S>(w0);\n") !=
          std::string::npos);
    CHECK(text.find("result[0] = w1[0];\n") != std::string::npos);
    CHECK(text.find("result[1] = w1[2];\n") != std::string::npos);
    CHECK(text.find("return stumpff<2, S>(x * stumpff_);\n") != std::string::npos);
    CHECK(print_header(product_module()).find("stumpff") == std::string::npos);
}

TEST_CASE("square roots are the runtime's, and headers are included where their functions are called", "[emit]")
{
    KernelModule module = empty_module("rooted");
    Graph& g = *module.graph;
    base_of(module) = {declare(g, "x"), declare(g, "square_roots")};
    const NodeId sum = g.add(base_of(module)[0].input, base_of(module)[1].input);
    module.kernels = {scalar_kernel(module, "f", g.apply(Op::sqrt, sum))};
    const std::string text = print_header(module);
    CHECK(text.find("#include \"lagen/roots.hpp\"\n") != std::string::npos);
    CHECK(text.find("using arithmetic::sqrt;\n") != std::string::npos);
    CHECK(text.find("return sqrt(x + square_roots_);\n") != std::string::npos);
    CHECK(text.find("lagen/sincos.hpp") == std::string::npos);
    CHECK(print_header(product_module()).find("roots.hpp") == std::string::npos);
}

TEST_CASE("the same module gives the same bytes", "[emit]")
{
    CHECK(print_header(pendulum_module()) == print_header(pendulum_module()));
    CHECK(print_header(pendulum_module()).size() > 1000);
}

TEST_CASE("an equation stands whole in a banner, or is left out with the command that prints it", "[emit]")
{
    KernelModule module = product_module();
    module.derive = "lagen derive product.toml";
    module.regenerate += std::string(300, 'x');
    const std::string longest(200, 'a');
    module.equations = {"motion:",  "  x = 1", "      + 2", "  y = " + longest, "  z = 3", "      + " + longest,
                        "      + 4"};
    std::string text = print_header(module);
    CHECK(text.find("///   motion:\n///     x = 1\n///         + 2\n"
                    "///     (2 equations are too long to stand here: lagen derive product.toml prints them)\n///\n") !=
          std::string::npos);
    module.equations = {"  y = " + longest, "  z = " + longest.substr(6)};
    text = print_header(module);
    CHECK(text.find("///     (one equation is too long to stand here: lagen derive product.toml prints it)\n"
                    "///     z = " +
                    longest.substr(6) + "\n") != std::string::npos);
    CHECK(text.find(module.regenerate + "\n") != std::string::npos);
}

TEST_CASE("the entries of a vector are stored in their order, the members of a struct are loaded by its names",
          "[emit]")
{
    KernelModule module = empty_module("ordered");
    Graph& g = *module.graph;
    module.parameters = {declare(g, "a"), declare(g, "b"), declare(g, "unread")};
    std::vector<NodeId> sums{module.parameters[0].input};
    std::vector<NodeId> products;
    for (int k = 0; k < 20; ++k) { // late values first: the order of least pressure is another one
        base_of(module).push_back(declare(g, "x" + std::to_string(k)));
        sums.push_back(g.add(g.multiply(sums.back(), base_of(module).back().input), module.parameters[1].input));
    }
    for (std::size_t k = sums.size() - 1; k > 0; --k) products.push_back(g.multiply(sums[k], sums[k - 1]));
    module.kernels = {vector_kernel(module, "f", products)};
    const std::string text = print_header(module);
    std::size_t at = text.find("const auto [a, b, unread] = parameters;\n");
    CHECK(at != std::string::npos);
    for (std::size_t k = 0; k < products.size(); ++k) {
        const std::size_t next = text.find("result[" + std::to_string(k) + "] = ", at);
        CHECK(next != std::string::npos);
        at = next;
    }
}

TEST_CASE("names that C++ cannot bear are altered and stay distinct", "[emit]")
{
    CHECK(cpp_names({"class", "I", "y0", "S", "t", "x", "theta_1"}) ==
          std::vector<std::string>{"class_", "I_", "y0_", "S_", "t_", "x", "theta_1"});
    CHECK(cpp_names({"θ", "Ω", "é"}) == std::vector<std::string>{"theta", "Omega", "u00E9"});
    CHECK(cpp_names({"θ", "theta", "x[1]", "x_1"}) == std::vector<std::string>{"theta_", "theta", "x_1_", "x_1"});
    CHECK(cpp_names({"class", "class_", "class_1_"}) == std::vector<std::string>{"class_1_1_", "class_", "class_1_"});
    CHECK(cpp_names({"_a", "a__b", ""}) == std::vector<std::string>{"n_a", "a_b", "n"});
}

TEST_CASE("a name that is a macro behind a header, or in the headers of C and POSIX, is altered", "[emit]")
{
    CHECK(cpp_names({"PATH_MAX", "BUFSIZ", "CLOCKS_PER_SEC", "B0", "M_PIl", "EIGEN_ARCH_i386", "SYS_read", "si_pid"}) ==
          std::vector<std::string>{"PATH_MAX_", "BUFSIZ_", "CLOCKS_PER_SEC_", "B0_", "M_PIl_", "EIGEN_ARCH_i386_",
                                   "SYS_read_", "si_pid_"});
    const std::vector<std::string> physical{"B",    "B1",  "E0",     "EKIN", "SIGMA", "OMEGA",
                                            "I_ZZ", "K_T", "M_CART", "S_I1", "PRI"};
    CHECK(cpp_names(physical) == physical);

    const std::string text = "#include <Eigen/Core>\n#include <thread>\n#include <complex.h>\n#include <fenv.h>\n"
                             "#include <inttypes.h>\n#include <signal.h>\n#include <termios.h>\n#include <unistd.h>\n"
                             "#include <sys/ioctl.h>\n#include <sys/stat.h>\n#include <fcntl.h>\n#include <vector>\n";
    const std::string command = "printf '" + text + "' | c++ -std=gnu++20 -I/usr/include/eigen3 -dM -E -x c++ -";
    FILE* const compiler = ::popen(command.c_str(), "r");
    REQUIRE(compiler != nullptr);
    int count = 0;
    for (char line[4096]; std::fgets(line, sizeof line, compiler) != nullptr;) {
        const std::string name = std::string(line).substr(8, std::string(line).find(' ', 8) - 8);
        if (name.front() == '_' || name.find('(') != std::string::npos || name.find('\n') != std::string::npos)
            continue;
        ++count;
        INFO(name);
        CHECK(cpp_names({name}) != std::vector<std::string>{name});
    }
    CHECK(::pclose(compiler) == 0);
    CHECK(count > 1000);
}

TEST_CASE("a class is called like no member, no argument and no variable of any generated one", "[emit]")
{
    CHECK(class_name("pendulum") == "pendulum");
    CHECK(class_name("energy") == "energy_");
    const std::regex declared(R"( (\w+)(\(| = |;|\[\]))"), argument(R"([ &](\w+)[,)])");
    std::set<std::string> names;
    for (const auto& header : std::filesystem::directory_iterator(LAGEN_SOURCE_DIR "/generated")) {
        std::ifstream text(header.path());
        for (std::string line; std::getline(text, line);) {
            const bool member = line.starts_with("    [[nodiscard]]") || line.starts_with("    static constexpr") ||
                                line.starts_with("    void ");
            if (!member) continue;
            line = std::regex_replace(line, std::regex(R"("[^"]*")"), "");
            for (const std::regex* form : {&declared, &argument})
                for (std::sregex_iterator each(line.begin(), line.end(), *form), end; each != end; ++each)
                    names.insert((*each)[1]);
        }
    }
    CHECK(names.count("observables_names") == 1);
    for (const std::string& name : names) {
        INFO(name);
        CHECK(class_name(name) != name);
    }
}

TEST_CASE("shared terms avoid the names of the model", "[emit]")
{
    KernelModule module = empty_module("clash");
    Graph& graph = *module.graph;
    base_of(module) = {declare(graph, "w0"), declare(graph, "s"), declare(graph, "ds")};
    const NodeId shared = graph.add(base_of(module)[0].input, base_of(module)[1].input);
    const NodeId root = graph.apply(Op::sqrt, shared);
    module.kernels = {rate_kernel(module, "rhs", {graph.multiply(root, base_of(module)[2].input), root, shared})};
    const std::string text = print_header(module);
    CHECK(text.find("const S w0 = s[0], s_ = s[1], ds_ = s[2];\n") != std::string::npos);
    CHECK(text.find("const S u0 = w0 + s_;\n") != std::string::npos);
}
