// SPDX-License-Identifier: GPL-2.0-or-later
/// What does not compile says why: implicit methods without a Jacobian and with packs.
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <unistd.h>

using namespace lagen::testing;

namespace {

/// The lines of a compiler's output that say that a static assertion failed, with `reason`.
std::size_t refusals(const std::string& output, const std::string& reason)
{
    std::istringstream lines(output);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);)
        if (line.find("error: static assertion failed") != std::string::npos && line.find(reason) != std::string::npos)
            ++count;
    return count;
}

} // namespace

TEST_CASE("Implicit methods refuse a model without a Jacobian, and packs, in a sentence that says what to do")
{
    const auto file =
        std::filesystem::temp_directory_path() / ("lagen_refused_types_" + std::to_string(getpid()) + ".cpp");
    write_text(file.string(), R"(#include "lagen/lagen.hpp"
template <class S>
struct Decay {
    using Scalar = S;
    using State = Eigen::Matrix<S, 1, 1>;
    static constexpr int dimension = 1;
    lagen::status_t<S> rhs(S, const State& s, State& ds) const noexcept
    {
        ds = -s;
        return lagen::StatusOf<S>::good();
    }
};
template <class S>
struct Known : Decay<S> {
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(S, const typename Decay<S>::State&, std::array<S, 1>& values) const noexcept
    {
        values = {S(-1.0)};
    }
};
template <class Model, class Method>
using Try = typename Method::template Stepper<Model>;
int main()
{
    (void)sizeof(Try<Decay<double>, lagen::Gauss6>);
    (void)sizeof(Try<Decay<double>, lagen::Radau5>);
    (void)sizeof(Try<Known<lagen::Pack<double, 4>>, lagen::Gauss4>);
    (void)sizeof(Try<Known<lagen::Pack<double, 4>>, lagen::Radau5>);
    (void)sizeof(Try<Known<double>, lagen::Gauss8>); // this one is fine
}
)");
    const Shell shell =
        run_shell("c++ -std=c++20 -fsyntax-only -I" LAGEN_SOURCE_DIR "/runtime/include $(pkg-config --cflags eigen3) " +
                  file.string());
    std::filesystem::remove(file);
    INFO(shell.output);
    CHECK(shell.status != 0);
    CHECK(refusals(shell.output,
                   "implicit methods need the exact Jacobian of the right-hand side: jacobian_values(t, s, "
                   "values) with jacobian_rows and jacobian_columns") == 2);
    CHECK(refusals(shell.output, "implicit methods iterate until one trajectory has converged: use them with a scalar, "
                                 "and packs with explicit fixed-step methods") == 2);
    CHECK(refusals(shell.output, "") == 4);
}
