// SPDX-License-Identifier: GPL-2.0-or-later
/// Headers that are compiled with options under which they cannot hold what they promise say so in one sentence.
#include "support/golden.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <sstream>

using namespace lagen::testing;

namespace {

/// The lines "error: .." of a compiler that is to read this header first.
std::vector<std::string> errors_of(const std::string& header, const std::string& options)
{
    const char* chosen = std::getenv("CXX");
    const Shell read =
        run_shell("echo '#include <lagen/" + header + ">' | " + std::string(chosen == nullptr ? "c++" : chosen) + " " +
                  options + " -fsyntax-only -I'" LAGEN_SOURCE_DIR "/runtime/include' -x c++ - 2>&1");
    CHECK(read.status != 0);
    std::vector<std::string> errors;
    std::istringstream lines(read.output);
    for (std::string line; std::getline(lines, line);)
        if (line.find("error: ") != std::string::npos) errors.push_back(line);
    return errors;
}

std::vector<std::string> all_headers()
{
    const std::filesystem::path root = LAGEN_SOURCE_DIR "/runtime/include/lagen";
    std::vector<std::string> headers;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
        if (entry.path().extension() == ".hpp" && entry.path().filename() != "requirements.hpp")
            headers.push_back(entry.path().lexically_relative(root).string());
    return headers;
}

} // namespace

TEST_CASE("every header, included first, refuses C++17, finite mathematics and macros min and max by one sentence")
{
    const std::string finite = "lagen needs NaN and infinity, by which runs see that they fail";
    for (const char* options : {"-std=c++20 -ffast-math", "-std=c++20 -Ofast", "-std=c++20 -ffinite-math-only"}) {
        const auto errors = errors_of("integrate.hpp", options);
        REQUIRE(errors.size() == 2); // and the file that is missing, at which the compiler stops
        CHECK(errors[0].find(finite) != std::string::npos);
    }
    for (const char* macro : {"'-Dmin(a,b)=a'", "'-Dmax(a,b)=a'"})
        CHECK(errors_of("integrate.hpp", std::string("-std=c++20 ") + macro)[0].find("NOMINMAX") != std::string::npos);
    for (const std::string& header : all_headers()) {
        INFO(header);
        const auto errors = errors_of(header, "-std=c++17");
        REQUIRE(errors.size() == 2);
        CHECK(errors[0].find("lagen's headers are C++20") != std::string::npos);
    }
}
