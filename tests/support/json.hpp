// SPDX-License-Identifier: GPL-2.0-or-later
/// A JSON reader for test data (RFC 8259), small enough to read. Numbers keep their text, members their order.
/// Throws std::runtime_error with the byte at which reading stopped; nesting is bounded by 200.
#pragma once

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lagen::json {

enum class Kind { null, boolean, number, text, array, object };

struct Value {
    Kind kind = Kind::null;
    std::string text;              ///< of a text (unescaped), a number (as written), a word ("true", "false", "null")
    std::vector<Value> entries;    ///< of an array, and the values of an object
    std::vector<std::string> keys; ///< of an object, one an entry

    /// The member `key`; throws where there is none.
    [[nodiscard]] const Value& operator[](std::string_view key) const
    {
        for (std::size_t k = 0; k < keys.size(); ++k)
            if (keys[k] == key) return entries[k];
        throw std::runtime_error("JSON: there is no member \"" + std::string(key) + "\"");
    }
    [[nodiscard]] bool has(std::string_view key) const
    {
        for (const std::string& name : keys)
            if (name == key) return true;
        return false;
    }
    [[nodiscard]] const Value& operator[](std::size_t k) const { return entries.at(k); }
    [[nodiscard]] std::size_t size() const { return entries.size(); }
    [[nodiscard]] long double number() const { return std::stold(text); }
    [[nodiscard]] double decimal() const { return std::strtod(text.c_str(), nullptr); }
    /// The texts of an array of texts or numbers.
    [[nodiscard]] std::vector<std::string> texts() const
    {
        std::vector<std::string> found;
        for (const Value& entry : entries) found.push_back(entry.text);
        return found;
    }
};

namespace detail {

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    Value document()
    {
        Value value = read(0);
        skip_space();
        if (at_ != text_.size()) fail("text after the end");
        return value;
    }

  private:
    Value read(int depth)
    {
        if (depth > 200) fail("nesting deeper than 200");
        skip_space();
        switch (peek()) {
        case '{': return object(depth);
        case '[': return array(depth);
        case '"': return {Kind::text, string(), {}, {}};
        case 't': return word("true", Kind::boolean);
        case 'f': return word("false", Kind::boolean);
        case 'n': return word("null", Kind::null);
        default: return number();
        }
    }

    Value object(int depth)
    {
        Value value{Kind::object, {}, {}, {}};
        for (bool more = open('}'); more; more = next('}')) {
            skip_space();
            value.keys.push_back(string());
            skip_space();
            expect(':');
            value.entries.push_back(read(depth + 1));
        }
        return value;
    }

    Value array(int depth)
    {
        Value value{Kind::array, {}, {}, {}};
        for (bool more = open(']'); more; more = next(']')) value.entries.push_back(read(depth + 1));
        return value;
    }

    /// After an opening bracket: is there an entry?
    bool open(char close)
    {
        ++at_;
        skip_space();
        if (peek() != close) return true;
        ++at_;
        return false;
    }

    /// After an entry: is there another one?
    bool next(char close)
    {
        skip_space();
        if (peek() == close) {
            ++at_;
            return false;
        }
        expect(',');
        return true;
    }

    std::string string()
    {
        expect('"');
        std::string result;
        while (peek() != '"') {
            if (peek() != '\\') {
                result += text_[at_++];
                continue;
            }
            ++at_;
            const char escape = peek();
            ++at_;
            if (escape == 'u')
                append_code_point(result);
            else if (const auto k = std::string_view("\"\\/bfnrt").find(escape); k != std::string_view::npos)
                result += "\"\\/\b\f\n\r\t"[k];
            else
                fail("unknown escape");
        }
        ++at_;
        return result;
    }

    /// \uXXXX outside the surrogates, as UTF-8.
    void append_code_point(std::string& result)
    {
        if (at_ + 4 > text_.size()) fail("unfinished escape");
        const auto code = static_cast<unsigned>(std::stoul(std::string(text_.substr(at_, 4)), nullptr, 16));
        at_ += 4;
        if (code >= 0xd800 && code < 0xe000) fail("surrogate");
        if (code < 0x80) {
            result += static_cast<char>(code);
        } else if (code < 0x800) {
            result += static_cast<char>(0xc0U | code >> 6U);
            result += static_cast<char>(0x80U | (code & 0x3fU));
        } else {
            result += static_cast<char>(0xe0U | code >> 12U);
            result += static_cast<char>(0x80U | (code >> 6U & 0x3fU));
            result += static_cast<char>(0x80U | (code & 0x3fU));
        }
    }

    Value number()
    {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
                                      std::string_view("+-.").find(text_[at_]) != std::string_view::npos))
            ++at_;
        if (at_ == begin) fail("unexpected character");
        return {Kind::number, std::string(text_.substr(begin, at_ - begin)), {}, {}};
    }

    Value word(std::string_view expected, Kind kind)
    {
        if (text_.substr(at_, expected.size()) != expected) fail("unknown word");
        at_ += expected.size();
        return {kind, std::string(expected), {}, {}};
    }

    void skip_space()
    {
        while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    }
    [[nodiscard]] char peek() const
    {
        if (at_ >= text_.size()) fail("unexpected end");
        return text_[at_];
    }
    void expect(char wanted)
    {
        if (peek() != wanted) fail(std::string("expected ") + wanted);
        ++at_;
    }
    [[noreturn]] void fail(const std::string& what) const
    {
        throw std::runtime_error("JSON: " + what + " at byte " + std::to_string(at_));
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

} // namespace detail

[[nodiscard]] inline Value parse(std::string_view text)
{
    return detail::Reader(text).document();
}

/// Throws std::runtime_error where the file cannot be read.
[[nodiscard]] inline Value read_file(const std::string& path)
{
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw std::runtime_error("JSON: cannot read " + path);
    return parse(std::string(std::istreambuf_iterator<char>(stream), {}));
}

} // namespace lagen::json
