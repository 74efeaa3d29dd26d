// SPDX-License-Identifier: GPL-2.0-or-later
/// A run of a scene by its job: rows and report; and the program of one model: files and exit codes.
#include "lagen_run/driver.hpp"
#include "support/problems.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <span>
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

/// A run in this process: rows, and the report.
struct Ran {
    bool fits = false;
    std::vector<std::vector<double>> rows;
    detail::RunReport report;
};

template <class M, class Method>
Ran ran(const detail::RunJob& job)
{
    Ran result;
    detail::RunPlan<M> plan;
    Method method{};
    result.fits = detail::make_plan(job, plan, method);
    if (!result.fits) return result;
    const auto take = [&](std::span<const double> row) { result.rows.emplace_back(row.begin(), row.end()); };
    result.report = detail::run_plan(plan, method, job, take, nullptr);
    return result;
}

/// A run from 0 to `end` with so many rows.
detail::RunJob job_from(std::vector<double> initial, double end, double step, std::size_t rows)
{
    detail::RunJob job;
    for (std::size_t k = 0; k < initial.size(); ++k) job.columns.push_back({false, k});
    job.initial = std::move(initial);
    job.end = end;
    job.step = step;
    job.rows.count = rows;
    return job;
}

/// A run of the pendulum with an event.
detail::RunJob swing(double end, const std::string& event, int direction, bool stop)
{
    detail::RunJob job = job_from({0.5, 0}, end, 0, 4);
    job.parameters = {3};
    job.relative = job.absolute = 1e-12;
    job.events = {{event, direction, stop, 1}};
    return job;
}

using Rows = std::vector<std::vector<double>>;

} // namespace

TEST_CASE("A run gives rows and a report")
{
    const Ran run = ran<Bare, Rk4>(job_from({0.5}, 1, 0.25, 3));
    CHECK(run.rows == Rows{{0, 0.5}, {0.5, 1}, {1, 1.5}});
    CHECK(run.report.status == "ok");
    CHECK(run.report.t == 1);
    CHECK(run.report.failed_at == 1);
    CHECK(run.report.steps == 4);
    CHECK(run.report.rejected == 0);
    CHECK(run.report.rhs_calls == 16);
    CHECK(run.report.newton == 0);
    CHECK(run.report.state == std::vector<double>{1.5});
    CHECK(run.report.invariants.empty());
}

TEST_CASE("The report of an implicit method says what its calls were spent on")
{
    // Two Newton iterations for the first step, one to confirm the prediction of each other one.
    const Ran run = ran<WithJacobian, Gauss2>(job_from({0.5}, 1, 0.25, 3));
    CHECK(run.report.rhs_calls == 5);
    CHECK(run.report.newton == 5);
    CHECK(run.report.decompositions == 4);
}

TEST_CASE("A run tells events, energy, invariants and constraints, and picks columns")
{
    detail::RunJob job = swing(4, "bottom", -1, false);
    job.events.push_back({"turn", 1, true, 1});
    job.rows = {detail::RowsAsked::Kind::interval, 0, 1.5, {}};
    job.columns = {{true, 1}, {false, 0}, {true, 0}};
    const Ran run = ran<Full, Dop853>(job);
    REQUIRE(run.rows.size() == 4); // at 0, 1.5 and 3, and one more at the event
    CHECK(run.rows[0] == std::vector<double>{0, 3, 0.5, 1});
    CHECK(run.rows[1][0] == 1.5);
    CHECK(run.rows[3][0] == run.report.t);
    CHECK(run.report.status == "stopped_by_event");
    CHECK(run.report.t == Approx(3.19).epsilon(1e-2));
    REQUIRE(run.report.events.size() == 2);
    CHECK(run.report.events[0].name == "bottom");
    CHECK(run.report.events[0].t == Approx(run.report.t / 2).epsilon(1e-10));
    CHECK(run.report.events[1].name == "turn");
    CHECK(run.report.events[1].after.empty());
    REQUIRE(run.report.invariants.size() == 2);
    CHECK(run.report.invariants[0].name == "energy");
    CHECK(run.report.invariants[0].initial == Approx(-std::cos(0.5)).epsilon(1e-15));
    CHECK(run.report.invariants[1].name == "zero");
    CHECK(run.report.invariants[1].most == run.report.t);
    REQUIRE(run.report.constraints.size() == 1);
    CHECK(run.report.constraints[0].most == Approx(0.5).epsilon(1e-10));
}

TEST_CASE("A run that cannot go on keeps its rows")
{
    detail::RunJob job = job_from({1, 0}, 10, 0.5, 201);
    job.max_steps = 4;
    const Ran run = ran<Full, Rk4>(job);
    CHECK(run.report.status == "too_many_steps");
    CHECK(run.report.t == 2);
    CHECK(run.rows.size() == 41);
}

TEST_CASE("A job that does not fit the model is refused")
{
    const detail::RunJob good = job_from({1, 2}, 1, 1, 2);
    CHECK(ran<Full, Rk4>(good).fits);
    const auto refused = [&](auto change) {
        detail::RunJob job = good;
        change(job);
        return !ran<Full, Rk4>(job).fits;
    };
    CHECK(refused([](detail::RunJob& job) { job.initial.pop_back(); }));
    CHECK(refused([](detail::RunJob& job) { job.parameters = {1, 2}; }));
    CHECK(refused([](detail::RunJob& job) { job.step = 0; }));
    CHECK(refused([](detail::RunJob& job) { job.columns = {{false, 2}}; }));
    CHECK(refused([](detail::RunJob& job) { job.events = {{"top", 0, false, 1}}; }));
    CHECK(refused([](detail::RunJob& job) { job.rows = {detail::RowsAsked::Kind::interval, 0, 1e-300, {}}; }));
    CHECK(refused([](detail::RunJob& job) { job.input_rows = {0, 1}; }));
}

