// SPDX-License-Identifier: GPL-2.0-or-later
/// From (line, column in code points), as a TOML parser counts, to bytes of the file.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace lagen {

class SourcePositions {
  public:
    /// `text` must outlive this object.
    explicit SourcePositions(std::string_view text);

    /// The byte where the character at `line`, `column` (both from 1) starts; past the end of a line its end, past the
    /// end of the text the text's end.
    [[nodiscard]] std::size_t byte_of(std::size_t line, std::size_t column) const;

  private:
    struct Line {
        std::size_t byte;      ///< where it starts
        std::size_t character; ///< how many characters of the text stand before it
    };
    std::string_view text_;
    std::vector<Line> lines_;
    std::vector<std::size_t>
        milestones_; ///< the byte of every 64th character, so that long lines cost no more than short ones
};

/// The first byte of `text` at which a control character stands: C0, DEL, C1, line and paragraph separators and the
/// marks that reverse the direction of writing; the text's size where there is none.
[[nodiscard]] std::size_t first_control_character(std::string_view text);

} // namespace lagen
