// SPDX-License-Identifier: GPL-2.0-or-later
/// The program behind `lagen sweep`: numbers in, lines out.
#include "lagen_sweep/driver.hpp"
#include "runtime/pendulum.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <new>
#include <sstream>
#include <unistd.h>

using namespace lagen;

namespace {

using Pendulum = problems::Pendulum<double>;
namespace fs = std::filesystem;

struct Answer {
    int code;
    std::string out, err;
};

std::string content(const fs::path& path)
{
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

/// Finds no memory for what it observes.
struct Greedy : Pendulum {
    static constexpr std::array<const char*, 1> observables_names{"much"};
    Eigen::Matrix<double, 1, 1> observables(double, const State&) const { throw std::bad_alloc(); }
};

/// Runs the program in this process with its streams in files.
template <class Method, class M = Pendulum>
Answer sweep_with(const detail::SweepJob& job, const std::vector<double>& numbers, std::size_t cut = 0)
{
    const fs::path folder = fs::temp_directory_path() / ("lagen_sweep_test_" + std::to_string(getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "in", std::ios::binary)
        << detail::packed(detail::packed(job))
        << std::string_view(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double) - cut);
    const auto redirect = [&](std::FILE* stream, const char* name, const char* mode) {
        std::fflush(stream);
        const int kept = dup(fileno(stream));
        std::FILE* file = std::fopen((folder / name).c_str(), mode);
        dup2(fileno(file), fileno(stream));
        std::fclose(file);
        return kept;
    };
    const auto restore = [](std::FILE* stream, int kept) {
        std::fflush(stream);
        dup2(kept, fileno(stream));
        close(kept);
        std::clearerr(stream);
    };
    const int in = redirect(stdin, "in", "r"), out = redirect(stdout, "out", "w"), err = redirect(stderr, "err", "w");
    const int code = sweep<M, Method>(0, nullptr);
    restore(stdin, in);
    restore(stdout, out);
    restore(stderr, err);
    const Answer answer{code, content(folder / "out"), content(folder / "err")};
    fs::remove_all(folder);
    return answer;
}

detail::SweepJob job_of(std::size_t threads, std::vector<detail::DriveColumn> columns)
{
    detail::SweepJob job;
    job.threads = threads;
    job.run.columns = std::move(columns);
    return job;
}

/// A trajectory from (th, w) to `end` with steps of 1/64.
std::vector<double> start(double th, double w, double end, double step = 1.0 / 64)
{
    return {0, th, w, 0, end, step, 0, 0, 0};
}

std::vector<double> joined(const std::vector<std::vector<double>>& starts)
{
    std::vector<double> all;
    for (const std::vector<double>& each : starts) all.insert(all.end(), each.begin(), each.end());
    return all;
}

} // namespace

TEST_CASE("The program of a sweep writes the end, events and extremes of each trajectory in order")
{
    const auto numbers = joined({start(1, 0, 0), {3, 0, 0, 0, 0, 0, 0, 0, 0}, start(1, 0, 2), start(1, 0, 2, -1)});
    for (const std::size_t threads : {1U, 3U}) {
        detail::SweepJob job = job_of(threads, {{false, 0}, {false, 1}});
        job.run.events = {{"bottom", 0, false, 1}};
        const Answer answer = sweep_with<Rk4>(job, numbers);
        CHECK(answer.code == 0);
        std::istringstream lines(answer.out);
        std::string first, failed, third, wrong;
        std::getline(lines, first);
        std::getline(lines, failed);
        std::getline(lines, third);
        std::getline(lines, wrong);
        CHECK(first == "0,1,0,0,,1,1,0,0,ok");
        CHECK(failed == "#3");
        const auto run = integrate(Pendulum{}, {1, 0}, {0, 2}, Rk4{.step = 1.0 / 64});
        double values[10];
        char status[16];
        REQUIRE(std::sscanf(third.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%15s", &values[0], &values[1],
                            &values[2], &values[3], &values[4], &values[5], &values[6], &values[7], &values[8],
                            status) == 10);
        CHECK(values[0] == 2);
        CHECK(values[1] == run.state[0]);
        CHECK(values[2] == run.state[1]);
        CHECK(values[3] == 1);
        CHECK((values[4] > 1.5 && values[4] < 2)); // a quarter of the period, 1.67 for an amplitude of 1
        CHECK(values[5] == run.state[0]);
        CHECK(values[6] == 1);
        CHECK(values[7] < -0.95); // -2 sin(1/2) = -0.9589 at the bottom
        CHECK(values[8] == 0);
        CHECK(std::string(status) == "ok");
        CHECK(wrong == ",,,0,,,,,,invalid_input");
    }
}

TEST_CASE("What a trajectory throws ends the program of a sweep with a sentence, whatever the number of threads")
{
    for (const std::size_t threads : {1U, 3U}) {
        const Answer answer = sweep_with<Rk4, Greedy>(job_of(threads, {{true, 0}}),
                                                      joined({start(1, 0, 1), start(1, 0, 2), start(1, 0, 3)}));
        CHECK(answer.code == 5);
        CHECK(answer.out.empty());
        CHECK(answer.err == "error: the trajectories cannot be integrated: std::bad_alloc\n");
    }
}

TEST_CASE("A program of a sweep whose numbers end early, or whose job is another model's, says so")
{
    const Answer cut = sweep_with<Rk4>(job_of(0, {}), joined({start(1, 0, 1), start(1, 0, 2)}), 8);
    CHECK(cut.code == 5);
    CHECK(cut.out == "1,ok\n");
    CHECK(cut.err == "error: the trajectories could not be read or written to their end\n");
    const Answer other = sweep_with<Rk4>(job_of(0, {{false, 7}}), {0});
    CHECK(other.code == 4);
    CHECK(other.err == "error: a job for this model is required\n");
}
