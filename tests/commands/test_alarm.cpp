// SPDX-License-Identifier: GPL-2.0-or-later
/// An InternalError that is thrown anywhere inside a decision ends the command; it is never taken for an outcome.
#include "program.hpp"

#include "support/golden.hpp"

#include <catch2/catch.hpp>

using namespace lagen::testing;

namespace {

/// Models that ask for much: regularity for the file's parameters, slices, factors, kernel vectors, Legendre's
/// transform, controls, repair.
std::vector<std::string> demanding_models(const std::string& folder)
{
    const std::string plane =
        "[base]\ncoordinates = [\"x\", \"y\"]\n[fibre]\ncoordinates = [\"u\", \"v\"]\n[algebroid]\n"
        "kind = \"tangent\"\n[lagrangian]\nL = ";
    const std::vector<std::pair<std::string, std::string>> models{
        {"values.toml", "[parameters]\nc = 2\n" + plane + "\"(u^2 + (c - x^2)^2*v^2)/2 - 1/(1 + x^2)\"\n"},
        {"degenerate.toml", plane + "\"(u*cos(x) - v*sin(y))^2/2\"\n"},
        {"convex.toml", "[parameters]\nc = 1\n" + plane + "\"u^2/2 + v^2/2 + c*(u^2 + v^2)^2/4\"\n"},
        {"refuted.toml", plane + "\"(u^2 + v^2)/2\"\n[invariants]\nx = \"x*v\"\n"}};
    std::vector<std::string> paths;
    for (const auto& [name, text] : models) {
        paths.push_back(folder + "/" + name);
        write_text(paths.back(), text);
    }
    for (const char* name : {"pendulum.toml", "half_plane_control.toml"}) paths.push_back(models_folder() + "/" + name);
    return paths;
}

} // namespace

TEST_CASE("an internal error inside a decision ends the command with exit code 5, and nothing is claimed", "[long]")
{
    const std::string folder = fresh_folder();
    std::size_t alarms = 0;
    for (const std::string& model : demanding_models(folder))
        for (const char* question : {"decide", "status", "nonzero", "positive", "nonnegative"})
            for (int call_number = 1; call_number <= 400; call_number += call_number < 12 ? 1 : 29) {
                const std::string alarm = std::string(question) + " " + std::to_string(call_number);
                const Outcome outcome =
                    call({"check", model}, {.environment = {{"LAGEN_ALARM", alarm}}, .program = LAGEN_ALARMED});
                INFO(model << ": " << alarm << "\n" << outcome.out << outcome.err);
                if (outcome.code != 5) { // so many questions were not asked
                    CHECK(outcome.err.find("internal error") == std::string::npos);
                    CHECK(outcome == call({"check", model}));
                    break;
                }
                ++alarms;
                CHECK(outcome.out.empty());
                CHECK_THAT(outcome.err, Catch::StartsWith("internal error: the alarm of a test\n"));
            }
    CHECK(alarms > 50);
}
