// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/xml_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/refusal.h"
#include "tests/support/scratch_folder.h"

namespace clerestory::io {
namespace {

using testing::HasSubstr;

class XmlTree : public testing::Test {
 protected:
  [[nodiscard]] XmlElement read(const std::string& text) const {
    test::write_text(file_, text);
    return read_xml(file_, "model", 1 << 20);
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    return test::refusal_of([&] { static_cast<void>(read(text)); });
  }

 private:
  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_.path() / "a.xml";
};

TEST_F(XmlTree, HoldsElementsAttributesTextAndLines) {
  const XmlElement root =
      read("<?xml version='1.0'?>\n<!-- a <comment> -->\n<a x='1' y=\"&lt;2&gt;\">one<b/>\n<c>two</c>more</a>\n");
  EXPECT_EQ(root.name, "a");
  EXPECT_EQ(root.attribute("x"), "1");
  EXPECT_EQ(root.attribute("y"), "<2>");
  EXPECT_EQ(root.attribute("z"), "");
  EXPECT_EQ(root.text, "one\nmore");
  ASSERT_EQ(root.children.size(), 2U);
  EXPECT_EQ(root.find("c")->text, "two");
  EXPECT_EQ(root.find("c")->line, 4U);
  EXPECT_EQ(root.find("d"), nullptr);
}

TEST_F(XmlTree, WhatIsNoXmlIsRefusedWithItsLine) {
  EXPECT_THAT(refusal("<a>\n<b></a>\n"), HasSubstr("a.xml:2: this is no sound XML: mismatched tag"));
  EXPECT_THAT(refusal("<a>\n"), HasSubstr("a.xml:2: this is no sound XML"));
  EXPECT_THAT(refusal(""), HasSubstr("no sound XML"));
}

TEST_F(XmlTree, DocumentTypesAndDeepNestingAreRefused) {
  EXPECT_THAT(refusal("<!DOCTYPE a [<!ENTITY b 'c'>]>\n<a>&b;</a>\n"), HasSubstr("a document type, which is not read"));
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<a>";
  EXPECT_THAT(refusal(deep), HasSubstr("over 200 elements"));
}

}  // namespace
}  // namespace clerestory::io
