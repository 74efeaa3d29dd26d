// SPDX-License-Identifier: GPL-2.0-or-later
/// Where a piece of text stands, what was wrong with it, and what the process answers.
/// Every message a user can cause is a sentence: what was found (with its value), what is required, where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

/// A whole text, kept alive by every range that points into it. `name` is the path as the user typed it,
/// or a bracketed pseudo-name such as "<--invariant>" for text from the command line.
struct SourceFile {
    std::string name;
    std::string text; ///< UTF-8, as read
};

/// Bytes [begin, end) of a file. An empty `file` means that the place is unknown (built by hand in a test).
struct SourceRange {
    std::shared_ptr<const SourceFile> file;
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// An expression cut out of a file. Byte k of `text` came from byte `origin[k]` of the file, so that a position
/// in a TOML string with escapes still points at the right character; `origin` has text.size() + 1 entries
/// (the last one is the end).
struct Excerpt {
    std::shared_ptr<const SourceFile> file;
    std::string text;
    std::vector<std::size_t> origin;

    /// The file range of bytes [begin, end) of `text`.
    [[nodiscard]] SourceRange range(std::size_t begin, std::size_t end) const;
};

/// The whole of `text` as an excerpt of a pseudo-file called `name`.
[[nodiscard]] Excerpt whole_text(std::string name, std::string text);

/// Bytes [begin, end) of an excerpt without the blanks around them.
[[nodiscard]] Excerpt trimmed(const Excerpt& text, std::size_t begin, std::size_t end);

/// One decoded character. `length` counts its bytes; 0 means that the bytes are not UTF-8 (or that the text ends).
struct CodePoint {
    char32_t value = 0;
    std::size_t length = 0;
};

/// The character that starts at byte `at` of `text`. Overlong forms, surrogates and values above U+10FFFF are refused
/// [RFC 3629].
[[nodiscard]] CodePoint decode_utf8(std::string_view text, std::size_t at);

/// The first byte of `text` that is not part of valid UTF-8, or npos.
[[nodiscard]] std::size_t find_invalid_utf8(std::string_view text);

/// `text` in single quotes for a message: cut to 40 characters with "...", control characters and bytes that are not
/// UTF-8 shown as '?', so that no input can write on the terminal.
[[nodiscard]] std::string quote(std::string_view text);

/// "file:line:column" of the beginning of a range, "" where the file is unknown.
[[nodiscard]] std::string place(const SourceRange& range);

/// The text of a range, "" where the file is unknown.
[[nodiscard]] std::string source_text(const SourceRange& range);

/// Process exit codes (the interface; see README).
enum class ExitCode : int {
    done = 0,
    refuted = 1,
    undecided = 2,
    model_error = 3,
    usage = 4,
    machine = 5,
    interrupted = 130,
};

enum class Severity { error, warning, note };

struct Diagnostic {
    Severity severity = Severity::error;
    std::string message; ///< one sentence, no final full stop
    SourceRange where;
    std::string hint; ///< may be empty
};

/// "file:line:column: error: message", the source line, a caret with a tail under the range, and "hint: ..." where
/// there is one. Lines and columns count from 1, columns in characters (code points). Tabs are kept so that the caret
/// stands under its character; a line longer than 120 characters is cut around the caret with "...".
[[nodiscard]] std::string render(const Diagnostic& diagnostic);

/// The base of everything that lagen throws on purpose, its own defects (InternalError) apart.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& text) : std::runtime_error(text), code_(code) {}
    [[nodiscard]] ExitCode code() const noexcept { return code_; }

  private:
    ExitCode code_;
};

/// The model file or an expression is wrong (exit code 3); what() is the rendered diagnostic.
class ModelError : public Error {
  public:
    explicit ModelError(Diagnostic diagnostic);
    ModelError(std::string message, SourceRange where, std::string hint = {});
    [[nodiscard]] const Diagnostic& diagnostic() const noexcept { return diagnostic_; }

  private:
    Diagnostic diagnostic_;
};

/// The mathematics says no (exit code 1): a sentence without a full stop, and a hint where there is one; what() is the
/// rendered diagnostic.
class MathematicsError : public Error {
  public:
    explicit MathematicsError(std::string message, std::string hint = {});
    [[nodiscard]] const std::string& message() const noexcept { return message_; }
    [[nodiscard]] const std::string& hint() const noexcept { return hint_; }

  private:
    std::string message_, hint_;
};

/// TEXT, and "hint: HINT" on a line of its own where there is one.
[[nodiscard]] std::string with_hint(const std::string& text, const std::string& hint);

/// The machine failed us: no compiler, disk full, unreadable folder (exit code 5).
class MachineError : public Error {
  public:
    explicit MachineError(const std::string& text, const std::string& hint = {})
        : Error(ExitCode::machine, with_hint("error: " + text, hint))
    {
    }
};

/// A defect of lagen itself: the text asks the user to report it (exit code 5). It is neither an Error nor a
/// std::exception, so that nothing between a decision and the command can take it for an ordinary outcome.
class InternalError {
  public:
    explicit InternalError(const std::string& text);
    [[nodiscard]] const char* what() const noexcept { return text_.c_str(); }
    [[nodiscard]] static ExitCode code() noexcept { return ExitCode::machine; }

  private:
    std::string text_;
};

/// The entry of `known` nearest to `unknown` in edit distance if it is near enough to be a slip of the hand, else "".
/// Capitals for small letters are the least of slips; ties go to the earlier entry.
[[nodiscard]] std::string nearest_name(std::string_view unknown, std::span<const std::string> known);

} // namespace lagen
