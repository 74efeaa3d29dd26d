// SPDX-License-Identifier: GPL-2.0-or-later
#include "../support/compiled.hpp"
#include "models.hpp"

using namespace lagen;
using namespace lagen::testing;

namespace {

std::vector<CompiledCase> every_model()
{
    std::vector<CompiledCase> cases;
    for (const std::string& file : model_files()) {
        for (const KernelModule& module : kernels_of_file(file)) {
            // Second forms of large models would double the time and show nothing new.
            const bool first = &module == &kernels_of_file(file).front();
            if (!first && lanes_of(module).size() > 8) continue;
            std::vector<Point> points;
            for (unsigned seed = 1; seed < (first ? 4 : 2); ++seed) {
                points.push_back(random_point(module, seed));
                points.back()["t"] = 0.25;
            }
            cases.push_back({module, std::move(points)});
        }
    }
    return cases;
}

} // namespace

TEST_CASE("the compiled kernels of every model agree with the interpreter, alone and in packs", "[kernels][compile]")
{
    const std::vector<CompiledCase> cases = every_model();
    REQUIRE(cases.size() >= 10);
    compare_compiled("models", "g++", cases, 2000, two_scalars);
}

TEST_CASE("the compiled kernels of every model agree with the interpreter in four scalars with both compilers",
          "[kernels][all]")
{
    const std::vector<CompiledCase> cases = every_model();
    REQUIRE(cases.size() >= 10);
    compare_compiled("models_all", "g++", cases, 2000);
    if (run_shell("clang++ --version").status == 0) compare_compiled("models_all", "clang++", cases, 2000);
}

TEST_CASE("the header of a model is the same in a second generation", "[kernels]")
{
    std::size_t number = 0;
    for (const std::string& file : model_files()) {
        if (LAGEN_SANITIZED && ++number % 4 != 0) continue;
        const std::string first = print_header(kernels_of_file(file).front());
        CHECK(first.find("class ") != std::string::npos);
        CHECK(first == print_header(kernels_of(read_model(file, {}, choosers()))));
    }
}
