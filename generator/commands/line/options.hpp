// SPDX-License-Identifier: GPL-2.0-or-later
/// Command-line options: a thin wrapper that keeps Boost.Program_options out of every other file.
#pragma once

#include "model/model.hpp"
#include "model/morphism.hpp"
#include "text/usage_error.hpp"

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lagen {

struct OptionEntry {
    const char* name;  ///< "output,o": long name and, after the comma, a letter
    const char* value; ///< what its value is called in the help; nullptr: a flag
    const char* help;
    const char* standard = nullptr; ///< shown in the help and returned where the option is absent
};

struct CommandSyntax {
    const char* command;    ///< "check"
    const char* positional; ///< "MODEL..." as shown; a final "..." allows several; "" allows none
    const char* purpose;    ///< one sentence
    std::vector<OptionEntry> options;
};

class Options {
  public:
    /// Throws UsageError. `--help` prints to standard output and makes help() true.
    Options(const CommandSyntax& syntax, std::span<const std::string> arguments);

    [[nodiscard]] bool help() const { return help_; }
    [[nodiscard]] const std::string& command() const { return command_; }
    [[nodiscard]] bool has(const std::string& name) const { return values_.contains(name); }
    [[nodiscard]] std::string get(const std::string& name) const; ///< the last value, or the standard, or ""
    [[nodiscard]] std::vector<std::string> all(const std::string& name) const;
    /// The file of --output; "-" without it.
    [[nodiscard]] std::string output() const { return has("output") ? get("output") : "-"; }
    [[nodiscard]] const std::vector<std::string>& positional() const { return positional_; }
    /// Options and their values as they were given.
    [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& given() const { return given_; }

    /// The value of `name`, which must be one of `allowed`.
    [[nodiscard]] std::string choice(const std::string& name, const std::vector<std::string>& allowed) const;
    /// Whether `--format` is json; UsageError where it is neither that nor text.
    [[nodiscard]] bool as_json() const { return choice("format", {"text", "json"}) == "json"; }
    /// The `--set name=value` entries, then those of `--bind name=value,name`. UsageError where both give a value to
    /// the same parameter.
    [[nodiscard]] std::vector<Setting> settings() const;
    /// Puts those of --bind behind the settings that --set gives.
    void add_bindings(std::vector<Setting>& settings) const;
    /// The name=value entries of an option.
    [[nodiscard]] std::vector<Setting> named(const std::string& option) const;

  private:
    [[nodiscard]] Setting binding_of(const std::string& entry) const;

    std::string command_;
    bool help_ = false;
    std::map<std::string, std::vector<std::string>> values_;
    std::map<std::string, std::string> standards_;
    std::vector<std::string> positional_;
    std::vector<std::pair<std::string, std::string>> given_;
};

/// UsageError where a file that is written (--output, --plot, --depfile) is the model, one that it includes, a table of
/// its scenes, or one of the options `also`.
void require_apart(const Options& options, const Model& model, std::initializer_list<const char*> also = {});
/// The same of a morphism, its stages and its models.
void require_apart(const Options& options, const MorphismFile& morphism);

/// Options that mean the same for every command that has them.
namespace option {
inline constexpr OptionEntry scene{"scene", "NAME", "the scene; without it `default`, else the first"};
inline constexpr OptionEntry set{"set", "NAME=VALUE", "a parameter's value (may be repeated)"};
inline constexpr OptionEntry initial{"initial", "NAME=VALUE", "an initial value of the scene (may be repeated)"};
inline constexpr OptionEntry bind{
    "bind", "NAMES",
    "parameters that become constants of the equations, with a value or the one that they have: I1=2,m"};
inline constexpr OptionEntry method{"method", "METHOD", "see `lagen methods`; without it the scene's, else dop853"};
inline constexpr OptionEntry step{"step", "H", "step of a fixed-step method"};
inline constexpr OptionEntry time_scale{
    "time-scale", "EXPR",
    "of a splitting: steps of H times this function of the state, so chosen that runs stay reversible"};
inline constexpr OptionEntry tolerance{
    "tolerance", "TOL", "relative and absolute tolerance of an adaptive method; without it the scene's, else 1e-10"};
inline constexpr OptionEntry t_end{
    "t-end", "T", "end of the run, backwards where it lies before the start; without it the scene's duration"};
inline constexpr OptionEntry output{"output,o", "FILE", "write there instead of to standard output"};
inline constexpr OptionEntry unchecked{"unchecked", nullptr, "go on although the model is refuted"};
inline constexpr OptionEntry least{"least", nullptr, "run the least model that gives what the scene watches"};
inline constexpr OptionEntry full{"full", nullptr, "run the whole model"};
inline constexpr OptionEntry format{"format,f", "FORMAT", "text or json", "text"};
} // namespace option

/// `text` of --OPTION as name and expression; UsageError where it is not name=value.
[[nodiscard]] Setting read_setting(const std::string& option, const std::string& text);

/// "a,b , c" as {"a", "b", "c"}; commas inside parentheses and brackets do not separate.
[[nodiscard]] std::vector<std::string> split_list(const std::string& text);

// Values that options give: expressions of a model's parameters, whole numbers, ranges FIRST:LAST:COUNT. Grids are
// exact: point k of n between a and b is the double nearest to a + (b - a) k/(n - 1).

/// The expression given to --NAME, closed over parameters; ModelError where it depends on anything else.
[[nodiscard]] Tree option_tree(const Model& model, const std::string& name, const Excerpt& text);
/// The same of a number, a vector or a matrix.
[[nodiscard]] ArrayValue option_array(const Model& model, const std::string& name, const Excerpt& text);

struct GridAxis {
    Rational first, last;
    std::uint64_t count = 0; ///< 0: a continuum

    [[nodiscard]] double at(std::uint64_t place) const;
};

/// FIRST:LAST:COUNT, or FIRST:LAST, of --OPTION: its parts, and the text as it was given.
struct RangeText {
    std::string option, text;
    std::vector<Excerpt> parts; ///< between colons, blanks trimmed

    /// Throws UsageError.
    [[noreturn]] void refuse(const std::string& what) const;
};
[[nodiscard]] RangeText range_of(const std::string& option, const Excerpt& range, const std::string& text);

/// The ends are exact where their expressions are rational, else the nearest doubles. Throws ModelError where one is no
/// finite number, UsageError where the count is none from 1 on, to `most`.
[[nodiscard]] GridAxis axis_of(const RangeText& range, const Model& model, std::uint64_t most = UINT64_MAX);

/// A whole number without a sign, at most 1e18; nothing where the text is none.
[[nodiscard]] std::optional<std::uint64_t> read_whole(const std::string& text);
/// The value of an option as such a number; UsageError where it is none, or outside of these bounds.
[[nodiscard]] std::uint64_t whole_option(const Options& options, const std::string& name, std::uint64_t least,
                                         std::uint64_t most = UINT64_MAX);

} // namespace lagen
