// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen generate`: the same bytes always, whole files or none, and what the banner says.
#include "program.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

using namespace lagen::testing;

namespace {

std::string line_of(const std::string& text, int number)
{
    std::istringstream stream(text);
    std::string line;
    for (int k = 0; k < number; ++k) std::getline(stream, line);
    return line;
}

/// What fresh processes print, `processes` in all for each model (five at most for a header of a second or more), must
/// be the same bytes: from another folder, by another path, and with another size of environment and of arguments,
/// which moves stack and heap.
void check_fresh_processes(int processes)
{
    constexpr std::size_t long_header = 20'000;
    const std::string elsewhere = fresh_folder();
    for (const std::string& name : example_models()) {
        INFO(name);
        const std::string padding(997, 'x');
        const Outcome first = done({"generate", models_folder() + "/" + name + ".toml"},
                                   {.environment = {{"PADDING", padding}}, .folder = elsewhere});
        REQUIRE(first.out.size() > 4000);
        CHECK(first.err.empty());
        const int number = first.out.size() > long_header ? std::min(processes, 5) : processes;
        for (int k = 1; k < number; ++k) {
            std::string path = name + ".toml";
            for (int dots = 1; dots < k; ++dots) path = "./" + path;
            const std::string more(static_cast<std::size_t>(37 * k), 'x');
            REQUIRE(call({"generate", path}, {.environment = {{"PADDING", more}}}).out == first.out);
        }
    }
}

} // namespace

TEST_CASE("twenty fresh processes (five for a long header) write the same bytes, from any folder and by any path",
          "[all]")
{
    check_fresh_processes(20);
}

// Where and with what environment the committed headers were written nobody knows: equal bytes say that it changes
// nothing.
TEST_CASE("generated/ is what the models give today, from another folder and with a long environment", "[long]")
{
    const std::string elsewhere = fresh_folder();
    const Surroundings other{.environment = {{"PADDING", std::string(997, 'x')}}, .folder = elsewhere};
    for (const std::string& name : example_models()) {
        const std::string path = LAGEN_SOURCE_DIR "/generated/" + name + ".hpp";
        const std::string text = call({"generate", models_folder() + "/" + name + ".toml"}, other).out;
        if (std::getenv("LAGEN_UPDATE_GOLDEN") != nullptr) write_text(path, text);
        if (read_text(path) == text) continue;
        const std::string actual = fresh_folder() + "/" + name + ".hpp";
        write_text(actual, text);
        FAIL_CHECK(run_shell("diff -u '" + path + "' '" + actual + "'").output
                   << "`scripts/regenerate` accepts the new text");
    }
    std::vector<std::string> headers;
    for (const std::string& name : example_models()) headers.push_back(name + ".hpp");
    CHECK(names_in(LAGEN_SOURCE_DIR "/generated") == headers);
}

TEST_CASE("the hash and the command in the banner follow what the command line changed")
{
    const std::string plain = call({"generate", "pendulum.toml"}).out;
    CHECK(line_of(plain, 4) == "///   lagen generate pendulum.toml -o pendulum.hpp");
    const std::string changed =
        call({"generate", "pendulum.toml", "--set", "g=1/3", "--set", "l=2 * 3", "--only", "rhs,energy"}).out;
    CHECK(line_of(changed, 4) ==
          "///   lagen generate pendulum.toml --set g=1/3 --set 'l=2 * 3' --only rhs,energy -o pendulum.hpp");
    CHECK(line_of(changed, 3).substr(0, 40) != line_of(plain, 3).substr(0, 40));
    CHECK(changed.find("mass_matrix(") == std::string::npos);
    CHECK(changed.find("g = S(1) / S(3)") != std::string::npos);
    CHECK(call({"generate", "pendulum.toml", "--set", "g=1/3", "--set", "l=2 * 3", "--only", "rhs,energy"}).out ==
          changed);
}

TEST_CASE("the command in the banner names the header as it was asked for, without its folder")
{
    const std::string folder = fresh_folder();
    const auto command = [&](const std::string& output) {
        REQUIRE(call({"generate", models_folder() + "/pendulum.toml", "-o", output}, {.folder = folder}).code == 0);
        return line_of(read_text(output.starts_with('/') ? output : folder + "/" + output), 4);
    };
    CHECK(command("swing.hpp") == "///   lagen generate pendulum.toml -o swing.hpp");
    CHECK(command(folder + "/swing.hpp") == "///   lagen generate pendulum.toml -o swing.hpp");
    CHECK(command("./my head\n.h") == "///   lagen generate pendulum.toml -o 'my head .h'");
    CHECK(line_of(call({"generate", "pendulum.toml", "-o", "-"}).out, 4) ==
          "///   lagen generate pendulum.toml -o pendulum.hpp");
}

