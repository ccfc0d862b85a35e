// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;

std::string as_utf16(std::string_view ascii, bool big_endian) {
  std::string text = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) text += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return text;
}

class TextFile : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& bytes) const {
    test::write_text(scratch_.path() / "text", bytes);
    return scratch_.path() / "text";
  }
  std::vector<std::string> lines(const std::string& bytes) const {
    LineReader reader(written(bytes), "text");
    std::vector<std::string> result;
    while (reader.next()) result.emplace_back(reader.line());
    return result;
  }

 private:
  test::ScratchFolder scratch_;
};

TEST_F(TextFile, LinesOfUtf16AreReadAsThoseOfUtf8) {
  for (const bool big_endian : {false, true}) {
    EXPECT_THAT(lines(as_utf16("one\r\ntwo\n\nfour", big_endian)), ElementsAre("one", "two", "", "four"));
    EXPECT_THAT(lines(as_utf16("", big_endian)), ElementsAre());
  }
}

TEST_F(TextFile, Utf16LongerThanTheBufferIsReadWhole) {
  const std::string line(3'000'001, 'x');
  EXPECT_THAT(lines(as_utf16(line + "\nend", true)), ElementsAre(line, "end"));
}

TEST_F(TextFile, LinesThatAreNoUtf8AreTakenAsWindows1252) {
  EXPECT_THAT(lines("W\xe4nde\nW\xc3\xa4nde\n"), ElementsAre("Wände", "Wände"));
}

TEST_F(TextFile, WholeFilesAreDecodedToo) {
  EXPECT_EQ(read_text_file(written(as_utf16("a = 1\n", true)), "study", 100), "a = 1\n");
  EXPECT_EQ(read_text_file(written("\xef\xbb\xbf"
                                   "a = 1\n"),
                           "study", 100),
            "a = 1\n");
}

}  // namespace
}  // namespace clerestory::io
