// SPDX-License-Identifier: GPL-2.0-or-later
#include "errors/source_texts.hpp"

#include <cctype>

namespace lagen::errors {

namespace {

bool is_name(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

class Reader {
  public:
    explicit Reader(const std::string& source) : source_(source) {}

    std::vector<SourceText> read()
    {
        while (at_ < source_.size()) step();
        return std::move(found_);
    }

  private:
    [[nodiscard]] bool sees(const char* text) const
    {
        return source_.compare(at_, std::char_traits<char>::length(text), text) == 0;
    }

    /// To behind the next `text`, or to the end.
    void skip_behind(const std::string& text)
    {
        const std::size_t end = source_.find(text, at_);
        at_ = end == std::string::npos ? source_.size() : end + text.size();
    }

    void step()
    {
        const char c = source_[at_];
        if (c == '\n') fresh_line_ = true;
        if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            ++at_;
        } else if (sees("//") || (c == '#' && fresh_line_)) {
            skip_behind("\n");
            fresh_line_ = true;
        } else if (sees("/*")) {
            skip_behind("*/");
        } else {
            fresh_line_ = false;
            token();
        }
    }

    void token()
    {
        const char c = source_[at_];
        if (sees("R\"(")) {
            at_ += 3;
            const std::size_t begin = at_;
            skip_behind(")\"");
            add(source_.substr(begin, at_ - begin - 2));
            return;
        }
        if (c == '"') return add(quoted());
        after_literal_ = false;
        if (c == '\'') return skip_character();
        if (is_name(c)) {
            const std::size_t begin = at_;
            while (at_ < source_.size() && (is_name(source_[at_]) || digit_separator())) ++at_;
            name_ = source_.substr(begin, at_ - begin);
            return;
        }
        if (c == '(') calls_.push_back(name_);
        if (c == ')' && !calls_.empty()) calls_.pop_back();
        name_.clear();
        ++at_;
    }

    /// The ' of 1'000
    [[nodiscard]] bool digit_separator() const
    {
        return source_[at_] == '\'' && at_ > 0 && std::isdigit(static_cast<unsigned char>(source_[at_ - 1])) != 0 &&
               at_ + 1 < source_.size() && std::isdigit(static_cast<unsigned char>(source_[at_ + 1])) != 0;
    }

    void skip_character()
    {
        ++at_;
        while (at_ < source_.size() && source_[at_] != '\'') at_ += source_[at_] == '\\' ? 2 : 1;
        ++at_;
    }

    std::string quoted()
    {
        std::string text;
        for (++at_; at_ < source_.size() && source_[at_] != '"'; ++at_) {
            if (source_[at_] != '\\') {
                text += source_[at_];
                continue;
            }
            const char escaped = source_[++at_];
            if (escaped == 'n')
                text += '\n';
            else if (escaped == '"' || escaped == '\\')
                text += escaped;
            else
                (text += '\\') += escaped;
        }
        ++at_;
        return text;
    }

    void add(const std::string& text)
    {
        if (after_literal_)
            found_.back().text += text;
        else
            found_.push_back({text, calls_});
        after_literal_ = true;
    }

    const std::string& source_;
    std::size_t at_ = 0;
    bool fresh_line_ = true;
    bool after_literal_ = false;
    std::string name_; ///< the token before, where it is a name
    std::vector<std::string> calls_;
    std::vector<SourceText> found_;
};

} // namespace

std::vector<SourceText> string_literals(const std::string& source)
{
    return Reader(source).read();
}

std::vector<std::string> fixed_parts(const std::string& format)
{
    std::vector<std::string> parts(1);
    for (std::size_t k = 0; k < format.size(); ++k) {
        const char c = format[k];
        const bool doubled = (c == '{' || c == '}') && k + 1 < format.size() && format[k + 1] == c;
        const std::size_t close = c == '{' && !doubled ? format.find('}', k) : std::string::npos;
        if (close != std::string::npos) {
            parts.emplace_back();
            k = close;
            continue;
        }
        parts.back() += c;
        if (doubled) ++k;
    }
    return parts;
}

bool is_made_from(const std::string& example, const std::vector<std::string>& parts)
{
    std::size_t at = 0;
    for (const std::string& part : parts) {
        at = example.find(part, at);
        if (at == std::string::npos) return false;
        at += part.size();
    }
    return true;
}

std::size_t word_count(const std::string& format)
{
    std::size_t words = 0;
    for (const std::string& part : fixed_parts(format)) {
        std::size_t letters = 0;
        for (const char c : part + " ") {
            const bool letter = std::isalpha(static_cast<unsigned char>(c)) != 0;
            if (!letter && letters >= 2) ++words;
            letters = letter ? letters + 1 : 0;
        }
    }
    return words;
}

} // namespace lagen::errors
