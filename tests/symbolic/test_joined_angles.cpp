// SPDX-License-Identifier: GPL-2.0-or-later
/// Addition theorems in the shortest form: exact texts, and that values stay.
#include "expression/parse.hpp"
#include "symbolic/shortest_form.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace lagen;

namespace {

const Order angles_order{{"m", "k"}, {"x", "y", "z", "w"}};

struct Shortened {
    GiNaC::ex before, after;
    std::string text;
};

Shortened shortened(const std::string& text, SymbolTable& symbols)
{
    const GiNaC::ex before = to_ginac(parse_expression(whole_text("<test>", text)), symbols);
    const Tree shortest = shortest_form(before, symbols, angles_order);
    return {before, to_ginac(shortest, symbols), to_text(shortest)};
}

std::string text_of(const std::string& text)
{
    SymbolTable symbols;
    return shortened(text, symbols).text;
}

double value_at(const GiNaC::ex& e, SymbolTable& symbols, const std::map<std::string, double>& point)
{
    GiNaC::exmap values;
    for (const auto& [name, value] : point) values[symbols.symbol(name)] = value;
    return GiNaC::ex_to<GiNaC::numeric>(e.subs(values).evalf()).to_double();
}

} // namespace

TEST_CASE("products of sines and cosines of two angles are those of their sum or difference")
{
    CHECK(text_of("cos(x)*cos(y) + sin(x)*sin(y)") == "cos(x - y)");
    CHECK(text_of("cos(x)*cos(y) - sin(x)*sin(y)") == "cos(x + y)");
    CHECK(text_of("sin(x)*sin(y) - cos(x)*cos(y)") == "-cos(x + y)");
    CHECK(text_of("sin(x)*cos(y) + cos(x)*sin(y)") == "sin(x + y)");
    CHECK(text_of("sin(x)*cos(y) - cos(x)*sin(y)") == "sin(x - y)");
    CHECK(text_of("m*w*cos(x)*cos(y)^2 + m*w*sin(x)*sin(y)*cos(y) + k*w") == "m*w*cos(y)*cos(x - y) + k*w");
    // Three angles, one pair behind the other.
    CHECK(text_of("cos(z)*(cos(x)*cos(y) - sin(x)*sin(y)) - sin(z)*(sin(x)*cos(y) + cos(x)*sin(y))") ==
          "cos(x + y + z)");
    CHECK(text_of("(sin(x)*cos(y) - cos(x)*sin(y))/(sin(z)*cos(y) - cos(z)*sin(y))^2") == "sin(x - y)/sin(y - z)^2");
}

TEST_CASE("products that are no pair stay")
{
    CHECK(text_of("m*cos(x)*cos(y) + k*sin(x)*sin(y)") == "m*cos(x)*cos(y) + k*sin(x)*sin(y)");
    CHECK(text_of("2*cos(x)*cos(y) + sin(x)*sin(y)") == "sin(x)*sin(y) + 2*cos(x)*cos(y)");
    CHECK(text_of("sin(x)*cos(x)") == "sin(x)*cos(x)");
    CHECK(text_of("sin(x)*cos(x) + cos(x)*cos(y)") == "cos(x)*(sin(x) + cos(y))");
}

TEST_CASE("values stay whatever is joined")
{
    std::mt19937 random(7);
    const auto any = [&](auto... texts) {
        const std::string list[] = {texts...};
        return list[random() % sizeof...(texts)];
    };
    std::size_t shorter = 0;
    for (int trial = 0; trial < 200; ++trial) {
        std::string text = "0";
        for (int term = 0; term < 6; ++term) {
            text +=
                any(std::string(" + "), std::string(" - ")) + any(std::string("1"), std::string("m"), std::string("w"));
            for (const char* angle : {"x", "y", "z"})
                text += any(std::string("*sin("), std::string("*cos("), std::string("*cos(")) + angle + ")";
        }
        SymbolTable symbols;
        const Shortened both = shortened(text, symbols);
        shorter += both.text.find("x +") != std::string::npos || both.text.find("x -") != std::string::npos ||
                   both.text.find("y +") != std::string::npos || both.text.find("y -") != std::string::npos;
        const std::map<std::string, double> point{{"m", 1.3}, {"w", -0.7}, {"x", 0.4}, {"y", 1.9}, {"z", -2.3}};
        INFO(text << "\n" << both.text);
        CHECK(std::abs(value_at(both.before, symbols, point) - value_at(both.after, symbols, point)) < 1e-14);
    }
    CHECK(shorter > 40); // of 200
}
