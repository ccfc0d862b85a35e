// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/picture_line.h"

#include <gtest/gtest.h>

namespace clerestory::tools {
namespace {

TEST(PictureLine, TellsWhereThePictureIsOrHowToGetIt) {
  Options options;
  EXPECT_EQ(picture_line(options, "its polar diagram"), "\npicture   with -o FILE.png: its polar diagram\n");
  options.out = "lamp.png";
  EXPECT_EQ(picture_line(options, "its polar diagram"), "\npicture   lamp.png\n");
}

}  // namespace
}  // namespace clerestory::tools
