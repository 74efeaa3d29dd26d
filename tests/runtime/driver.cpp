// SPDX-License-Identifier: GPL-2.0-or-later
/// The program behind `lagen run`: arguments, rows, report, exit codes.
#include "lagen_run/driver.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <unistd.h>

using namespace lagen;

namespace {

/// A model with every optional part.
struct Full : problems::Pendulum<double> {
    static constexpr std::array<const char*, 1> parameter_names{"k"};
    static constexpr std::array<const char*, 2> observables_names{"double", "k"};
    static constexpr std::array<const char*, 1> invariants_names{"zero"}, constraints_names{"x"};
    double k = 1;
    double& parameter(std::size_t) noexcept { return k; }
    Eigen::Vector2d observables(double, const State& s) const noexcept { return {2 * s[0], k}; }
    Eigen::Matrix<double, 1, 1> invariants(double t, const State&) const noexcept
    {
        return Eigen::Matrix<double, 1, 1>(t);
    }
    Eigen::Matrix<double, 1, 1> constraints(double, const State& s) const noexcept
    {
        return Eigen::Matrix<double, 1, 1>(s[0]);
    }
};

/// A model with the right-hand side alone: x' = 1.
struct Bare {
    using Scalar = double;
    using State = Eigen::Matrix<double, 1, 1>;
    static constexpr int dimension = 1;
    Status rhs(double, const State&, State& ds) const noexcept
    {
        ds[0] = 1;
        return Status::ok;
    }
};

/// Finds no memory for what it observes.
struct Greedy : Full {
    Eigen::Vector2d observables(double, const State&) const { throw std::bad_alloc(); }
};

struct WithJacobian : Bare {
    static constexpr std::array<int, 1> jacobian_rows{0}, jacobian_columns{0};
    void jacobian_values(double, const State&, std::array<double, 1>& values) const noexcept { values = {0}; }
};

std::string slurp(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

struct Outcome {
    int code;
    std::string out, err, report;
};

/// Runs the program in this process with its streams in files; a report goes to a file where one is wanted.
template <class M, class Method>
Outcome drive_with(std::vector<std::string> arguments)
{
    const auto folder = std::filesystem::temp_directory_path() / ("lagen_driver_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    arguments.insert(arguments.begin(), {"run", "--report", (folder / "report").string()});
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    const auto redirect = [](std::FILE* stream, const std::filesystem::path& path) {
        std::fflush(stream);
        const int kept = dup(fileno(stream));
        std::FILE* file = std::fopen(path.c_str(), "w");
        dup2(fileno(file), fileno(stream));
        std::fclose(file);
        return kept;
    };
    const auto restore = [](std::FILE* stream, int kept) {
        std::fflush(stream);
        dup2(kept, fileno(stream));
        close(kept);
    };
    const int out = redirect(stdout, folder / "out"), err = redirect(stderr, folder / "err");
    const int code = drive<M, Method>(static_cast<int>(pointers.size()), pointers.data());
    restore(stdout, out);
    restore(stderr, err);
    Outcome outcome{code, slurp(folder / "out"), slurp(folder / "err"), slurp(folder / "report")};
    std::filesystem::remove_all(folder);
    return outcome;
}

/// The report without the line of the clock.
std::string without_seconds(const std::string& report)
{
    const std::size_t begin = report.find("seconds="), end = report.find('\n', begin);
    return report.substr(0, begin) + report.substr(end + 1);
}

} // namespace

TEST_CASE("The driver writes rows and a report")
{
    const auto run = drive_with<Bare, Rk4>({"--initial", "0x1p-1", "--end", "1", "--step", "0.25", "--samples", "3"});
    CHECK(run.code == 0);
    CHECK(run.out == "0,0.5\n0.5,1\n1,1.5\n");
    CHECK(without_seconds(run.report) ==
          "status=ok\nt=1\nfailed_at=1\nsteps=4\nrejected=0\nrhs_calls=16\nrows=3\nstate=1.5\n");
}

TEST_CASE("Numbers of rows and report are the shortest that read back, and what a run throws is a sentence")
{
    const auto run = drive_with<Bare, Rk4>({"--initial", "0.1", "--end", "0.3", "--step", "0.3", "--samples", "2"});
    CHECK(run.out == "0,0.1\n0.3,0.4\n");
    const auto greedy = drive_with<Greedy, Rk4>(
        {"--initial", "0.5,0", "--end", "1", "--step", "0.25", "--columns", "o0", "--samples", "3"});
    CHECK(greedy.code == 5);
    CHECK(greedy.err == "error: the scene cannot be integrated: std::bad_alloc\n");
}

TEST_CASE("The report of an implicit method says what its calls were spent on")
{
    // Two Newton iterations for the first step, one to confirm the prediction of each other one.
    const auto run =
        drive_with<WithJacobian, Gauss2>({"--initial", "0.5", "--end", "1", "--step", "0.25", "--samples", "3"});
    CHECK(run.code == 0);
    CHECK(without_seconds(run.report) == "status=ok\nt=1\nfailed_at=1\nsteps=4\nrejected=0\nrhs_calls=5\nnewton=5\n"
                                         "decompositions=4\nrows=3\nstate=1.5\n");
}

TEST_CASE("The driver reports events, energy, invariants and constraints, and picks columns")
{
    const auto run = drive_with<Full, Dop853>({"--initial", "0.5,0", "--parameters", "3", "--end", "4", "--interval",
                                               "1.5", "--relative", "1e-12", "--absolute", "1e-12", "--columns",
                                               "o1,s0,o0", "--events", "bottom:falling:0:1,turn:rising:1:1"});
    CHECK(run.code == 0);
    CHECK(run.out.starts_with("0,3,0.5,1\n1.5,3,"));
    // Rows at 0, 1.5 and 3, and one more at the event.
    CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 4);
    CHECK(run.out.find("\n3.19") != std::string::npos);
    CHECK(run.report.find("\nrows=4\n") != std::string::npos);
    CHECK(run.report.starts_with("status=stopped_by_event\nt=3.19"));
    CHECK(run.report.find("\nevent=bottom@1.59") != std::string::npos);
    CHECK(run.report.find("\nevent=turn@3.19") != std::string::npos);
    CHECK(run.report.find("\nenergy=-0.877582561890372") != std::string::npos);
    CHECK(run.report.find("\ninvariant:zero=0,3.19") != std::string::npos);
    CHECK(run.report.find("\nconstraint:x=0.5,0.5") != std::string::npos);
}

TEST_CASE("Binary rows are native doubles")
{
    const auto run = drive_with<Bare, Euler>(
        {"--initial", "1", "--start", "2", "--end", "1", "--step", "0.5", "--samples", "2", "--format", "binary"});
    REQUIRE(run.out.size() == 4 * sizeof(double));
    std::array<double, 4> values{};
    std::memcpy(values.data(), run.out.data(), run.out.size());
    CHECK(values == std::array<double, 4>{2, 1, 1, 0});
}

TEST_CASE("A run that cannot go on keeps its rows and exits 1")
{
    const auto run = drive_with<Full, Rk4>({"--initial", "1,0", "--end", "10", "--step", "0.5", "--max-steps", "4"});
    CHECK(run.code == 1);
    CHECK(run.report.starts_with("status=too_many_steps\nt=2\n"));
    CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 41);
}

