// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clerestory::io {

/// An element of an XML document with all that it holds.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  std::string text;  ///< all of its own, without that of its children
  std::uint64_t line = 0;

  /// The first child of that name; nullptr if there is none.
  [[nodiscard]] const XmlElement* find(std::string_view child) const;
  /// The value of an attribute; empty where it is not there.
  [[nodiscard]] std::string_view attribute(std::string_view key) const;
};

/// Reads a document of moderate size and gives its root.
/// Throws InputError for no sound XML, with the line; for a document type, which could name other files; for elements over 200 deep; and
/// where read_text_file() does.
/// @param limit  of the file [bytes]
XmlElement read_xml(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit);

}  // namespace clerestory::io
