// SPDX-License-Identifier: GPL-2.0-or-later
/// The C++ that README shows is compiled, and does what README says.
#include "compile/generated_program.hpp"

#include <cmath>

using namespace lagen::testing;

namespace {

std::string trimmed(const std::string& line)
{
    const std::size_t first = line.find_first_not_of(' ');
    return first == std::string::npos ? "" : line.substr(first);
}

/// Every line without its indentation.
std::string unindented(const std::string& text)
{
    std::istringstream in(text);
    std::string lines = "\n";
    for (std::string line; std::getline(in, line);) lines += trimmed(line) + '\n';
    return lines;
}

/// The blocks of C++ of a page.
std::vector<std::string> blocks_of(const std::string& page)
{
    std::vector<std::string> blocks;
    const std::string opening = "\n```cpp\n", closing = "\n```";
    for (std::size_t at = page.find(opening); at != std::string::npos; at = page.find(opening, at)) {
        at += opening.size();
        blocks.push_back(unindented(page.substr(at, page.find(closing, at) - at)));
    }
    return blocks;
}

} // namespace

TEST_CASE("every piece of C++ in README is part of a program that is compiled by a test")
{
    const std::string source = LAGEN_SOURCE_DIR;
    const std::string programs = unindented(read_text(source + "/tests/consumer/app.cpp")) +
                                 unindented(read_text(source + "/tests/compile/programs/readme.cpp"));
    const std::vector<std::string> blocks = blocks_of(read_text(source + "/README.md"));
    CHECK(blocks.size() >= 2);
    for (const std::string& block : blocks) {
        INFO(block);
        CHECK(programs.find(block) != std::string::npos);
    }
}

TEST_CASE("README's stepper, dense solution and lambda do what it says")
{
    auto results = lines_by_key(run_on_headers("readme", {"models/heavy_top.toml"}, "", as_for_a_user));
    const std::vector<std::string>& stepping = results["readme stepping"];
    REQUIRE(stepping.size() == 4);
    CHECK(stepping[0] == "ok");
    CHECK(stepping[1] == "1");
    const std::vector<std::string>& dense = results["readme dense"];
    REQUIRE(dense.size() == 3);
    CHECK(dense[0] == "ok");
    CHECK(std::stod(dense[1]) < 1e-9);
    CHECK(std::abs(std::stod(dense[2]) - std::stod(stepping[3])) < 1e-9);
    const std::vector<std::string>& lambda = results["readme lambda"];
    REQUIRE(lambda.size() == 3);
    CHECK(lambda[0] == "ok");
    CHECK(std::stod(lambda[2]) < 1e-5);
    CHECK(std::abs(std::stod(lambda[1])) > 0.1);
}

TEST_CASE("a run without options is compiled without events, rows and dense output, from few headers")
{
    CHECK(run_on_headers("readme_1", {"models/heavy_top.toml"}, "", {.first = "", .programs = ""}) ==
          "top energy 5.966000 status ok\n");
    const std::string folder = std::string(LAGEN_BINARY_DIR) + "/compiled/";
    const std::string symbols = run_shell("nm -C '" + folder + "readme_1/program'").output;
    CHECK(symbols.find("lagen::detail::March<") != std::string::npos);
    for (const char* part : {"EventWatch", "locate_crossing", "rows_until", "::inside(", "::interpolate("}) {
        INFO(part);
        CHECK(symbols.find(part) == std::string::npos);
    }

    const std::string source = LAGEN_SOURCE_DIR;
    const Shell headers =
        run_shell("c++ -std=c++20 -M -I'" + source + "/runtime/include' " + "$(pkg-config --cflags eigen3) -x c++ '" +
                  source + "/runtime/include/lagen/integrate.hpp'");
    REQUIRE(headers.status == 0);
    CHECK(headers.output.find("Eigen/Core") != std::string::npos);
    for (const char* header : {"/immintrin.h", "/avx512fintrin.h", "/shared_ptr.h", "/iostream"}) {
        INFO(header);
        CHECK(headers.output.find(header) == std::string::npos);
    }
}