TEST_CASE("Wrong arguments are named in one sentence and exit 4")
{
    const auto complaint = [](std::vector<std::string> arguments) {
        const auto run = drive_with<Full, Rk4>(std::move(arguments));
        CHECK(run.code == 4);
        CHECK(run.out.empty());
        CHECK(run.report.empty());
        return run.err;
    };
    CHECK(complaint({"--initial", "1", "--end", "1", "--step", "1"}) ==
          "error: --initial: 1 numbers, 2 are required\n");
    CHECK(complaint({"--initial", "1,x"}) == "error: --initial: \"x\" is not a finite number\n");
    CHECK(complaint({"--initial", "1,nan"}) == "error: --initial: \"nan\" is not a finite number\n");
    CHECK(complaint({"--initial", "1,2"}) == "error: --end is required\n");
    CHECK(complaint({"--initial", "1,2", "--end", "1"}) ==
          "error: --step: a positive step is required by this method\n");
    CHECK(complaint({"--speed", "1"}) == "error: unknown argument \"--speed\"\n");
    CHECK(complaint({"--end"}) == "error: --end: a value is required\n");
    CHECK(complaint({"--initial", "1,2", "--end", "1", "--step", "1", "--columns", "s2"}) ==
          "error: --columns: \"s2\" is neither a state lane nor an observable of the model\n");
    CHECK(complaint({"--initial", "1,2", "--end", "1", "--step", "1", "--events", "top:any:0:1"}) ==
          "error: --events: \"top:any:0:1\" is not name:direction:stop:count with an event of the model\n");
    CHECK(complaint({"--initial", "1,2", "--end", "1", "--step", "1", "--interval", "1e-300"}) ==
          "error: --interval: 1e-300 makes more than 1e8 rows\n");
}

