// SPDX-License-Identifier: GPL-2.0-or-later
/// What may be the name of a generated class.
#include "model/names.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace lagen {

namespace {

/// C++20 keywords [lex.key], alternative tokens, and macros of the standard library that a header may meet.
constexpr std::string_view reserved_words[] = {"EOF",
                                               "FILE",
                                               "INFINITY",
                                               "NAN",
                                               "NULL",
                                               "alignas",
                                               "alignof",
                                               "and",
                                               "and_eq",
                                               "asm",
                                               "assert",
                                               "auto",
                                               "bitand",
                                               "bitor",
                                               "bool",
                                               "break",
                                               "case",
                                               "catch",
                                               "char",
                                               "char16_t",
                                               "char32_t",
                                               "char8_t",
                                               "class",
                                               "co_await",
                                               "co_return",
                                               "co_yield",
                                               "compl",
                                               "concept",
                                               "const",
                                               "const_cast",
                                               "consteval",
                                               "constexpr",
                                               "constinit",
                                               "continue",
                                               "decltype",
                                               "default",
                                               "delete",
                                               "do",
                                               "double",
                                               "dynamic_cast",
                                               "else",
                                               "enum",
                                               "errno",
                                               "explicit",
                                               "export",
                                               "extern",
                                               "false",
                                               "float",
                                               "for",
                                               "friend",
                                               "goto",
                                               "if",
                                               "inline",
                                               "int",
                                               "long",
                                               "main",
                                               "mutable",
                                               "namespace",
                                               "new",
                                               "noexcept",
                                               "not",
                                               "not_eq",
                                               "nullptr",
                                               "operator",
                                               "or",
                                               "or_eq",
                                               "private",
                                               "protected",
                                               "public",
                                               "register",
                                               "reinterpret_cast",
                                               "requires",
                                               "return",
                                               "short",
                                               "signed",
                                               "sizeof",
                                               "static",
                                               "static_assert",
                                               "static_cast",
                                               "stderr",
                                               "stdin",
                                               "stdout",
                                               "struct",
                                               "switch",
                                               "template",
                                               "this",
                                               "thread_local",
                                               "throw",
                                               "true",
                                               "try",
                                               "typedef",
                                               "typeid",
                                               "typename",
                                               "union",
                                               "unix",
                                               "linux",
                                               "unsigned",
                                               "using",
                                               "virtual",
                                               "void",
                                               "volatile",
                                               "wchar_t",
                                               "while",
                                               "xor",
                                               "xor_eq",
                                               "setjmp",
                                               "offsetof"};

bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

std::string shown(const std::string& name)
{
    constexpr std::size_t longest = 60;
    std::string out;
    for (const char c : name.substr(0, longest)) out.push_back(static_cast<unsigned char>(c) < 0x20 ? '?' : c);
    return name.size() > longest ? out + "..." : out;
}

} // namespace

void require_class_name(const std::string& name, const SourceRange& where, bool from_file_name)
{
    constexpr std::size_t longest = 200;
    const std::string hint = from_file_name ? "give the model a name: name = \"my_model\""
                                            : "use letters, digits and '_', with no digit first, e.g. \"heavy_top\"";
    const std::string subject = from_file_name
                                    ? fmt::format("the file's stem '{}', which names the model,", shown(name))
                                    : fmt::format("the model name '{}'", shown(name));
    const auto refuse = [&](const char* why, const std::string& advice) {
        throw ModelError(subject + " " + why, where, advice);
    };
    const bool spelled = !name.empty() && is_letter(name.front()) &&
                         std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
    if (!spelled) refuse("is not a C++ identifier", hint);
    if (name.size() > longest) refuse("is longer than 200 characters", {});
    if (std::find(std::begin(reserved_words), std::end(reserved_words), name) != std::end(reserved_words)) {
        refuse("is a reserved word of C++", "choose another name");
    }
    const bool capital = name.size() > 1 && name[0] == '_' && name[1] >= 'A' && name[1] <= 'Z';
    if (capital || name.find("__") != std::string::npos)
        refuse("is of a form that C++ reserves for itself", "choose another name");
}

} // namespace lagen
