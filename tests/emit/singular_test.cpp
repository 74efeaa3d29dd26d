// SPDX-License-Identifier: GPL-2.0-or-later
#include "../support/golden.hpp"
#include "emit/print_header.hpp"
#include "hand_built.hpp"

#include <filesystem>

using namespace lagen;
using namespace lagen::testing;

namespace {

/// Compiles `program` next to the headers of three solve modules and gives what it prints.
std::string output_of(const std::string& program)
{
    const std::string where = std::string(LAGEN_BINARY_DIR) + "/compiled/singular";
    std::filesystem::create_directories(where);
    const std::vector<std::vector<bool>> full(3, std::vector<bool>(3, true));
    const std::vector<std::vector<bool>> two(2, std::vector<bool>(2, true));
    write_text(where + "/ldlt.hpp", print_header(solve_module("ldlt", full, MatrixStructure::positive_definite)));
    write_text(where + "/pivoted.hpp", print_header(solve_module("pivoted", full, MatrixStructure::symmetric)));
    write_text(where + "/closed.hpp", print_header(solve_module("closed", two, MatrixStructure::symmetric)));
    write_text(where + "/main.cpp", program);
    const Shell build =
        run_shell("g++ -std=c++20 -O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I" + where +
                  " -I" LAGEN_SOURCE_DIR "/runtime/include $(pkg-config --cflags eigen3 | sed s/-I/-isystem/) '" +
                  where + "/main.cpp' -o '" + where + "/main'");
    INFO(build.output);
    REQUIRE(build.status == 0);
    return run_shell("'" + where + "/main'").output;
}

const char* const singular_program = R"(#include "closed.hpp"
#include "ldlt.hpp"
#include "pivoted.hpp"

#include "lagen/lanes/pack.hpp"

#include <cmath>
#include <cstdio>

using namespace lagen;

/// Status and error of the solution for the right-hand side A (1, .., 1), with rows and columns scaled by d.
template <class M>
void solve(const char* name, typename M::State s, const double* d)
{
    constexpr int n = M::fibre_dimension;
    double a[n][n];
    int lane = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) a[i][j] = a[j][i] = s[lane++];
    lane = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j) s[lane++] *= d[i] * d[j];
    for (int i = 0; i < n; ++i) {
        s[lane + i] = 0;
        for (int j = 0; j < n; ++j) s[lane + i] += a[i][j] * d[i];
    }
    typename M::State ds;
    const Status status = M().rhs(0, s, ds);
    double error = 0;
    for (int i = 0; i < n; ++i) error = std::fmax(error, std::fabs(ds[lane + i] * d[i] - 1));
    std::printf("%s %s%s\n", name, to_text(status), status == Status::ok ? error < 1e-12 ? " accurate" : " WRONG" : "");
}

template <class M>
void everything(const char* name)
{
    typename M::State good, bad;
    good << 4, 1, 5, 2, 1, 6, 0, 0, 0;
    bad << 4, 2, 1, 6, 3, 9, 0, 0, 0; // a multiple of (4, 2, 6) in every row
    const double plain[] = {1, 1, 1}, large[] = {1e75, 1e75, 1e75}, small[] = {1e-75, 1e-75, 1e-75}, mixed[] = {1e-60, 1, 1e75};
    for (const double* d : {plain, large, small, mixed}) solve<M>(name, good, d);
    for (const double* d : {plain, large, small, mixed}) solve<M>(name, bad, d);
}

int main()
{
    everything<models::ldlt<double>>("ldlt");
    everything<models::pivoted<double>>("pivoted");
    using Closed = models::closed<double>;
    Closed::State s;
    const double plain[] = {1, 1, 1}, large[] = {1e75, 1e75}, small[] = {1e-75, 1e-75}, mixed[] = {1e-75, 1e75};
    for (const double* d : {plain, large, small, mixed}) {
        s << 0, 1, 0, 0, 0; // regular, first pivot 0
        solve<Closed>("closed", s, d);
        s << 0.1, 0.3, 0.9, 0, 0; // singular up to rounding
        solve<Closed>("closed", s, d);
    }
    models::pivoted<double>::State indefinite;
    indefinite << 0, 1, 0, 2, 3, 0, 0, 0, 0;
    solve<models::pivoted<double>>("indefinite", indefinite, plain);

    using Lanes = Pack<double, 4>; // lane 2 alone is singular; lane 1 needs an exchange of rows
    models::pivoted<Lanes>::State p, dp;
    const double a[4][6] = {{4, 1, 5, 2, 1, 6}, {0, 1, 0, 2, 3, 0}, {4, 2, 1, 6, 3, 9}, {2, 0, 2, 0, 0, 2}};
    for (int k = 0; k < 6; ++k)
        for (int lane = 0; lane < 4; ++lane) p[k].set(lane, a[lane][k]);
    for (int k = 6; k < 9; ++k) p[k] = Lanes(1.0);
    const auto status = models::pivoted<Lanes>().rhs(Lanes(0.0), p, dp);
    for (int lane = 0; lane < 4; ++lane) std::printf("lane %s %.3f\n", to_text(status[lane]), lane == 2 ? 0.0 : dp[7][lane]);
}
)";

} // namespace

TEST_CASE("singular matrices answer a status at every scale and regular ones are solved", "[emit][compile]")
{
    const std::string good = " ok accurate\n";
    const std::string bad = " singular_mass_matrix\n";
    std::string expected;
    for (const std::string name : {"ldlt", "pivoted"}) {
        for (int k = 0; k < 4; ++k) expected += name + good;
        for (int k = 0; k < 4; ++k) expected += name + bad;
    }
    for (int k = 0; k < 4; ++k) expected += "closed" + good + "closed" + bad;
    expected += "indefinite" + good;
    expected += "lane ok 0.149\nlane ok 0.333\nlane singular_mass_matrix 0.000\nlane ok 0.500\n";
    CHECK(output_of(singular_program) == expected);
}
