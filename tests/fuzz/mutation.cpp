// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace clerestory::fuzz {

namespace {

constexpr std::size_t kLongestPiece = 64;
constexpr std::size_t kLongestText = std::size_t{1} << 20;

constexpr std::array<std::string_view, 20> kNumbers{"0",           "1",
                                                    "-1",          "2",
                                                    "255",         "65536",
                                                    "1e308",       "1e400",
                                                    "-1e-400",     "nan",
                                                    "-inf",        "2147483648",
                                                    "0.5",         "1e9",
                                                    "4294967295",  "4294967296",
                                                    "-2147483649", "9223372036854775807",
                                                    "1e",          "99999999999999999999"};

constexpr std::array<unsigned char, 8> kBytes{0x00, 0xff, 0x7f, 0x80, '\n', '\r', '"', '\\'};

struct Piece {
  std::size_t at = 0;
  std::size_t size = 0;
};

Piece any_piece(const std::string& text, Dice& dice) {
  const std::size_t at = dice.below(text.size());
  return {at, std::min(1 + dice.below(kLongestPiece), text.size() - at)};
}

/// A line with its end.
Piece any_line(const std::string& text, Dice& dice) {
  const std::size_t inside = dice.below(text.size());
  const std::size_t before = inside == 0 ? std::string::npos : text.rfind('\n', inside - 1);
  const std::size_t at = before == std::string::npos ? 0 : before + 1;
  return {at, std::min(text.find('\n', at), text.size() - 1) + 1 - at};
}

/// The word at or behind a place by chance.
Piece any_word(const std::string& text, Dice& dice) {
  constexpr const char* kBlanks = " \t\r\n";
  const std::size_t at = text.find_first_not_of(kBlanks, dice.below(text.size()));
  if (at == std::string::npos) return {};
  return {at, std::min(text.find_first_of(kBlanks, at), text.size()) - at};
}

std::string copy(const std::string& text, const Piece& piece) { return text.substr(piece.at, piece.size); }

void damage_bytes(std::string& text, Dice& dice) {
  char& byte = text[dice.below(text.size())];
  byte = dice.below(2) == 0 ? static_cast<char>(byte ^ (1 << dice.below(8)))
                            : static_cast<char>(kBytes[dice.below(kBytes.size())]);
}

void damage_number(std::string& text, Dice& dice) {
  const Piece word = any_word(text, dice);
  text.replace(word.at, word.size, kNumbers[dice.below(kNumbers.size())]);
}

void exchange_words(std::string& text, const std::string& other, Dice& dice) {
  const Piece word = any_word(text, dice);
  text.replace(word.at, word.size, copy(other, any_word(other, dice)));
}

void damage_pieces(std::string& text, const std::string& other, Dice& dice) {
  const auto any = dice.below(2) == 0 ? &any_piece : &any_line;
  const Piece piece = any(text, dice);
  switch (dice.below(4)) {
    case 0:
      text.erase(piece.at, piece.size);
      break;
    case 1:
      text.insert(piece.at, copy(text, piece));
      break;
    case 2:
      text.insert(piece.at, copy(text, any(text, dice)));
      break;
    default:
      text.insert(piece.at, copy(other, any(other, dice)));
      break;
  }
}

void damage(std::string& text, const std::string& other, Dice& dice) {
  if (text.empty() || other.empty()) {
    text += other;
    return;
  }
  switch (dice.below(8)) {
    case 0:
    case 1:
      return damage_bytes(text, dice);
    case 2:
    case 3:
      return damage_number(text, dice);
    case 4:
      return exchange_words(text, other, dice);
    case 5:
    case 6:
      return damage_pieces(text, other, dice);
    default:
      return text.resize(dice.below(text.size()));
  }
}

}  // namespace

std::string mutated(const std::vector<std::string>& seeds, Dice& dice) {
  std::string text = seeds[dice.below(seeds.size())];
  for (std::size_t left = 1 + dice.below(4); left > 0; --left) damage(text, seeds[dice.below(seeds.size())], dice);
  text.resize(std::min(text.size(), kLongestText));
  return text;
}

}  // namespace clerestory::fuzz
