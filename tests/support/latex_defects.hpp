// SPDX-License-Identifier: GPL-2.0-or-later
/// What LaTeX would refuse or show wrongly of a text that lagen printed: found by reading it, without a LaTeX.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace lagen::testing {

/// One defect a line of the answer, with the place; empty: the text is in order.
class LatexReader {
  public:
    explicit LatexReader(std::string_view text) : text_(text) {}

    [[nodiscard]] std::string defects()
    {
        while (at_ < text_.size()) take_item();
        if (!open_.empty()) tell("a group that is not closed");
        if (in_dollars_) tell("a formula that is not closed");
        return found_;
    }

  private:
    /// What was raised and lowered of the last atom of a group.
    struct Group {
        bool raised = false, lowered = false;
        std::string closes = "}";
    };

    void take_item()
    {
        const char c = text_[at_++];
        if (static_cast<unsigned char>(c) >= 0x80U) tell("a character that is not ASCII");
        switch (c) {
        case '\\': take_command(); return;
        case '{': open_.push_back({}); return;
        case '}': close("}"); return;
        case '$':
            if (std::ranges::any_of(open_, [](const Group& each) { return each.closes.starts_with("\\end{align"); }))
                tell("a '$' in a formula");
            in_dollars_ = !in_dollars_;
            fresh();
            return;
        case '^':
        case '_': take_script(c == '^'); return;
        case ' ':
        case '\n': return;
        default: fresh();
        }
    }

    void take_command()
    {
        std::string name;
        while (at_ < text_.size() && is_letter(text_[at_])) name += text_[at_++];
        if (name.empty()) {
            ++at_; // an escaped character, a space, the end of a line
            return fresh();
        }
        if (name == "mathit" && at_ < text_.size() && text_[at_] == '{') check_word();
        if (name == "begin" || name == "end") {
            const std::string environment = "\\end" + group_text();
            at_ += environment.size() - 4;
            if (name == "begin")
                open_.push_back({false, false, environment});
            else
                close(environment);
        } else if (name == "left" || name == "right") {
            ++at_; // the parenthesis
            if (name == "left")
                open_.push_back({false, false, "\\right"});
            else
                close("\\right");
        } else {
            fresh();
        }
    }

    /// Words of several letters have no bare '_'.
    void check_word()
    {
        const std::string word = group_text();
        for (std::size_t k = 0; k < word.size(); ++k)
            if (word[k] == '_' && word[k - 1] != '\\') tell("a bare '_' in a word");
    }

    void take_script(bool up)
    {
        const bool in_formula = in_dollars_ || !open_.empty();
        if (!in_formula) tell("a subscript outside a formula");
        bool& taken = up ? last().raised : last().lowered;
        if (taken) tell("a second script of one atom");
        const Group before = last();
        if (at_ < text_.size() && text_[at_] == '{') {
            const std::size_t depth = open_.size();
            do take_item();
            while (open_.size() > depth && at_ < text_.size());
        } else {
            take_item();
        }
        last() = before;
        (up ? last().raised : last().lowered) = true;
    }

    void close(const std::string& by)
    {
        if (open_.empty() || open_.back().closes != by) return tell("'" + by + "' closes nothing");
        open_.pop_back();
        fresh();
    }

    void fresh() { last().raised = last().lowered = false; }
    Group& last() { return open_.empty() ? outside_ : open_.back(); }
    static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

    /// "{name}" at this place.
    [[nodiscard]] std::string group_text() const
    {
        return std::string(text_.substr(at_, text_.find('}', at_) + 1 - at_));
    }

    void tell(const std::string& what)
    {
        const std::size_t begin = at_ < 60 ? 0 : at_ - 60;
        found_ += what + " before: " + std::string(text_.substr(begin, at_ - begin)) + "\n";
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Group> open_;
    Group outside_;
    bool in_dollars_ = false;
    std::string found_;
};

[[nodiscard]] inline std::string latex_defects(std::string_view text)
{
    return LatexReader(text).defects();
}

} // namespace lagen::testing
