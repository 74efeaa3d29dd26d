// SPDX-License-Identifier: GPL-2.0-or-later
/// Lines of C++ with indentation, at most 120 columns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lagen {

class TextBlock {
  public:
    /// Lines from now on stand `levels` further to the right (negative: to the left).
    void indent(int levels) { level_ += levels; }
    /// One line; a longer one is broken at spaces outside of string literals, its continuation eight columns further
    /// right.
    void line(std::string_view text);
    /// `prefix`, the items with ", " between them, `suffix`; a longer line is broken between items only.
    void list(std::string_view prefix, const std::vector<std::string>& items, std::string_view suffix);
    void blank() { text_ += '\n'; }
    /// `/// text`, sanitised by plain_text; an empty text gives a bare `///`.
    void comment(std::string_view text);
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    int level_ = 0;
    std::string text_;
};

} // namespace lagen
