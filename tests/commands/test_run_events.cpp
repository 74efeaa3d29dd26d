// SPDX-License-Identifier: GPL-2.0-or-later
/// Events of `lagen run` as people use them: their states, rows at them, jumps against closed forms, and zeno.
#include "program.hpp"
#include "sweep_table.hpp"

#include "support/golden.hpp"
#include "support/json.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace lagen::testing;
using Catch::Contains;
using Catch::WithinAbs;
namespace json = lagen::json;

namespace {

/// When a ball that is dropped from a metre bounces for the (k + 1)-th time.
double time_of_bounce(double e, std::size_t k)
{
    return std::sqrt(2 / 9.81) * (1 + 2 * e * (1 - std::pow(e, static_cast<double>(k))) / (1 - e));
}

} // namespace

TEST_CASE("each bounce of a ball has its state before and behind it, at the times of the closed form", "[run]")
{
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{}, {"--form", "hamilton"}, {"--method", "taylor"}}) {
        std::vector<std::string> arguments{"bouncing_ball.toml"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const json::Value value = report_of("run", arguments);
        const std::vector<json::Value>& events = value["events"].entries;
        REQUIRE(events.size() == 11);
        const std::string velocity = more.empty() || more[0] == "--method" ? "v" : "p_v";
        for (std::size_t k = 0; k < events.size(); ++k) {
            CHECK(events[k].keys == std::vector<std::string>{"name", "t", "state", "after"});
            CHECK(events[k]["name"].text == "bounce");
            CHECK_THAT(events[k]["t"].decimal(), WithinAbs(time_of_bounce(0.9, k), 1e-12));
            const json::Value &before = events[k]["state"], &after = events[k]["after"];
            CHECK(before.keys == std::vector<std::string>{"x", velocity});
            CHECK_THAT(before["x"].decimal(), WithinAbs(0, 1e-14));
            // e^2 of the energy is left, which is that of the velocity
            const double energy = std::pow(before[velocity].decimal(), 2);
            CHECK_THAT(std::pow(after[velocity].decimal(), 2), WithinAbs(0.81 * energy, 1e-14 * energy));
            CHECK(after[velocity].decimal() > 0);
            CHECK(after["x"].decimal() == before["x"].decimal());
        }
        // between the bounces nothing is lost
        CHECK_THAT(value["invariants"]["energy"]["initial"].decimal(), WithinAbs(0.15 * 9.81, 1e-15));
        CHECK(value["invariants"]["energy"]["max_drift"].decimal() < 1e-12);
        CHECK(value["rows"].size() == 601);
    }
}

TEST_CASE("the text of a run has a line an event, and of many the first and the last ones", "[run]")
{
    const Outcome few = call({"run", "bouncing_ball.toml", "--t-end", "1.5", "-o", fresh_folder() + "/rows.csv"});
    CHECK(few.code == 0);
    CHECK_THAT(few.err, Contains("\n  event bounce at t = 0.45152364098573: x = ") &&
                            Contains(", v = -4.42944692, then v = 3.98650223\n"));
    CHECK_THAT(few.err, !Contains("warning"));
    const Outcome many = call({"run", "bouncing_ball.toml", "--t-end", "8", "-o", fresh_folder() + "/rows.csv"});
    CHECK(many.code == 0);
    CHECK_THAT(many.err, Contains(" events more, all of them in `--format json`\n"));
}

TEST_CASE("`sample` names an event: its crossings are the rows, with the state before the jump", "[run]")
{
    const Outcome outcome = call({"run", "bouncing_ball.toml", "--scene", "bounces"});
    CHECK(outcome.code == 0);
    const CsvTable table = read_csv(outcome.out);
    CHECK(table.heading == std::vector<std::string>{"t", "x", "v", "energy"});
    REQUIRE(table.rows.size() == 11);
    for (std::size_t k = 0; k < 11; ++k) {
        CHECK_THAT(number_of(table.rows[k][0]), WithinAbs(time_of_bounce(0.9, k), 1e-12));
        CHECK_THAT(number_of(table.rows[k][2]), WithinAbs(-std::sqrt(2 * 9.81) * std::pow(0.9, k), 1e-12));
        CHECK_THAT(number_of(table.rows[k][3]), WithinAbs(0.15 * 9.81 * std::pow(0.81, k), 1e-12));
    }
    const Outcome asked = call({"run", "bouncing_ball.toml", "--scene", "bounces", "--at", "0,1"});
    CHECK(read_csv(asked.out).rows.size() == 2); // --at wins
    CHECK(read_csv(call({"run", "bouncing_ball.toml", "--scene", "bounces", "--t-end", "0.1"}).out).rows.empty());
}

