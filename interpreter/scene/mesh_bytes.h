// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "scene/file_mesh.h"

namespace gmsim::scene {

/// A place in the bytes of a mesh file that reads words and numbers, as text or as binary. Every
/// failure is a MeshFileError with the line or the byte.
class MeshBytes {
 public:
  explicit MeshBytes(std::string_view bytes) : bytes_(bytes) {}

  /// Numbers are read as binary from now on: integers of 4 bytes, sizes of `size_bytes`.
  void set_binary(bool binary, int size_bytes);
  void swap_bytes() { swap_ = true; }
  [[nodiscard]] bool binary() const { return binary_; }

  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  [[nodiscard]] std::size_t offset() const { return at_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - at_; }
  void seek(std::size_t offset) { at_ = offset; }
  [[nodiscard]] std::size_t find(std::string_view text) const { return bytes_.find(text, at_); }

  // --- always text ---
  void skip_space();
  /// The next word between blanks and line ends; fails at the end of the file.
  std::string_view word(std::string_view what);
  /// The rest of the line, its end consumed.
  std::string_view rest_of_line();
  /// A text between double quotes.
  std::string_view quoted(std::string_view what);
  std::int64_t text_integer(std::string_view what);
  double text_real(std::string_view what);

  // --- text or binary ---
  std::int32_t integer(std::string_view what);
  /// A number of things or a tag, not negative.
  std::uint64_t size(std::string_view what);
  double real(std::string_view what);

  /// What one item takes in the file.
  struct ItemSize {
    std::uint64_t integers = 0, sizes = 0, reals = 0;
  };
  /// Fails when the rest of the file cannot hold `count` such items: nothing is ever allocated for
  /// more than the file has.
  void expect_room(std::uint64_t count, ItemSize item, std::string_view what) const;

  [[noreturn]] void fail(std::string message) const { fail_at(at_, std::move(message)); }
  [[noreturn]] void fail_at(std::size_t offset, std::string message) const;

 private:
  template <class Number>
  Number raw(std::string_view what);

  std::string_view bytes_;
  std::size_t at_ = 0;
  std::size_t word_at_ = 0;
  bool binary_ = false;
  bool swap_ = false;
  int size_bytes_ = 8;
};

/// A finite number that takes the whole of `word`; a leading + is allowed.
[[nodiscard]] std::optional<double> parse_real(std::string_view word);
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view word);
/// `word` as it can be shown in a message: short, and printable.
[[nodiscard]] std::string shown(std::string_view word);

}  // namespace gmsim::scene