TEST_CASE("A file of times that is not there exits 5")
{
    const auto run =
        drive_with<Bare, Rk4>({"--initial", "1", "--end", "1", "--step", "1", "--at-file", "/nowhere/times"});
    CHECK(run.code == 5);
    CHECK(run.err == "error: --at-file: \"/nowhere/times\" could not be opened\n");
}

TEST_CASE("The row of a stopping event is at its time exactly, once, and only where an event stops the run")
{
    const auto value_of = [](const std::string& report, const std::string& key) {
        const std::size_t begin = report.find("\n" + key + "=") + key.size() + 2;
        return report.substr(begin, report.find('\n', begin) - begin);
    };
    const std::vector<std::string> arguments{"--initial", "0.5,0",    "--parameters",  "3", "--end", "9", "--samples",
                                             "4",         "--events", "bottom:any:1:1"};
    const auto run = drive_with<Full, Dop853>(arguments);
    const std::string time = value_of(run.report, "t");
    CHECK(run.out.ends_with('\n' + time + ',' + value_of(run.report, "state") + '\n'));
    const std::string event = value_of(run.report, "event"), head = "bottom@" + time + "@";
    REQUIRE(event.starts_with(head));
    CHECK(std::abs(std::stod(event.substr(head.size()))) < 1e-15);
    auto backward = arguments;
    backward[5] = "-9";
    const auto mirrored = drive_with<Full, Dop853>(backward);
    CHECK(value_of(mirrored.report, "t") == '-' + time);
    CHECK(mirrored.out.find("\n-" + time + ',') != std::string::npos);
    auto passed = arguments;
    passed.back() = "bottom:any:0:1";
    CHECK(drive_with<Full, Dop853>(passed).report.find("\nrows=4\n") != std::string::npos);
}

TEST_CASE("Times of a file must run with the run; those outside the interval are left out, equal ones repeated")
{
    const auto folder = std::filesystem::temp_directory_path() / ("lagen_times_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::string file = (folder / "times").string();
    const auto rows = [&](const std::string& times, const std::string& end) {
        std::ofstream(file) << times;
        return drive_with<Bare, Rk4>({"--initial", "1", "--end", end, "--step", "0.25", "--at-file", file});
    };
    CHECK(rows("-1, 0, 0.5 0.5\n2", "1").out == "0,1\n0.5,1.5\n0.5,1.5\n");
    CHECK(rows("1 0 -0.5 -2", "-1").out == "0,1\n-0.5,0.5\n");
    const auto wrong = rows("0 0.5 0.25", "1");
    CHECK(wrong.code == 4);
    CHECK(wrong.err == "error: --at-file: 0.25 stands after 0.5, times in the direction of the run are required\n");
    CHECK(rows("0 nan", "1").err == "error: --at-file: \"" + file + "\" holds something that is not a finite number\n");
    std::filesystem::remove_all(folder);
}