TEST_CASE("infinitely many bounces are zeno, at the time of the closed form", "[run]")
{
    const json::Value value = report_of("run", {"bouncing_ball.toml", "--scene", "rest"}, 1);
    CHECK(value["status"].text == "zeno");
    const double limit = std::sqrt(2 / 9.81) * 1.7 / 0.3;
    CHECK_THAT(value["t"].decimal(), WithinAbs(limit, 1e-12));
    CHECK(value["failed_at"].text == value["t"].text);
    const Outcome outcome = call({"run", "bouncing_ball.toml", "--scene", "rest", "-o", fresh_folder() + "/rows.csv"});
    CHECK(outcome.code == 1);
    CHECK_THAT(outcome.err, Catch::StartsWith("bouncing_ball, scene rest: zeno at t = 2.55863") &&
                                Contains("\n  infinitely many jumps of event bounce lead up to here, ever faster; the "
                                         "model does not say what follows them\n  the last good state is at t = "));
}

TEST_CASE("a floor that rises or shakes: zeno where the closed form says, none without losses, no ball falls through",
          "[run]")
{
    const std::string folder = fresh_folder(), floor = folder + "/floor.toml";
    write_text(floor, R"toml(
[parameters]
g = 9.81
V = 0.3
A = 0
e = 0.7
z0 = 0.1
[base]
coordinates = ["z"]
[algebroid]
kind = "tangent"
[definitions]
Z = "V*t + A*sin(25*t)"
W = "Dt(Z)"
[lagrangian]
L = "v_z^2/2 - g*z"
[scene.default]
initial = { z = "z0", v_z = 0 }
duration = 5
[scene.default.events]
bounce = { when = "z - Z", direction = "falling", jump = { v_z = "W - e*(v_z - W)" } }
[scene.along]
like = "default"
initial = { z = "z0", v_z = "V" }
duration = 1
)toml");
    for (const double speed : {0.0, 0.3, 1.0}) {
        const json::Value value = report_of("run", {floor, "--set", "V=" + std::to_string(speed)}, 1);
        CHECK(value["status"].text == "zeno");
        const double u = std::sqrt(speed * speed + 2 * 9.81 * 0.1);
        const double limit = (u - speed) / 9.81 + 2 * 0.7 * u / (9.81 * 0.3);
        CHECK_THAT(value["t"].decimal(), WithinAbs(limit, 1e-12 + 4e-7 * speed));
    }
    const json::Value elastic =
        report_of("run", {floor, "--scene", "along", "--set", "e=1", "--set", "z0=1e-5", "--method", "taylor"});
    CHECK(elastic["status"].text == "ok");
    const double flight = 2 * std::sqrt(2e-5 / 9.81);
    CHECK(elastic["events"].size() == static_cast<std::size_t>(1 / flight + 0.5));
    for (const std::string method : {"dop853", "tsit5", "taylor"}) {
        const json::Value value =
            report_of("run", {floor, "--set", "e=0", "--set", "V=0", "--set", "A=0.02", "--method", method}, 1);
        CHECK(value["status"].text == "zeno");
        CHECK_THAT(value["t"].decimal(), WithinAbs(0.1509990598532425, 1e-13));
        CHECK(value["events"].size() == 2);
    }
    // a ball of e = 0.7 comes to lie on that table where 40 digits have 1.2566177882
    const json::Value table = report_of("run", {floor, "--set", "V=0", "--set", "A=0.02"}, 1);
    CHECK(table["status"].text == "zeno");
    CHECK_THAT(table["t"].decimal(), WithinAbs(1.256617788154216, 2e-7));
}

TEST_CASE("a rimless wheel comes to the speed of its limit cycle, step by step as the closed form says", "[run]")
{
    const Outcome outcome = call({"run", "rimless_wheel.toml", "--scene", "steps"});
    CHECK(outcome.code == 0);
    const CsvTable table = read_csv(outcome.out);
    REQUIRE(table.rows.size() > 40);
    const double alpha = std::acos(-1.0) / 8, c = std::cos(2 * alpha);
    const double gain = 4 * 9.81 * std::sin(alpha) * std::sin(0.2);
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
        const double before = number_of(table.at(k, "w")), behind = number_of(table.at(k, "next_speed"));
        CHECK_THAT(behind, WithinAbs(c * before, 1e-14));
        if (k == 0) continue;
        const double last = number_of(table.at(k - 1, "next_speed"));
        CHECK_THAT(before * before, WithinAbs(last * last + gain, 1e-9));
    }
    const double speed = c / std::sin(2 * alpha) * std::sqrt(gain);
    CHECK_THAT(number_of(table.rows.back()[2]), WithinAbs(speed, 1e-9));
    CHECK_THAT(number_of(table.at(0, "cycle_speed")), WithinAbs(speed, 1e-14));
}