TEST_CASE("The row of a stopping event is at its time exactly, once, and only where an event stops the run")
{
    const Ran run = ran<Full, Dop853>(swing(9, "bottom", 0, true));
    REQUIRE(run.report.events.size() == 1);
    CHECK(run.rows.back()[0] == run.report.t);
    CHECK(std::vector<double>(run.rows.back().begin() + 1, run.rows.back().end()) == run.report.state);
    CHECK(run.report.events[0].t == run.report.t);
    CHECK(std::abs(run.report.events[0].state[0]) < 1e-15);
    const Ran mirrored = ran<Full, Dop853>(swing(-9, "bottom", 0, true));
    CHECK(mirrored.report.t == -run.report.t);
    CHECK(mirrored.rows.back()[0] == -run.report.t);
    CHECK(ran<Full, Dop853>(swing(9, "bottom", 0, false)).rows.size() == 4);
}

TEST_CASE("Times of rows outside the interval are left out, equal ones repeated")
{
    const auto rows = [](const std::vector<double>& times, double end) {
        detail::RunJob job = job_from({1}, end, 0.25, 0);
        job.rows = {detail::RowsAsked::Kind::at, 0, 0, times};
        return ran<Bare, Rk4>(job).rows;
    };
    CHECK(rows({-1, 0, 0.5, 0.5, 2}, 1) == Rows{{0, 1}, {0.5, 1.5}, {0.5, 1.5}});
    CHECK(rows({1, 0, -0.5, -2}, -1) == Rows{{0, 1}, {-0.5, 0.5}});
}

TEST_CASE("A structure is read as it was written, and bytes that are none are refused")
{
    detail::RunJob job = swing(9, "bottom", -1, true);
    job.rows = {detail::RowsAsked::Kind::at, 0, 0, {1, 2}};
    const std::string bytes = detail::packed(job);
    detail::RunJob read;
    std::string_view rest = bytes;
    REQUIRE(detail::take_packed(rest, read));
    CHECK(rest.empty());
    CHECK(detail::packed(read) == bytes);
    CHECK(read.events[0].name == "bottom");
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() - 1}) {
        rest = std::string_view(bytes).substr(0, size);
        CHECK_FALSE(detail::take_packed(rest, read));
    }
    rest = "................................"; // sizes of 2e18
    CHECK_FALSE(detail::take_packed(rest, read));
    detail::RunReport report, known;
    report.manifold = 0.5;
    report.branches = std::vector<double>{1, 2};
    const std::string told = detail::packed(report);
    rest = told;
    REQUIRE(detail::take_packed(rest, known));
    CHECK(known.manifold == 0.5);
    CHECK(known.branches->size() == 2);
}

TEST_CASE("The program of a model writes native doubles and a report, and exits with 4 and 5 where it cannot")
{
    const auto folder = std::filesystem::temp_directory_path() / ("lagen_driver_test_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const auto redirected = [&](std::FILE* stream, const char* name, const auto& call) {
        std::fflush(stream);
        const int kept = dup(fileno(stream));
        std::FILE* file = std::fopen((folder / name).c_str(), "w");
        dup2(fileno(file), fileno(stream));
        std::fclose(file);
        call();
        std::fflush(stream);
        dup2(kept, fileno(stream));
        close(kept);
    };
    const auto content = [&](const char* name) {
        std::ostringstream text;
        text << std::ifstream(folder / name, std::ios::binary).rdbuf();
        return text.str();
    };
    const auto exit_code = [&](auto program, const detail::RunJob& job, const std::string& report) {
        const std::string file = (folder / "job").string();
        REQUIRE(detail::write_bytes(file.c_str(), detail::packed(job)));
        std::string arguments[] = {"program", file, report};
        char* pointers[] = {arguments[0].data(), arguments[1].data(), arguments[2].data()};
        int code = 0;
        redirected(stdout, "out", [&] { redirected(stderr, "err", [&] { code = program(3, pointers); }); });
        return code;
    };
    const std::string report = (folder / "report").string();
    CHECK(exit_code(drive<Bare, Euler>, job_from({1}, -1, 0.5, 2), report) == 0);
    std::array<double, 4> values{};
    const std::string out = content("out");
    REQUIRE(out.size() == sizeof values);
    std::memcpy(values.data(), out.data(), out.size());
    CHECK(values == std::array<double, 4>{0, 1, -1, 0});
    detail::RunReport told;
    REQUIRE(detail::read_packed(report.c_str(), told));
    CHECK(told.steps == 2);
    CHECK(exit_code(drive<Bare, Euler>, job_from({1, 2}, 1, 0.5, 2), report) == 4);
    CHECK(content("err") == "error: a job for this model and the place of its report are required\n");
    CHECK(exit_code(drive<Bare, Euler>, job_from({1}, 1, 0.5, 2), "/nowhere/report") == 5);
    detail::RunJob much = job_from({0.5, 0}, 1, 0.25, 3);
    much.columns = {{true, 0}};
    CHECK(exit_code(drive<Greedy, Rk4>, much, report) == 5);
    CHECK(content("err") == "error: the scene cannot be integrated: std::bad_alloc\n");
    std::filesystem::remove_all(folder);
}
