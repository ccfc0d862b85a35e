// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_encoding.h"

#include <gtest/gtest.h>

namespace clerestory::io {
namespace {

std::string decoded(std::string_view bytes, bool big_endian, std::size_t piece) {
  Utf16Decoder decoder(big_endian);
  std::string text;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size())))
    decoder.append(bytes.substr(0, piece), text);
  decoder.finish(text);
  return text;
}

std::string as_utf8(std::string text) {
  make_utf8(text);
  return text;
}

TEST(TextEncoding, Utf16IsDecodedWhereverItIsCut) {
  for (const std::size_t piece : {1U, 2U, 3U, 100U}) {
    EXPECT_EQ(decoded({"a\0\xe4\0\xac\x20\x3d\xd8\x00\xde", 10}, false, piece), "aä€😀");
    EXPECT_EQ(decoded({"\0a\0\xe4\x20\xac\xd8\x3d\xde\x00", 10}, true, piece), "aä€😀");
  }
}

TEST(TextEncoding, HalfCharactersOfUtf16AreReplaced) {
  EXPECT_EQ(decoded({"\xd8\x3d\0a", 4}, true, 100), "\uFFFDa");
  EXPECT_EQ(decoded({"\xde\0\0a", 4}, true, 100), "\uFFFDa");
  EXPECT_EQ(decoded({"\0a\xd8\x3d", 4}, true, 100), "a\uFFFD");
  EXPECT_EQ(decoded({"\0a\0", 3}, true, 100), "a\uFFFD");
}

TEST(TextEncoding, Utf8StaysAndOtherTextIsWindows1252) {
  EXPECT_EQ(as_utf8("Wände € 😀"), "Wände € 😀");
  EXPECT_EQ(as_utf8("W\xe4nde \x80"), "Wände €");
  EXPECT_EQ(as_utf8("\xc3"), "Ã") << "cut off";
  EXPECT_EQ(as_utf8("\xc0\x80"), "À€") << "too long for its character";
  EXPECT_EQ(as_utf8("\xed\xa0\x80"), "í\u00a0€") << "half a surrogate pair";
  EXPECT_EQ(as_utf8("\xf5\x80\x80\x80"), "õ€€€") << "beyond Unicode";
}

}  // namespace
}  // namespace clerestory::io