TEST_CASE("no setting can leave the comment that repeats it")
{
    const Outcome outcome = done({"generate", "pendulum.toml", "--set", "g=1\n+2"});
    CHECK(line_of(outcome.out, 4) == "///   lagen generate pendulum.toml --set 'g=1 +2' -o pendulum.hpp");
}

TEST_CASE("--format json holds the header and says what is in it")
{
    const lagen::json::Value value = lagen::json::parse(call({"generate", "kepler.toml", "--format", "json"}).out);
    CHECK(value["class"].text == "kepler");
    CHECK(value["header"].text == call({"generate", "kepler.toml"}).out);
    CHECK(value["kernels"][0]["name"].text == "rhs");
    CHECK(value["kernels"][0]["rows"].text == "4");
    CHECK(value["warnings"].size() == 0);
    CHECK(value["hash"].text.size() == 16);
}

TEST_CASE("--depfile names header and model as make reads them")
{
    const std::string folder = fresh_folder();
    std::filesystem::copy_file(models_folder() + "/pendulum.toml", folder + "/my $model.toml");
    // The name is no identifier, so the model needs one of its own.
    write_text(folder + "/my $model.toml", "name = \"swing\"\n" + read_text(folder + "/my $model.toml"));
    const Outcome outcome =
        call({"generate", "my $model.toml", "-o", "a#b.hpp", "--depfile", "a.d"}, {.folder = folder});
    CHECK(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(read_text(folder + "/a.d") == "a\\#b.hpp: my\\ $$model.toml\n");
    CHECK(names_in(folder) == std::vector<std::string>{"a#b.hpp", "a.d", "my $model.toml"});
}

TEST_CASE("a refused model leaves the header that was there, and no other file")
{
    const std::string folder = fresh_folder();
    write_text(folder + "/old.hpp", "old\n");
    for (const auto& [model, code] : {std::pair("refuted", 1), std::pair("degenerate", 1), std::pair("nope", 3)}) {
        const Outcome outcome = call({"generate", models_folder() + "/" + model + ".toml", "-o", folder + "/old.hpp"});
        CHECK(outcome.code == code);
        CHECK(outcome.out.empty());
        CHECK_FALSE(outcome.err.empty());
    }
    CHECK(read_text(folder + "/old.hpp") == "old\n");
    CHECK(names_in(folder) == std::vector<std::string>{"old.hpp"});
}

TEST_CASE("an output that is a link stays a link and its file gets the header")
{
    const std::string folder = fresh_folder();
    std::filesystem::create_directory(folder + "/real");
    write_text(folder + "/real/top.hpp", "old\n");
    std::filesystem::create_symlink("real/top.hpp", folder + "/heavy_top.hpp");
    REQUIRE(call({"generate", models_folder() + "/heavy_top.toml", "-o", "heavy_top.hpp"}, {.folder = folder}).code ==
            0);
    CHECK(std::filesystem::is_symlink(folder + "/heavy_top.hpp"));
    CHECK(read_text(folder + "/real/top.hpp") == call({"generate", "heavy_top.toml"}).out);
    CHECK(names_in(folder + "/real") == std::vector<std::string>{"top.hpp"});
}

TEST_CASE("a refuted model is refused with its reason; --unchecked goes on and the header says so")
{
    const Outcome refused = call({"generate", "refuted.toml"});
    CHECK(refused.code == 1);
    CHECK(refused.err == "error: model 'refuted' is refuted: anchor (u, v, y), residual 1\n"
                         "hint: see `lagen check refuted.toml`; --unchecked goes on all the same\n");
    const Outcome forced = call({"generate", "refuted.toml", "--unchecked"});
    CHECK(forced.code == 0);
    const std::string said = "this model is REFUTED: anchor (u, v, y), residual 1";
    CHECK(forced.err == "warning: " + said + "\n");
    CHECK(forced.out.find("/// WARNING: " + said + "\n") != std::string::npos);
    CHECK(line_of(forced.out, 4) == "///   lagen generate refuted.toml --unchecked -o refuted.hpp");
}

TEST_CASE("equations that nobody could read are left out of the header, which has its kernels all the same")
{
    const Outcome outcome = call({"generate", "large_inverse.toml"});
    CHECK(outcome.code == 0);
    CHECK(
        outcome.out.find("///   The equations are not written out here: the solution of 6 coupled linear equations is "
                         "not written out: a formula that a person could read exists up to 4.\n") != std::string::npos);
    CHECK(outcome.out.find("rhs(") != std::string::npos);
}

TEST_CASE("an undecided model is generated with a warning, and exits 0")
{
    const Outcome outcome = call({"generate", "undecided.toml"});
    CHECK(outcome.code == 0);
    CHECK_THAT(outcome.err, Catch::StartsWith("warning: this model is not proved: invariant (identity), residual "));
    CHECK(outcome.out.find("/// WARNING: this model is not proved: invariant (identity), residual ") !=
          std::string::npos);
}

TEST_CASE("a degenerate Lagrangian is refused in Lagrange form")
{
    for (const char* command : {"generate", "run"}) {
        const Outcome outcome = call({command, "degenerate.toml"});
        CHECK(outcome.code == 1);
        CHECK(outcome.out.empty());
        CHECK(outcome.err ==
              "error: the Lagrangian of model 'degenerate' is degenerate: d2L/dy2 has rank 0, and the "
              "Lagrangian form needs rank 1\n"
              "hint: L is linear in the velocities, so its equations are of first order: solve them for x' = "
              "X(t, x) and run [hamiltonian] H = \"p.X\" in the place of L (docs/mechanics.md, Any "
              "first-order system)\n");
    }
}

TEST_CASE("an unknown kernel is answered with the nearest one")
{
    const Outcome outcome = call({"generate", "pendulum.toml", "--only", "rsh"});
    CHECK(outcome.code == 4);
    CHECK_THAT(outcome.err, Catch::EndsWith("hint: did you mean 'rhs'?\n"));
}

TEST_CASE("the help of generate lists the kernels, and one that the form does not have is answered with its own")
{
    std::string help = call({"generate", "--help"}).out;
    help.erase(std::unique(help.begin(), help.end(), [](char a, char b) { return a == ' ' && b == ' '; }), help.end());
    std::ranges::replace(help, '\n', ' ');
    help.erase(std::unique(help.begin(), help.end(), [](char a, char b) { return a == ' ' && b == ' '; }), help.end());
    CHECK(
        help.find("these kernels alone, e.g. rhs,energy; there are rhs, jacobian, input_jacobian, variational, taylor, "
                  "event_series, domain_series, flows, mass_matrix, momentum, inverse_dynamics, velocity, controls, "
                  "energy, power, hamiltonian, "
                  "lagrangian, ambient_velocity, reaction, moving_energy, cost, "
                  "constraints, casimirs, domain, "
                  "observables, invariants, lagrangian_hessian, hamiltonian_hessian, step, forward, "
                  "arrow_equation, explicit_step, cayley_step, cayley_coordinates, algebra_matrix, in_algebra, "
                  "element, algebra_element, "
                  "algebra_action, algebra_bracket, events, jumps (a "
                  "model has some of "
                  "them)") != std::string::npos);
    const Outcome outcome = call({"generate", "pendulum.toml", "--only", "rhs,controls"});
    CHECK(outcome.code == 4);
    CHECK(outcome.out.empty());
    CHECK(outcome.err ==
          "error: the lagrange form of model 'pendulum' has no kernel 'controls'; it has rhs, mass_matrix, momentum, "
          "energy, lagrangian, observables, events, jacobian, variational, taylor, event_series, "
          "lagrangian_hessian\n");
}

TEST_CASE("--report prints the operations of each kernel as written and as kept, and does not change the header",
          "[long]")
{
    const Outcome plain = call({"generate", "double_pendulum.toml"});
    const Outcome summary = call({"generate", "--report", "double_pendulum.toml"});
    CHECK(plain.err.empty());
    CHECK(summary.out == plain.out);
    CHECK_THAT(summary.err, Catch::StartsWith("operations ") && Catch::Contains("\nmass_matrix, as written ") &&
                                Catch::Contains("\n  kept ") && Catch::Contains("\n    weighs ") &&
                                Catch::Contains("\nobservables, kept as written "));
}
