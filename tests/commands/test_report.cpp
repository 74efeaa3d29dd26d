// SPDX-License-Identifier: GPL-2.0-or-later
/// `lagen generate --report`: a table that a person reads.
#include "commands/report_operations.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen;
using namespace lagen::testing;

namespace {

OperationCount weighing(std::size_t additions, double weight)
{
    return {.additions = additions, .weight = weight};
}

PassReport stage(Stage stage, const OperationCount& before, const OperationCount& after)
{
    return {to_text(stage), "", before, after, stage};
}

auto lines_in(const std::string& text)
{
    return std::count(text.begin(), text.end(), '\n');
}

} // namespace

TEST_CASE("the summary of a kernel shows the passes that changed the form that was kept, and the costliest terms")
{
    SimplifyReport report;
    report.written = weighing(9, 90);
    report.passes = {{"nested, shared", "factor pairs shared", weighing(8, 80), weighing(8, 80)},
                     {"nested, shared", "signs absorbed", weighing(8, 80), weighing(7, 70)},
                     {"expanded, shared", "factor pairs shared", weighing(9, 99), weighing(5, 50)},
                     {"expanded, shared", "term pairs shared", weighing(5, 50), weighing(5, 50)},
                     {"expanded, shared", "signs absorbed", weighing(5, 50), weighing(4, 40)},
                     stage(Stage::lightest, weighing(9, 90), weighing(7, 70)),
                     stage(Stage::mixed, weighing(9, 90), weighing(6, 60))};
    report.kept = weighing(6, 60);
    report.costliest = {{"a/b", 5, 2}, {"a*b", 4, 1}, {"a + b", 1, 1}};
    SimplifyReport untouched;
    untouched.written = untouched.kept = {.functions = 1, .weight = 20};
    CHECK(
        operations_text({{"rhs", report}, {"energy", untouched}}) ==
        "operations                                                           + -      *      / functions solves   "
        "weight\n"
        "rhs, as written                                                        9      0      0         0      0      "
        " 90\n"
        "  nested, shared                                                       8      0      0         0      0      "
        " 80\n"
        "    signs absorbed                                                     7      0      0         0      0      "
        " 70\n"
        "  outputs of several forms                                             6      0      0         0      0      "
        " 60\n"
        "  kept                                                                 6      0      0         0      0      "
        " 60\n"
        "    weighs 5, used 2 times: a/b\n"
        "    weighs 4, used once: a*b\n"
        "energy, kept as written                                                0      0      0         1      0      "
        " 20\n");
}

TEST_CASE("of a system that was solved in two ways the summary shows the way that was kept")
{
    SimplifyReport report;
    report.written = weighing(9, 90);
    report.passes = {{"nested, shared", "signs absorbed", weighing(8, 80), weighing(7, 70)},
                     stage(Stage::lightest, weighing(9, 90), weighing(7, 70)),
                     stage(Stage::mixed, weighing(9, 90), weighing(7, 70)),
                     stage(Stage::eliminated, weighing(9, 90), weighing(5, 50)),
                     {"nested, shared", "signs absorbed", weighing(3, 30), weighing(2, 20)},
                     stage(Stage::lightest, weighing(9, 90), weighing(2, 20)),
                     stage(Stage::mixed, weighing(9, 90), weighing(2, 20))};
    report.kept = weighing(2, 20);
    const std::string as_it_is = operations_text({{"rhs", report}});
    CHECK(as_it_is.find("solved through") == std::string::npos);
    CHECK(as_it_is.find(" 30\n") != std::string::npos);
    report.kept = weighing(5, 50);
    const std::string through_terms = operations_text({{"rhs", report}});
    CHECK(through_terms.find("  solved through the terms of a Hessian") != std::string::npos);
    CHECK(through_terms.find(" 30\n") == std::string::npos);
}

TEST_CASE("--report prints a table that fits on a page, and does not change the header", "[long]")
{
    const Outcome plain = call({"generate", "double_pendulum.toml"});
    const Outcome summary = call({"generate", "--report", "double_pendulum.toml"});
    CHECK(plain.err.empty());
    CHECK(summary.out == plain.out);
    CHECK(summary.err.starts_with("operations "));
    CHECK(summary.err.find("\nmass_matrix, as written ") != std::string::npos);
    CHECK(summary.err.find("\nobservables, kept as written ") != std::string::npos);
    CHECK(lines_in(summary.err) <= 60);
}
