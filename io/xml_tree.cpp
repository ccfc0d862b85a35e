// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/xml_tree.h"

#include <expat.h>
#include <fmt/format.h>

#include <memory>
#include <type_traits>

#include "io/text_file.h"
#include "io/words.h"
#include "mesh/error.h"

namespace clerestory::io {

namespace {

constexpr std::size_t kDeepest = 200;  // elements in each other

using Parser = std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)>;

/// Builds the tree from what the parser meets. Nothing may be thrown through the parser, which is C: it is stopped, with the reason here.
class TreeBuilder {
 public:
  explicit TreeBuilder(XML_Parser parser) : parser_(parser) {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(parser, &TreeBuilder::start, &TreeBuilder::end);
    XML_SetCharacterDataHandler(parser, &TreeBuilder::text);
    XML_SetStartDoctypeDeclHandler(parser, &TreeBuilder::doctype);
  }

  XmlElement& root() { return open_.front().children.front(); }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  static TreeBuilder& of(void* user) { return *static_cast<TreeBuilder*>(user); }

  static void start(void* user, const char* name, const char** attributes) {
    TreeBuilder& tree = of(user);
    if (tree.open_.size() > kDeepest) return tree.stop(fmt::format("over {} elements stand in each other", kDeepest));
    XmlElement element;
    element.name = name;
    element.line = XML_GetCurrentLineNumber(tree.parser_);
    for (; *attributes != nullptr; attributes += 2) element.attributes.emplace_back(attributes[0], attributes[1]);
    tree.open_.push_back(std::move(element));
  }

  static void end(void* user, const char* /*name*/) {
    TreeBuilder& tree = of(user);
    XmlElement element = std::move(tree.open_.back());
    tree.open_.pop_back();
    tree.open_.back().children.push_back(std::move(element));
  }

  static void text(void* user, const char* text, int size) {
    of(user).open_.back().text.append(text, static_cast<std::size_t>(size));
  }

  static void doctype(void* user, const char* /*name*/, const char* /*system*/, const char* /*id*/, int /*internal*/) {
    of(user).stop("it has a document type, which is not read");
  }

  void stop(std::string reason) {
    reason_ = std::move(reason);
    XML_StopParser(parser_, XML_FALSE);
  }

  XML_Parser parser_;
  std::vector<XmlElement> open_{XmlElement{}};  ///< the document, its root, … down to the element that is being read
  std::string reason_;
};

}  // namespace

const XmlElement* XmlElement::find(std::string_view child) const {
  for (const XmlElement& element : children)
    if (element.name == child) return &element;
  return nullptr;
}

std::string_view XmlElement::attribute(std::string_view key) const {
  for (const auto& [own, value] : attributes)
    if (own == key) return value;
  return {};
}

XmlElement read_xml(const std::filesystem::path& path, std::string_view kind, std::uint64_t limit) {
  const std::string document = read_text_file(path, kind, limit);
  const Parser parser(XML_ParserCreate("UTF-8"), &XML_ParserFree);
  if (parser == nullptr) throw std::bad_alloc();
  TreeBuilder tree(parser.get());
  if (XML_Parse(parser.get(), document.data(), static_cast<int>(document.size()), XML_TRUE) == XML_STATUS_OK)
    return std::move(tree.root());
  const std::string reason = tree.reason().empty() ? XML_ErrorString(XML_GetErrorCode(parser.get())) : tree.reason();
  throw InputError(path.string(), XML_GetCurrentLineNumber(parser.get()),
                   fmt::format("this is no sound XML: {}", printable(reason)), "correct the file or export it again");
}

}  // namespace clerestory::io
