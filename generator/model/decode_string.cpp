// SPDX-License-Identifier: GPL-2.0-or-later
/// TOML strings, byte by byte.
#include "model/decode_string.hpp"

#include <string_view>

namespace lagen {

namespace {

void append_utf8(std::string& out, unsigned long c)
{
    const auto push = [&out](unsigned long byte) { out.push_back(static_cast<char>(byte)); };
    if (c < 0x80) {
        push(c);
    } else if (c < 0x800) {
        push(0xC0 | (c >> 6));
        push(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        push(0xE0 | (c >> 12));
        push(0x80 | ((c >> 6) & 0x3F));
        push(0x80 | (c & 0x3F));
    } else {
        push(0xF0 | (c >> 18));
        push(0x80 | ((c >> 12) & 0x3F));
        push(0x80 | ((c >> 6) & 0x3F));
        push(0x80 | (c & 0x3F));
    }
}

unsigned long hexadecimal(std::string_view digits)
{
    unsigned long value = 0;
    for (const char d : digits) {
        const unsigned digit = d <= '9' ? static_cast<unsigned>(d - '0') : static_cast<unsigned>((d | 0x20) - 'a' + 10);
        value = value * 16 + digit;
    }
    return value;
}

char simple_escape(char c)
{
    switch (c) {
    case 'b': return '\b';
    case 't': return '\t';
    case 'n': return '\n';
    case 'f': return '\f';
    case 'r': return '\r';
    case 'e': return '\x1b';
    default: return c;
    }
}

/// The literal's text between its quotes, consumed from left to right into an excerpt.
class Decoder {
  public:
    Decoder(Excerpt& out, std::size_t begin, std::size_t end) : out_(out), at_(begin), end_(end) {}

    void run(bool escapes)
    {
        const std::string& text = out_.file->text;
        while (at_ < end_) {
            if (escapes && text[at_] == '\\' && at_ + 1 < end_) {
                escape();
            } else {
                out_.text.push_back(text[at_]);
                out_.origin.push_back(at_++);
            }
        }
        out_.origin.push_back(end_);
    }

  private:
    void escape()
    {
        const std::string& text = out_.file->text;
        const std::size_t start = at_;
        const char c = text[at_ + 1];
        at_ += 2;
        if (c == ' ' || c == '\t' || c == '\n' ||
            c == '\r') { // a line-ending backslash swallows the white space after it
            while (at_ < end_ && std::string_view(" \t\r\n").find(text[at_]) != std::string_view::npos) ++at_;
            return;
        }
        std::string piece;
        const std::size_t digits = c == 'u' ? 4 : c == 'U' ? 8 : 0;
        if (digits != 0 && at_ + digits <= end_) {
            append_utf8(piece, hexadecimal(std::string_view(text).substr(at_, digits)));
            at_ += digits;
        } else {
            piece.push_back(simple_escape(c));
        }
        out_.text += piece;
        out_.origin.insert(out_.origin.end(), piece.size(), start);
    }

    Excerpt& out_;
    std::size_t at_;
    std::size_t end_;
};

} // namespace

Excerpt decode_string(const std::shared_ptr<const SourceFile>& file, std::size_t begin, std::size_t end,
                      const std::string& value)
{
    const std::string_view literal = std::string_view(file->text).substr(begin, end - begin);
    Excerpt out{file, {}, {}};
    std::size_t quotes = 0;
    bool escapes = false;
    for (const std::string_view quote : {"\"\"\"", "'''", "\"", "'"}) {
        if (literal.size() < 2 * quote.size() || !literal.starts_with(quote) || !literal.ends_with(quote)) continue;
        quotes = quote.size();
        escapes = quote.front() == '"';
        break;
    }
    std::size_t first = begin + quotes;
    if (quotes == 3 && literal.substr(3).starts_with("\r\n")) first += 2;
    if (quotes == 3 && literal.substr(3).starts_with("\n")) first += 1;
    Decoder(out, first, end - quotes).run(escapes);
    if (out.text != value) {
        out.text = value;
        out.origin.assign(value.size(), begin);
        out.origin.push_back(end);
    }
    return out;
}

} // namespace lagen
