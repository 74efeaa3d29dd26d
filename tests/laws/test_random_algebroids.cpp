// SPDX-License-Identifier: GPL-2.0-or-later
/// `verify` on random algebroids that are valid by construction, and on their near misses. Environment:
///   LAGEN_PROPERTY_MODELS  number of trials (each: one valid model, one near miss), and prints the tables
///   LAGEN_PROPERTY_FIRST   number of the first trial
///   LAGEN_PROPERTY_FOLDER  where failures and undecided models are written
#include "support/sanitized.hpp"
#include "trial.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>
#include <fstream>
#include <iostream>

using namespace lagen::laws;

namespace {

std::string setting(const char* name, const char* otherwise)
{
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe)
    return value == nullptr ? otherwise : value;
}

void write(const std::vector<Failure>& failures, const std::string& folder)
{
    for (const Failure& failure : failures) std::ofstream(folder + "/" + failure.name + ".toml") << failure.text;
}

void check_trials(std::size_t first, std::size_t number)
{
    const std::string folder = setting("LAGEN_PROPERTY_FOLDER", "");
    Trials trials;
    for (std::size_t k = 0; k < number; ++k) {
        run_trial(first + k, trials);
        if (folder.empty()) continue;
        write(trials.undecided, folder);
        trials.undecided.clear();
        std::ofstream(folder + "/now") << first + k << "\n";
    }
    if (!folder.empty()) write(trials.failures, folder);
    if (std::getenv("LAGEN_PROPERTY_MODELS") != nullptr) // NOLINT(concurrency-mt-unsafe)
        std::cout << table_text("valid", trials.valid) << "\n"
                  << table_text("own kind", trials.own_kind) << "\n"
                  << table_text("near misses", trials.near_misses) << "\n"
                  << table_text("by mutation", trials.by_mutation);
    for (std::size_t k = 0; k < trials.failures.size() && k < 5; ++k) {
        INFO(trials.failures[k].name << "\n" << trials.failures[k].text);
        CHECK(trials.failures.empty());
    }
    const Count valid = trials.valid.total(), near_misses = trials.near_misses.total();
    CHECK(valid.wrong + near_misses.wrong + trials.own_kind.total().wrong == 0);
    CHECK(valid.number > number * 9 / 10);
    CHECK(near_misses.number > number * 9 / 10);
    CHECK(valid.undecided * 50 <= valid.number);
    CHECK(near_misses.undecided * 50 <= near_misses.number);
}

} // namespace

TEST_CASE("no verdict on a random algebroid or on a near miss of it is wrong, and hardly any is undecided")
{
    check_trials(std::stoul(setting("LAGEN_PROPERTY_FIRST", "0")),
                 std::stoul(setting("LAGEN_PROPERTY_MODELS", LAGEN_SANITIZED ? "150" : "400")));
}

TEST_CASE("of the verdicts on ten thousand random algebroids (with sanitizers on six hundred) none is wrong", "[all]")
{
    check_trials(0, LAGEN_SANITIZED ? 600 : 10'000);
}
