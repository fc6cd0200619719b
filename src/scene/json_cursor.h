// SPDX-FileCopyrightText: The Hooke authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

#include "hooke/scene/words.h"

namespace hooke::scene {

/// Hands a text to a parser of events and knows how far it has read, and on which line that is.
class JsonCursor {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    Iterator() = default;
    Iterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}

    reference operator*() const { return *at_; }
    Iterator& operator++() {
      *furthest_ = ++at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const char* at_ = nullptr;
    const char** furthest_ = nullptr;
  };

  explicit JsonCursor(std::string_view text) : text_(text), read_to_(text.data()) {}
  JsonCursor(const JsonCursor&) = delete;  // iterators point into it
  JsonCursor& operator=(const JsonCursor&) = delete;

  Iterator begin() { return {text_.data(), &read_to_}; }
  Iterator end() { return {text_.data() + text_.size(), &read_to_}; }

  std::string_view text() const { return text_; }
  /// Of the character read last; 0 before any.
  std::size_t offset() const {
    const auto read = static_cast<std::size_t>(read_to_ - text_.data());
    return read == 0 ? 0 : read - 1;
  }
  /// The line of the token read last. The parser reads one character past the end of a number.
  int line() {
    const std::size_t to = offset();
    if (to > counted_) {
      line_ += static_cast<int>(count_line_ends(text_, counted_, to));
      counted_ = to;
    }
    return line_;
  }

 private:
  std::string_view text_;
  const char* read_to_;
  std::size_t counted_ = 0;
  int line_ = 1;
};

}  // namespace hooke::scene
