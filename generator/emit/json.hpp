// SPDX-License-Identifier: GPL-2.0-or-later
/// A JSON writer small enough to read: objects and arrays in the order written, strings escaped (RFC 8259), numbers
/// as shortest round-trip decimals (%.17g for doubles where asked); nan and infinities as null.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lagen {

class JsonWriter {
  public:
    JsonWriter& begin_object();
    JsonWriter& end_object();
    JsonWriter& begin_array();
    JsonWriter& end_array();
    JsonWriter& key(std::string_view name);
    JsonWriter& value(std::string_view text);
    JsonWriter& value(const char* text) { return value(std::string_view(text)); }
    JsonWriter& value(double number);
    JsonWriter& value(std::size_t number);
    JsonWriter& value(bool flag);
    JsonWriter& null();
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    void separate();
    std::string text_;
    std::vector<bool> first_; ///< a level each: nothing written yet
    bool after_key_ = false;
};

} // namespace lagen
