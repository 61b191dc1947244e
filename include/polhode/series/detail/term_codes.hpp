// SPDX-License-Identifier: MIT
// Keys of the terms of products in one word, as short as their box allows: exponents, multipliers
// and function from the most significant bit to the least, so that codes sort as keys do.
//
// A word holds sums of fields times powers of two, each field from 0 to its width; in parts of it
// the fields may be negative, since words add up modulo 2^bits.
#pragma once

#include <cstdint>
#include <vector>

#include "polhode/series/detail/key_box.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {

__extension__ using LongWord = unsigned __int128;

template <class Word>
class TermCodes {
 public:
  TermCodes(const Symbols& symbols, const KeyBox& box) : symbols_(symbols) {
    int shift = 1;
    for (std::size_t i = box.angles.size(); i-- > 0;) {
      const FieldRange& range = box.angles[i];
      angles_.insert(angles_.begin(), {shift, KeyBox::width(2 * range.largest), -range.largest});
      shift += angles_[0].width;
    }
    for (const Field& field : angles_) zero_ += shifted(-field.least, field.shift);
    for (std::size_t i = box.variables.size(); i-- > 0;) {
      const FieldRange& range = box.variables[i];
      variables_.insert(variables_.begin(),
                        {shift, KeyBox::width(range.largest - range.least), range.least});
      shift += variables_[0].width;
    }
    for (const Field& field : variables_) base_ += shifted(-field.least, field.shift);
  }

  // Parts of a code: of exponents, and of multipliers; base() + sums of the first and zero() + sums
  // of the second are codes.
  Word exponents(const TermKey& key) const {
    Word word = 0;
    for (std::size_t i = 0; i < variables_.size(); ++i)
      word += shifted(exponent(symbols_, key, static_cast<int>(i)), variables_[i].shift);
    return word;
  }
  Word multipliers(const TermKey& key) const {
    Word word = 0;
    for (std::size_t i = 0; i < angles_.size(); ++i)
      word += shifted(multiplier(symbols_, key, static_cast<int>(i)), angles_[i].shift);
    return word;
  }
  Word base() const { return base_; }
  Word zero() const { return zero_; }

  // Throws where it is out of the range of keys.
  TermKey key(Word code) const {
    TermKey key = zero_key(symbols_);
    for (std::size_t i = 0; i < variables_.size(); ++i)
      key.exponents =
          symbols_.exponents().with(key.exponents, static_cast<int>(i), at(code, variables_[i]));
    for (std::size_t i = 0; i < angles_.size(); ++i)
      key.multipliers =
          symbols_.multipliers().with(key.multipliers, static_cast<int>(i), at(code, angles_[i]));
    if (!fits(symbols_, key)) out_of_range(symbols_, key);
    key.multipliers |= static_cast<std::uint64_t>(code) & TermKey::function_bit;
    return key;
  }

 private:
  struct Field {
    int shift, width, least;
  };
  // A field that takes no bits may stand at the end of the word.
  static constexpr int word_bits = 8 * static_cast<int>(sizeof(Word));
  static Word shifted(int n, int shift) {
    return shift >= word_bits ? Word{0} : static_cast<Word>(static_cast<Word>(n) << shift);
  }
  static int at(Word code, const Field& field) {
    if (field.width == 0) return field.least;
    const Word mask = (Word{1} << field.width) - 1;
    return static_cast<int>((code >> field.shift) & mask) + field.least;
  }

  Symbols symbols_;
  std::vector<Field> variables_, angles_;
  Word base_ = 0, zero_ = 0;
};

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
