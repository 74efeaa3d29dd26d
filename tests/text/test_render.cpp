// SPDX-License-Identifier: GPL-2.0-or-later
/// How a diagnostic looks, to the character.
#include "text/diagnostic.hpp"

#include <catch2/catch.hpp>

#include <type_traits>

using namespace lagen;

namespace {

std::string render_in(const std::string& text, std::size_t begin, std::size_t end, const std::string& hint = "")
{
    return render({Severity::error, "wrong", whole_text("m.toml", text).range(begin, end), hint});
}

} // namespace

TEST_CASE("a diagnostic shows place, sentence, line, caret with tail, and hint")
{
    const std::string text = "name = \"heavy_top\"\nL = \"T - V(g4)\"\n";
    const Excerpt file = whole_text("heavy_top.toml", text);
    const std::size_t at = text.find("g4");
    const ModelError error("unknown symbol 'g4'", file.range(at, at + 2), "did you mean 'g3'?");
    CHECK(std::string(error.what()) == "heavy_top.toml:2:12: error: unknown symbol 'g4'\n"
                                       "  L = \"T - V(g4)\"\n"
                                       "             ^~\n"
                                       "hint: did you mean 'g3'?");
    CHECK(error.code() == ExitCode::model_error);
}

TEST_CASE("without a file only the sentence and the hint are shown")
{
    CHECK(render({Severity::warning, "this is odd", {}, ""}) == "warning: this is odd");
    CHECK(render({Severity::note, "see here", {}, "a hint"}) == "note: see here\nhint: a hint");
}

TEST_CASE("no name can write on the terminal: control characters of a sentence or a hint are shown as '?'")
{
    const SourceRange where = whole_text("m\x1b.toml", "x").range(0, 1);
    CHECK(render({Severity::error, "unknown key 'a\x1b[2J\n'", where, "known: b\a, c\u202e"}) ==
          "m?.toml:1:1: error: unknown key 'a?[2J?'\n  x\n  ^\nhint: known: b?, c?");
}

TEST_CASE("columns count characters, not bytes")
{
    CHECK(render_in("θθ + x", 7, 8) == "m.toml:1:6: error: wrong\n  θθ + x\n       ^");
    CHECK(place(whole_text("m.toml", "a\nθθx").range(6, 7)) == "m.toml:2:3");
}

TEST_CASE("tabs are kept so that the caret stands under its character")
{
    CHECK(render_in("\ta\tb", 3, 4) == "m.toml:1:4: error: wrong\n  \ta\tb\n  \t \t^");
}

TEST_CASE("a range over several lines is marked on its first line only")
{
    CHECK(render_in("a + b\nc + d", 4, 9) == "m.toml:1:5: error: wrong\n  a + b\n      ^");
    CHECK(render_in("a + b\r\nc", 4, 5) == "m.toml:1:5: error: wrong\n  a + b\n      ^");
}

TEST_CASE("the end of the text and ranges beyond it are marked after the last character")
{
    CHECK(render_in("ab", 2, 2) == "m.toml:1:3: error: wrong\n  ab\n    ^");
    CHECK(render({Severity::error, "wrong", {whole_text("f", "ab").file, 90, 99}, ""}) ==
          "f:1:3: error: wrong\n  ab\n    ^");
    CHECK(render_in("", 0, 0) == "m.toml:1:1: error: wrong\n  \n  ^");
}

TEST_CASE("a line above 120 characters is cut around the caret")
{
    const std::string text = std::string(300, 'a') + "X" + std::string(300, 'b');
    const std::string shown = render_in(text, 300, 301);
    CHECK(shown == "m.toml:1:301: error: wrong\n  ..." + std::string(57, 'a') + "X" + std::string(56, 'b') +
                       "...\n     " + std::string(57, ' ') + "^");
    CHECK(render_in(text, 0, 2) == "m.toml:1:1: error: wrong\n  " + std::string(114, 'a') + "...\n  ^~");
    const std::string end = render_in(text, 600, 601);
    CHECK(end ==
          "m.toml:1:601: error: wrong\n  ..." + std::string(113, 'b') + "b\n     " + std::string(113, ' ') + "^");
    CHECK(render_in(std::string(120, 'a'), 119, 120) ==
          "m.toml:1:120: error: wrong\n  " + std::string(120, 'a') + "\n  " + std::string(119, ' ') + "^");
}

TEST_CASE("control characters and bytes that are not UTF-8 never reach the terminal")
{
    CHECK(render_in("a\x1b[31m\xff", 1, 2) == "m.toml:1:2: error: wrong\n  a?[31m?\n   ^");
    CHECK(quote("a\x1b[31m\xff") == "'a?[31m?'");
    CHECK(quote(std::string(100, 'x')) == "'" + std::string(40, 'x') + "...'");
}

TEST_CASE("an excerpt maps its bytes through the escapes of its file")
{
    // The file holds "a\tb" with the escape written out: 'b' is byte 2 of the text and byte 4 of the file.
    auto file = std::make_shared<const SourceFile>(SourceFile{"m.toml", "\"a\\tb\""});
    const Excerpt excerpt{file, "a\tb", {1, 2, 4, 5}};
    const SourceRange b = excerpt.range(2, 3);
    CHECK(b.begin == 4);
    CHECK(b.end == 5);
    const SourceRange tab = excerpt.range(1, 2);
    CHECK(tab.begin == 2);
    CHECK(tab.end == 4);
    CHECK(source_text(tab) == "\\t");
}

TEST_CASE("no handler of an ordinary error takes an internal one")
{
    STATIC_REQUIRE_FALSE(std::is_base_of_v<Error, InternalError>);
    STATIC_REQUIRE_FALSE(std::is_base_of_v<std::exception, InternalError>);
}

TEST_CASE("a mathematical error keeps its message and its hint apart, and is printed as an error")
{
    const MathematicsError error("model 'm' is refuted", "see `lagen check`");
    CHECK(error.message() == "model 'm' is refuted");
    CHECK(error.hint() == "see `lagen check`");
    CHECK(std::string(error.what()) == "error: model 'm' is refuted\nhint: see `lagen check`");
    CHECK(std::string(MathematicsError("no value").what()) == "error: no value");
    CHECK(error.code() == ExitCode::refuted);
}

TEST_CASE("an internal error asks for a report and is the machine's fault")
{
    const InternalError error("a node has no operands");
    CHECK(std::string(error.what()) ==
          "internal error: a node has no operands\nhint: this is a defect of lagen; please "
          "report it together with the model file and the command");
    CHECK(error.code() == ExitCode::machine);
}