TEST_CASE("a wheel that rocks on level ground comes to rest by two events in turn", "[run]")
{
    const json::Value done = report_of("run", {"rimless_wheel.toml", "--scene", "rocking"});
    CHECK(done["status"].text == "ok");
    const json::Value value = report_of("run", {"rimless_wheel.toml", "--scene", "rocking", "--t-end", "5"}, 1);
    CHECK(value["status"].text == "zeno");
    const std::vector<json::Value>& events = value["events"].entries;
    REQUIRE(events.size() > 40);
    // c w behind each impact, and as much before the next: the foot returns to where it came from
    for (std::size_t k = 1; k < 20; ++k) {
        CHECK(events[k]["name"].text != events[k - 1]["name"].text);
        CHECK_THAT(events[k]["state"]["w"].decimal() / events[k - 1]["after"]["w"].decimal(), WithinAbs(-1, 1e-9));
    }
}

TEST_CASE("a Poincare section is a scene whose rows are at an event", "[run]")
{
    const json::Value value = report_of("run", {"henon_heiles.toml", "--scene", "sea", "--t-end", "200"});
    CHECK(value["columns"].texts() == std::vector<std::string>{"t", "y", "v"});
    REQUIRE(value["rows"].size() == value["events"].size());
    REQUIRE(value["rows"].size() > 25);
    for (std::size_t k = 0; k < value["rows"].size(); ++k) {
        const json::Value& event = value["events"][k];
        CHECK(value["rows"][k][0].text == event["t"].text);
        CHECK(value["rows"][k][1].text == event["state"]["y"].text);
        CHECK(event.keys == std::vector<std::string>{"name", "t", "state"});
        CHECK_THAT(event["state"]["x"].decimal(), WithinAbs(0, 1e-11));
        CHECK(event["state"]["u"].decimal() > 0);
    }
}

TEST_CASE("rows of a sweep with jumps are those of `run`, zeno included", "[sweep]")
{
    const std::string folder = fresh_folder();
    const Outcome sweep =
        call({"sweep", "bouncing_ball.toml", "--scene", "rest", "--set", "e=0.5:0.9:3", "-o", folder + "/e.csv"});
    INFO(sweep.err);
    CHECK(sweep.code == 0);
    const CsvTable table = read_csv(read_text(folder + "/e.csv"));
    REQUIRE(table.rows.size() == 3);
    CHECK(table.rows[0].back() == "zeno");
    CHECK(table.rows[1].back() == "zeno");
    CHECK(table.rows[2].back() == "ok");
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string e = table.at(k, "set.e");
        const json::Value value =
            report_of("run", {"bouncing_ball.toml", "--scene", "rest", "--set", "e=" + e}, k == 2 ? 0 : 1);
        CHECK(value["t"].text == table.at(k, "t"));
        CHECK(value["state"]["v"].text == table.at(k, "v"));
        CHECK(std::to_string(value["events"].size()) == table.at(k, "event.bounce.count"));
        CHECK(value["events"].entries.back()["t"].text == table.at(k, "event.bounce.t"));
    }
}

TEST_CASE("a ball on its floor is thrown back there, and a run says on which events it starts that do not happen",
          "[run]")
{
    const json::Value thrown =
        report_of("run", {"bouncing_ball.toml", "--initial", "x=0", "--initial", "v=-1", "--t-end", "1"});
    const std::vector<json::Value>& events = thrown["events"].entries;
    REQUIRE(events.size() > 5);
    CHECK(events[0]["t"].decimal() == 0);
    CHECK(events[0]["after"]["v"].decimal() == 0.9);
    CHECK(thrown["state"]["x"].decimal() > -1e-12);
    const std::string stop = written_file("stop.toml", R"toml(
[base]
coordinates = ["x"]
[algebroid]
kind = "tangent"
[lagrangian]
L = "v_x^2/2 - 9.81*x"
[scene.default]
initial = { x = 0, v_x = -1 }
duration = 1
[scene.default.events]
floor = { when = "x", direction = "falling", stop = true }
)toml");
    const std::string note = "note: the run starts on event 'floor', or beyond it, and it does not happen there: ";
    for (const std::string x : {"0", "-1e-18"}) {
        const Outcome run = call({"run", stop, "--initial", "x=" + x, "--at", "1"});
        CHECK(run.code == 0);
        CHECK_THAT(run.err, Contains(note));
    }
    CHECK_THAT(call({"run", stop, "--initial", "x=1", "--at", "1"}).err, !Contains(note));
    const Outcome sweep = call({"sweep", stop, "--initial", "x=0:1:3", "-o", fresh_folder() + "/x.csv"});
    CHECK(sweep.code == 0);
    CHECK_THAT(sweep.err,
               Contains("note: 1 row starts on event 'floor', or beyond it, and it does not happen there\n"));
}
