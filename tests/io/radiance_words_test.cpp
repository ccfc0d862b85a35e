// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/radiance_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::ElementsAre;

std::vector<std::string> words_of(const std::string& text) {
  const test::ScratchFolder folder;
  test::write_text(folder.path() / "a.rad", text);
  RadianceWords words(folder.path() / "a.rad");
  std::vector<std::string> result;
  while (words.peek() != nullptr) {
    const RadianceWord word = words.take();
    result.push_back((word.is_command ? "!" : "") + word.text + "@" + std::to_string(word.line));
  }
  return result;
}

TEST(RadianceWords, CommentsRunToTheEndOfTheLine) {
  EXPECT_THAT(words_of("# head\nvoid plastic # a wall\n\twall\r\n"), ElementsAre("void@2", "plastic@2", "wall@3"));
}

TEST(RadianceWords, QuotationMarksHoldBlanksTogether) {
  EXPECT_THAT(words_of("void plastic \"my wall\" 'it is'"), ElementsAre("void@1", "plastic@1", "my wall@1", "it is@1"));
}

TEST(RadianceWords, ACommandIsItsLineAndThoseThatContinueIt) {
  EXPECT_THAT(words_of("  !xform -t 0 \\\n 0 1 a.rad\nvoid"), ElementsAre("!xform -t 0  0 1 a.rad@1", "void@3"));
}

TEST(RadianceWords, AQuotedTextThatNeverEndsEndsWithItsLine) {
  EXPECT_THAT(split_quoted("a 'b c"), ElementsAre("a", "b c"));
  EXPECT_THAT(split_quoted("'"), ElementsAre(""));
}

}  // namespace
}  // namespace clerestory::io
