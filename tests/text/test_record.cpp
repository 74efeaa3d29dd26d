// SPDX-License-Identifier: GPL-2.0-or-later
/// Records as JSON.
#include "text/record.hpp"

#include <catch2/catch.hpp>

#include <limits>

using namespace lagen;

TEST_CASE("JSON is written in order, escaped, with shortest numbers", "[text]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Record record = {
        {"b\n\"", "b\\\x01"}, {"a", {0.1, 3U, true, nullptr, nan, Record::object(), 1.0}}, {"e", 1e300}, {"-", -0.0}};
    CHECK(to_json(record) ==
          "{\"b\\n\\\"\": \"b\\\\\\u0001\", \"a\": [0.1, 3, true, null, null, {}, 1], \"e\": 1e+300, \"-\": -0}");
}

TEST_CASE("bytes that are no UTF-8 are replaced", "[text]")
{
    CHECK(to_json(Record("\xff?")) == "\"\uFFFD?\"");
}

TEST_CASE("a member is added to an object that is text", "[text]")
{
    const std::string one = with_member("{}", "a\"", "[1, 2]");
    CHECK(one == R"({"a\"": [1, 2]})");
    CHECK(with_member(one, "b", "null") == R"({"a\"": [1, 2], "b": null})");
}

TEST_CASE("what is not there is null or no member", "[text]")
{
    Record record = {{"a", or_null(std::optional<double>())}, {"b", or_null(std::optional<double>(2.5))}};
    add_unless_empty(record, "c", std::string());
    add_unless_empty(record, "d", std::string("x"));
    add_unless_empty(record, "e", Record::array());
    CHECK(to_json(record) == R"({"a": null, "b": 2.5, "d": "x"})");
}
