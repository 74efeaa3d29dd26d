// SPDX-License-Identifier: GPL-2.0-or-later
/// docs/messages.md shows every example, once, under its theme.
#include "errors/examples.hpp"
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace lagen::errors;

TEST_CASE("every example stands once in themes.txt, and every name there has an example")
{
    std::vector<std::string> named;
    for (const Theme& theme : read_themes()) named.insert(named.end(), theme.names.begin(), theme.names.end());
    std::ranges::sort(named);
    std::vector<std::string> there;
    for (const Example& example : read_examples()) there.push_back(example.name);
    CHECK(there.size() > 100);
    std::vector<std::string> missing, surplus;
    std::ranges::set_difference(there, named, std::back_inserter(missing));
    std::ranges::set_difference(named, there, std::back_inserter(surplus));
    INFO("add the first to tests/errors/themes.txt, under their themes, and take the second out");
    CHECK(missing == std::vector<std::string>{});
    CHECK(surplus == std::vector<std::string>{});
}

TEST_CASE("no two examples show the same text")
{
    std::vector<std::string> sentences;
    for (const Example& example : read_examples()) {
        const std::size_t error = example.text.find(": error: ");
        if (!example.name.starts_with("commands/") && error != std::string::npos)
            sentences.push_back(example.text.substr(error + 9));
    }
    std::ranges::sort(sentences);
    CHECK(std::ranges::adjacent_find(sentences) == sentences.end());
}

TEST_CASE("docs/messages.md is the page that the examples make")
{
    const std::string page = messages_page(read_themes(), read_examples());
    CHECK(page.find("\n## ") != std::string::npos);
    lagen::testing::check_text("docs/messages.md", page);
}
