// SPDX-License-Identifier: GPL-2.0-or-later
/// Values, with their types insisted on.
#include "model/read_values.hpp"

#include "expression/parse.hpp"
#include "model/complaints.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace lagen {

namespace {

/// C0, DEL, C1, line and paragraph separators and the marks that reverse the direction of writing.
bool is_control(char32_t c)
{
    return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x2028 || c == 0x2029 || (c >= 0x202A && c <= 0x202E) ||
           (c >= 0x2066 && c <= 0x2069);
}

/// The first byte at which a control character stands; the text's size where there is none.
std::size_t first_control_character(std::string_view text)
{
    std::size_t at = 0;
    while (at < text.size()) {
        const CodePoint point = decode_utf8(text, at);
        if (is_control(point.value)) return at;
        at += std::max<std::size_t>(1, point.length);
    }
    return at;
}

/// A decimal literal of TOML: sign, digits with '_' between them, point, exponent.
Tree read_decimal(const TomlValue& value, const std::string& what)
{
    if (!value.finite)
        throw complain::is_not(what, fmt::format("'{}'", value.text.text), "a finite number", value.where);
    Excerpt plain{value.text.file, {}, {}};
    bool negative = false;
    for (std::size_t k = 0; k < value.text.text.size(); ++k) {
        const char c = value.text.text[k];
        if (c == '_') continue;
        if (k == 0 && (c == '+' || c == '-')) {
            negative = c == '-';
            continue;
        }
        plain.text.push_back(c);
        plain.origin.push_back(value.text.origin[k]);
    }
    plain.origin.push_back(value.text.origin.back());
    const Tree magnitude = parse_expression(plain);
    if (!negative) return magnitude;
    auto node = std::make_shared<TreeNode>(*negate(magnitude));
    node->where = value.where;
    return node;
}

} // namespace

Tree read_expression(const TomlValue& value, const std::string& what)
{
    switch (value.kind) {
    case TomlKind::string: return parse_expression(value.text);
    case TomlKind::integer: return number(Rational(value.integer), value.where);
    case TomlKind::decimal: return read_decimal(value, what);
    default: throw InternalError("a value that is no expression");
    }
}

Tree read_array_expression(const TomlValue& value, const std::string& what)
{
    if (value.kind != TomlKind::array) return read_expression(value, what);
    auto out = std::make_shared<TreeNode>();
    out->kind = TreeKind::array;
    out->where = value.where;
    for (const TomlValue& entry : value.items)
        out->arguments.push_back(read_array_expression(entry, "an entry of " + what));
    return out;
}

void refuse_equation(const Excerpt& text, const std::string& what)
{
    const std::size_t sign = text.text.find('=');
    if (sign == std::string::npos || text.text.find_first_of("<>!") != std::string::npos) return;
    const std::size_t behind = text.text.find_first_not_of('=', sign);
    const Excerpt left = trimmed(text, 0, sign);
    const Excerpt right = trimmed(text, std::min(behind, text.text.size()), text.text.size());
    const bool single = right.text.find_first_of("+- ") == std::string::npos;
    std::string difference = left.text;
    if (right.text != "0") difference += single ? " - " + right.text : fmt::format(" - ({})", right.text);
    throw ModelError(
        fmt::format("{} '{}' is an equation, where an expression that is zero is required", what, text.text),
        place_of(text), fmt::format("write \"{}\"", difference));
}

void require_printable(const Excerpt& text, const std::string& what)
{
    const std::size_t at = first_control_character(text.text);
    if (at == text.text.size()) return;
    const CodePoint point = decode_utf8(text.text, at);
    throw ModelError(
        fmt::format("{} contains the control character U+{:04X}; printable characters on one line are required", what,
                    static_cast<unsigned>(point.value)),
        text.range(at, at + point.length));
}

std::vector<Excerpt> split_at_commas(const Excerpt& text, char comma)
{
    std::vector<Excerpt> out;
    std::size_t begin = 0;
    int depth = 0;
    for (std::size_t k = 0; k < text.text.size(); ++k) {
        depth += text.text[k] == '[' ? 1 : text.text[k] == ']' ? -1 : 0;
        if (text.text[k] != comma || depth > 0) continue;
        out.push_back(trimmed(text, begin, k));
        begin = k + 1;
    }
    out.push_back(trimmed(text, begin, text.text.size()));
    return out;
}

std::string read_file(const std::string& path)
{
    constexpr std::size_t most_bytes = std::size_t{16} << 20U;
    const auto refuse = [&](const std::string& why, const char* hint) {
        throw ModelError(fmt::format("the model file '{}' {}", path, why), {}, hint);
    };
    if (path.find('\0') != std::string::npos) refuse("has a zero byte in its name", "");
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        refuse("does not exist", "give the path of a .toml file");
    if (status.type() == std::filesystem::file_type::directory)
        refuse("is a folder", "give the path of a .toml file in it");
    std::ifstream in(path, std::ios::binary);
    if (!in) refuse(fmt::format("cannot be opened: {}", std::strerror(errno)), "");
    std::string text;
    std::array<char, 65536> block{};
    while (in.read(block.data(), block.size()) || in.gcount() > 0) {
        text.append(block.data(), static_cast<std::size_t>(in.gcount()));
        if (text.size() > most_bytes) refuse("is larger than 16 MiB", "");
    }
    if (in.bad()) refuse("cannot be read to its end", "");
    return text;
}

std::shared_ptr<const SourceFile> file_named(const TomlValue& value, const std::string& what)
{
    namespace fs = std::filesystem;
    if (value.text.text.empty()) throw ModelError(fmt::format("{} names no file", what), value.where);
    const fs::path path = (fs::path(value.where.file->name).parent_path() / value.text.text).lexically_normal();
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error) && !fs::is_directory(path, error))
        throw ModelError(fmt::format("{} is not a regular file", quote(path.string())), value.where);
    try {
        return std::make_shared<const SourceFile>(SourceFile{path.string(), read_file(path.string())});
    } catch (const ModelError& failure) {
        throw ModelError(failure.diagnostic().message, value.where,
                         fmt::format("{} is relative to the file that it stands in", what));
    }
}

} // namespace lagen
